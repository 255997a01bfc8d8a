//! The format: every element and attribute once.
//!
//! An attribute is a [`Row`]: its name, how its text is read and which field of the `Spec` it writes, and a
//! line of documentation. An [`ElementType`] names its rows, its children with their cardinality and the
//! rules between its attributes. The structural check ([`check`]), the readers of `Spec` objects and of
//! default classes, the suggestions in error messages and the printed reference ([`mod@print`]) all derive from
//! these tables.

pub mod actuator;
pub mod asset;
pub mod check;
pub mod composite;
pub mod constraint;
pub mod flex;
pub mod legacy;
pub mod option;
pub mod plugin;
pub mod print;
pub mod root;
pub mod sensor;
pub mod settings;
pub mod text;
pub mod tree;
pub mod visual;
pub mod words;

use crate::spec::Orientation;
use physics::model::ObjType;

/// Name spaces: objects of one space have distinct names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs)]
pub enum Space {
    Class,
    Mesh,
    Skin,
    Hfield,
    Texture,
    Material,
    Body,
    Frame,
    Joint,
    Geom,
    Site,
    Camera,
    Light,
    Pair,
    Exclude,
    Flex,
    Equality,
    Tendon,
    Actuator,
    Sensor,
    Numeric,
    Text,
    Tuple,
    Key,
    Plugin,
}

impl Space {
    /// The space of the names of a kind of element; none for kinds that models do not name.
    pub fn of(kind: ObjType) -> Option<Space> {
        Some(match kind {
            ObjType::Body | ObjType::Xbody => Space::Body,
            ObjType::Joint => Space::Joint,
            ObjType::Geom => Space::Geom,
            ObjType::Site => Space::Site,
            ObjType::Camera => Space::Camera,
            ObjType::Light => Space::Light,
            ObjType::Mesh => Space::Mesh,
            ObjType::Skin => Space::Skin,
            ObjType::Hfield => Space::Hfield,
            ObjType::Texture => Space::Texture,
            ObjType::Material => Space::Material,
            ObjType::Pair => Space::Pair,
            ObjType::Exclude => Space::Exclude,
            ObjType::Flex => Space::Flex,
            ObjType::Equality => Space::Equality,
            ObjType::Tendon => Space::Tendon,
            ObjType::Actuator => Space::Actuator,
            ObjType::Sensor => Space::Sensor,
            ObjType::Numeric => Space::Numeric,
            ObjType::Text => Space::Text,
            ObjType::Tuple => Space::Tuple,
            ObjType::Key => Space::Key,
            ObjType::Frame => Space::Frame,
            ObjType::Plugin => Space::Plugin,
            _ => return None,
        })
    }

    /// The word for an object of this space in messages and in `objtype` attributes.
    pub fn word(self) -> &'static str {
        match self {
            Space::Class => "default class",
            Space::Mesh => "mesh",
            Space::Skin => "skin",
            Space::Hfield => "hfield",
            Space::Texture => "texture",
            Space::Material => "material",
            Space::Body => "body",
            Space::Frame => "frame",
            Space::Joint => "joint",
            Space::Geom => "geom",
            Space::Site => "site",
            Space::Camera => "camera",
            Space::Light => "light",
            Space::Pair => "pair",
            Space::Exclude => "exclude",
            Space::Flex => "flex",
            Space::Equality => "equality",
            Space::Tendon => "tendon",
            Space::Actuator => "actuator",
            Space::Sensor => "sensor",
            Space::Numeric => "numeric",
            Space::Text => "text",
            Space::Tuple => "tuple",
            Space::Key => "key",
            Space::Plugin => "plugin instance",
        }
    }

    /// The space that an `objtype` or `reftype` keyword names.
    pub fn from_objtype(word: &str) -> Option<Space> {
        use Space::*;
        let all = [
            Mesh, Skin, Hfield, Texture, Material, Body, Joint, Geom, Site, Camera, Light, Pair, Exclude,
            Flex, Equality, Tendon, Actuator, Sensor, Numeric, Text, Tuple, Key,
        ];
        if word == "xbody" { Some(Body) } else { all.into_iter().find(|s| s.word() == word) }
    }
}

/// Keywords of an attribute with the codes they stand for.
pub type Words = &'static [(&'static str, i32)];

/// The ways to write an orientation without a quaternion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Way {
    AxisAngle,
    XyAxes,
    ZAxis,
    Euler,
}

impl Way {
    /// How many numbers it takes.
    pub fn length(self) -> usize {
        match self {
            Way::AxisAngle => 4,
            Way::XyAxes => 6,
            Way::ZAxis | Way::Euler => 3,
        }
    }

    /// The orientation that these numbers mean; `None` when there are too few.
    pub fn read(self, t: &[f64]) -> Option<Orientation> {
        Some(match self {
            Way::AxisAngle => Orientation::AxisAngle(*t.first_chunk()?),
            Way::XyAxes => Orientation::XyAxes(*t.first_chunk()?),
            Way::ZAxis => Orientation::ZAxis(*t.first_chunk()?),
            Way::Euler => Orientation::Euler(*t.first_chunk()?),
        })
    }

    /// The numbers of an orientation that is written this way.
    pub fn numbers(self, orientation: &Orientation) -> Option<&[f64]> {
        match (self, orientation) {
            (Way::AxisAngle, Orientation::AxisAngle(t)) => Some(t),
            (Way::XyAxes, Orientation::XyAxes(t)) => Some(t),
            (Way::ZAxis, Orientation::ZAxis(t)) => Some(t),
            (Way::Euler, Orientation::Euler(t)) => Some(t),
            _ => None,
        }
    }
}

/// How the text of an attribute is read and where it goes in a `T`.
#[allow(missing_docs)]
pub enum Bind<T: 'static> {
    /// One number.
    Real(fn(&mut T) -> &mut f64),
    /// `min` numbers up to the length of the field; fewer than that leave the rest as it was.
    Reals { min: usize, field: fn(&mut T) -> &mut [f64] },
    /// A quaternion, not zero.
    Quat(fn(&mut T) -> &mut [f64; 4]),
    /// An orientation that is not a quaternion.
    Turn(Way, fn(&mut T) -> &mut Option<Orientation>),
    /// Six numbers.
    Six(fn(&mut T) -> &mut Option<[f64; 6]>),
    /// Any number of numbers.
    RealList(fn(&mut T) -> &mut Vec<f64>),
    /// One number, kept in single precision.
    Single(fn(&mut T) -> &mut f32),
    /// As many numbers as the field is long, in single precision.
    Singles(fn(&mut T) -> &mut [f32]),
    /// Any number of numbers in single precision.
    SingleList(fn(&mut T) -> &mut Vec<f32>),
    /// One integer.
    Int(fn(&mut T) -> &mut i32),
    /// As many integers as the field is long.
    Ints(fn(&mut T) -> &mut [i32]),
    /// Any number of integers.
    IntList(fn(&mut T) -> &mut Vec<i32>),
    /// `true` or `false`.
    Bool(fn(&mut T) -> &mut bool),
    /// One keyword, whose code goes to the function.
    Keyword { words: Words, assign: fn(&mut T, i32) },
    /// Several keywords, whose codes are combined bitwise.
    Flags { words: Words, field: fn(&mut T) -> &mut i32 },
    /// Names separated by blanks.
    NameList(fn(&mut T) -> &mut Vec<String>),
    /// Text as it stands.
    Text(fn(&mut T) -> &mut String),
    /// The name of the object itself.
    Name(Space, fn(&mut T) -> &mut String),
    /// The name of another object.
    Ref(Space, fn(&mut T) -> &mut String),
    /// The name of another object, of the kind that the named attribute tells.
    ObjRef(&'static str, fn(&mut T) -> &mut String),
    /// Read by code of its element; the kind serves check and documentation.
    Own(Kind),
}

/// What an attribute may hold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(missing_docs)]
pub enum Kind {
    Real {
        min: usize,
        max: Option<usize>,
    },
    Single {
        min: usize,
        max: Option<usize>,
    },
    Int {
        min: usize,
        max: Option<usize>,
    },
    Keyword(Words),
    Flags(Words),
    Text,
    File,
    Name(Space),
    Ref(Space),
    /// The name of an object whose kind the named attribute tells.
    ObjRef(&'static str),
}

/// `true` and `false` as every boolean attribute spells them.
pub const BOOL: Words = &[("false", 0), ("true", 1)];

impl<T> Bind<T> {
    /// The kind of value read.
    pub fn kind(&self) -> Kind
    where
        T: Default,
    {
        let reals = |min, length: usize| Kind::Real { min, max: Some(length) };
        match self {
            Bind::Real(_) => reals(1, 1),
            Bind::Reals { min, field } => reals(*min, field(&mut T::default()).len()),
            Bind::Quat(_) => reals(4, 4),
            Bind::Turn(way, _) => reals(way.length(), way.length()),
            Bind::Six(_) => reals(6, 6),
            Bind::RealList(_) => Kind::Real { min: 0, max: None },
            Bind::Single(_) => Kind::Single { min: 1, max: Some(1) },
            Bind::Singles(field) => {
                let length = field(&mut T::default()).len();
                Kind::Single { min: length, max: Some(length) }
            }
            Bind::SingleList(_) => Kind::Single { min: 0, max: None },
            Bind::Int(_) => Kind::Int { min: 1, max: Some(1) },
            Bind::Ints(field) => {
                let length = field(&mut T::default()).len();
                Kind::Int { min: length, max: Some(length) }
            }
            Bind::IntList(_) => Kind::Int { min: 0, max: None },
            Bind::Bool(_) => Kind::Keyword(BOOL),
            Bind::Keyword { words, .. } => Kind::Keyword(words),
            Bind::Flags { words, .. } => Kind::Flags(words),
            Bind::Text(_) | Bind::NameList(_) => Kind::Text,
            Bind::Name(space, _) => Kind::Name(*space),
            Bind::Ref(space, _) => Kind::Ref(*space),
            Bind::ObjRef(by, _) => Kind::ObjRef(by),
            Bind::Own(kind) => *kind,
        }
    }
}

/// One attribute and the field of a `T` it writes.
pub struct Row<T: 'static> {
    /// Attribute name.
    pub name: &'static str,
    /// Reading and target.
    pub bind: Bind<T>,
    /// One line on meaning, with unit.
    pub doc: &'static str,
    /// The attribute must be present.
    pub required: bool,
    /// A default class may set it.
    pub in_defaults: bool,
}

/// An optional attribute that default classes may set.
pub const fn row<T>(name: &'static str, bind: Bind<T>, doc: &'static str) -> Row<T> {
    Row { name, bind, doc, required: false, in_defaults: true }
}

impl<T> Clone for Bind<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Bind<T> {}

/// An attribute that must be present, so that default classes have no use for it.
pub const fn required<T>(name: &'static str, bind: Bind<T>, doc: &'static str) -> Row<T> {
    Row { name, bind, doc, required: true, in_defaults: false }
}

/// An optional attribute that default classes may not set.
pub const fn local<T>(name: &'static str, bind: Bind<T>, doc: &'static str) -> Row<T> {
    Row { name, bind, doc, required: false, in_defaults: false }
}

/// How an attribute takes part in naming.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Naming {
    /// Not at all.
    None,
    /// Names the object itself.
    Declares(Space),
    /// Names another object.
    Refers(Space),
    /// Names another object, of the kind told by this attribute.
    RefersBy(&'static str),
}

/// The facts of a row that do not depend on the type it writes.
#[derive(Debug, Clone, Copy)]
pub struct Facts {
    /// Attribute name.
    pub name: &'static str,
    /// Must be present.
    pub required: bool,
    /// May stand in a default class.
    pub in_defaults: bool,
    /// Part in naming.
    pub naming: Naming,
}

/// A block of rows whose target type is forgotten.
pub trait Rows: Sync {
    /// Calls `f` for every row.
    fn each(&self, f: &mut dyn FnMut(Facts));
    /// Calls `f` with facts, kind of value and documentation of every row.
    fn describe(&self, f: &mut dyn FnMut(Facts, Kind, &'static str));
}

impl<T: Default> Row<T> {
    fn facts(&self) -> Facts {
        let naming = match self.bind {
            Bind::Name(space, _) | Bind::Own(Kind::Name(space)) => Naming::Declares(space),
            Bind::Ref(space, _) | Bind::Own(Kind::Ref(space)) => Naming::Refers(space),
            Bind::ObjRef(by, _) | Bind::Own(Kind::ObjRef(by)) => Naming::RefersBy(by),
            _ => Naming::None,
        };
        Facts { name: self.name, required: self.required, in_defaults: self.in_defaults, naming }
    }
}

impl<T: Default, const N: usize> Rows for [Row<T>; N] {
    fn each(&self, f: &mut dyn FnMut(Facts)) {
        self.iter().for_each(|row| f(row.facts()));
    }

    fn describe(&self, f: &mut dyn FnMut(Facts, Kind, &'static str)) {
        self.iter().for_each(|row| f(row.facts(), row.bind.kind(), row.doc));
    }
}

/// How often a child element may occur.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Count {
    /// At most once.
    Once,
    /// Any number of times.
    Any,
}

/// A child element of an element.
#[derive(Clone, Copy)]
pub struct Child {
    /// The type of the child.
    pub element: &'static ElementType,
    /// How often.
    pub count: Count,
    /// The child is a default class's view of the element: neither name nor class, no rows that
    /// default classes may not set, nothing required.
    pub defaults: bool,
}

/// Any number of children of this type.
pub const fn any(element: &'static ElementType) -> Child {
    Child { element, count: Count::Any, defaults: false }
}

/// At most one child of this type.
pub const fn once(element: &'static ElementType) -> Child {
    Child { element, count: Count::Once, defaults: false }
}

/// At most one child of this type, inside a default class.
pub const fn class(element: &'static ElementType) -> Child {
    Child { element, count: Count::Once, defaults: true }
}

/// A rule between attributes; a bundle is a list of attributes that belong together.
#[derive(Debug, Clone, Copy)]
pub enum Rule {
    /// At most one bundle may have attributes present.
    Exclusive(&'static [&'static [&'static str]]),
    /// All or none.
    Together(&'static [&'static str]),
    /// At least one bundle must be complete.
    OneOf(&'static [&'static [&'static str]]),
}

/// One element of the format.
pub struct ElementType {
    /// Tag.
    pub tag: &'static str,
    /// One line on what it declares.
    pub doc: &'static str,
    /// Attributes.
    pub rows: &'static [&'static dyn Rows],
    /// Children.
    pub children: &'static [Child],
    /// Rules between attributes.
    pub rules: &'static [Rule],
}

/// A type with attributes only.
pub const fn leaf(tag: &'static str, doc: &'static str, rows: &'static [&'static dyn Rows]) -> ElementType {
    ElementType { tag, doc, rows, children: &[], rules: &[] }
}

/// A type that groups children.
pub const fn section(tag: &'static str, doc: &'static str, children: &'static [Child]) -> ElementType {
    ElementType { tag, doc, rows: &[], children, rules: &[] }
}

impl ElementType {
    /// The same type with rules between its attributes.
    pub const fn rules(mut self, rules: &'static [Rule]) -> Self {
        self.rules = rules;
        self
    }

    /// The same type with children.
    pub const fn children(mut self, children: &'static [Child]) -> Self {
        self.children = children;
        self
    }

    /// Calls `f` for every attribute, in a default class or outside.
    pub fn each_attribute(&self, defaults: bool, f: &mut dyn FnMut(Facts)) {
        let hidden = |a: &Facts| defaults && (!a.in_defaults || a.name == "class" || a.naming.declares());
        for rows in self.rows {
            rows.each(&mut |facts| {
                if !hidden(&facts) {
                    f(facts);
                }
            });
        }
    }

    /// The child type with this tag.
    pub fn child(&self, tag: &str) -> Option<&Child> {
        self.children.iter().find(|c| c.element.tag == tag)
    }
}

impl Naming {
    fn declares(self) -> bool {
        matches!(self, Naming::Declares(_))
    }
}
