//! One attribute of an element, set by its name in the schema: the element is written, changed and read again.

use physics::model::ObjType;

use super::add::element;
use super::{reading, refuse};
use crate::diagnostic::{Diagnostics, Sources};
use crate::read::{Place, Reader};
use crate::schema::check::check_piece;
use crate::schema::root::MUJOCO;
use crate::schema::tree::{BODY, BODY_POSE, BODY_ROWS};
use crate::spec::*;
use crate::write;
use crate::xml::Element;

/// Attributes that exclude each other.
const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// The section that an element of a list stands in; none for elements of bodies.
type Section = Option<&'static str>;

impl Spec {
    /// Sets an attribute of the element called `name`, by its name in MJCF and with its text. Actuators are in general form:
    /// their attributes are those of `<general>`.
    ///
    /// # Errors
    /// There is no such element or attribute, with the nearest suggested; the value is none of the attribute's.
    pub fn set(
        &mut self,
        kind: ObjType,
        name: &str,
        attribute: &str,
        value: &str,
    ) -> Result<(), Diagnostics> {
        if attribute == "name" {
            return refuse("an element is renamed by `rename`, which changes the references to it");
        }
        let change = Change { attribute, value };
        match kind {
            ObjType::Body | ObjType::Xbody => {
                let compiler = self.compiler.clone();
                let body = self.body_mut(name)?;
                let hull = Body { name: body.name.clone(), ..Body::default() };
                change.body(compiler, hull, body)
            }
            ObjType::Joint => change.apply(self, |s| s.joint_mut(name), None),
            ObjType::Geom => change.apply(self, |s| s.geom_mut(name), None),
            ObjType::Site => change.apply(self, |s| s.site_mut(name), None),
            ObjType::Camera => change.apply(self, |s| s.camera_mut(name), None),
            ObjType::Light => change.apply(self, |s| s.light_mut(name), None),
            ObjType::Mesh => change.apply(self, |s| s.mesh_mut(name), Some("asset")),
            ObjType::Skin => change.apply(self, |s| s.skin_mut(name), Some("deformable")),
            ObjType::Hfield => change.apply(self, |s| s.hfield_mut(name), Some("asset")),
            ObjType::Texture => change.apply(self, |s| s.texture_mut(name), Some("asset")),
            ObjType::Material => change.apply(self, |s| s.material_mut(name), Some("asset")),
            ObjType::Pair => change.apply(self, |s| s.pair_mut(name), Some("contact")),
            ObjType::Exclude => change.apply(self, |s| s.exclude_mut(name), Some("contact")),
            ObjType::Flex => change.apply(self, |s| s.flex_mut(name), Some("deformable")),
            ObjType::Equality => change.apply(self, |s| s.equality_mut(name), Some("equality")),
            ObjType::Tendon => change.apply(self, |s| s.tendon_mut(name), Some("tendon")),
            ObjType::Actuator => change.apply(self, |s| s.actuator_mut(name), Some("actuator")),
            ObjType::Sensor => change.apply(self, |s| s.sensor_mut(name), Some("sensor")),
            ObjType::Numeric => change.apply(self, |s| s.numeric_mut(name), Some("custom")),
            ObjType::Text => change.apply(self, |s| s.text_mut(name), Some("custom")),
            ObjType::Tuple => change.apply(self, |s| s.tuple_mut(name), Some("custom")),
            ObjType::Key => change.apply(self, |s| s.key_mut(name), Some("keyframe")),
            _ => refuse(format!("elements of kind {kind:?} have no attributes to set")),
        }
    }
}

/// An attribute and its new text.
struct Change<'a> {
    attribute: &'a str,
    value: &'a str,
}

impl Change<'_> {
    fn apply<T: Piece>(
        &self,
        spec: &mut Spec,
        find: impl Fn(&mut Spec) -> Result<&mut T, Diagnostics>,
        section: Section,
    ) -> Result<(), Diagnostics> {
        let compiler = spec.compiler.clone();
        let target = find(spec)?;
        let mut changed = target.write().map_err(Diagnostics::of_error)?;
        self.put(&mut changed);
        let empty = Spec { compiler, ..Spec::default() };
        let around = match section {
            None => element("body", &[]),
            Some(name) => element(name, &[]),
        };
        let holder = Element { children: vec![changed], ..around };
        let (found, _) = reading(empty, Sources::default(), |reader| match section {
            None => read_in_body(reader, &holder),
            Some(_) => read_section(reader, holder),
        })?;
        let Some(mut new) = found.and_then(|spec| T::take(spec)) else {
            return refuse(format!("attribute '{}' makes another element of it", self.attribute));
        };
        new.keep(target, self.attribute);
        *target = new;
        Ok(())
    }

    /// Sets the attribute, in place of another that says the same.
    fn put(&self, element: &mut Element) {
        let turns = ORIENTATIONS.contains(&self.attribute);
        element
            .attributes
            .retain(|a| a.name != self.attribute && !(turns && ORIENTATIONS.contains(&a.name.as_str())));
        element.put(self.attribute, self.value);
    }

    /// A body is set by its rows: what it holds is not written.
    fn body(&self, compiler: Compiler, hull: Body, body: &mut Body) -> Result<(), Diagnostics> {
        let mut one = element("body", &[]);
        self.put(&mut one);
        let turns = ORIENTATIONS.contains(&self.attribute);
        let empty = Spec { compiler, ..Spec::default() };
        let before = body.clone_attributes(hull);
        let (changed, _) = reading(empty, Sources::default(), |reader| {
            let expansion = &mut reader.expansion;
            check_piece(&one, &BODY, expansion.sources, expansion.diagnostics);
            let mut changed = before;
            if turns {
                changed.alt = None;
            }
            reader.rows(&one, &BODY_ROWS, &mut changed);
            reader.rows(&one, &BODY_POSE, &mut changed);
            changed
        })?;
        body.take_attributes(changed);
        Ok(())
    }
}

impl Body {
    fn clone_attributes(&self, hull: Body) -> Body {
        Body {
            pos: self.pos,
            quat: self.quat,
            alt: self.alt,
            mocap: self.mocap,
            gravcomp: self.gravcomp,
            sleep: self.sleep,
            simple: self.simple,
            userdata: self.userdata.clone(),
            ..hull
        }
    }

    fn take_attributes(&mut self, from: Body) {
        (self.pos, self.quat, self.alt) = (from.pos, from.quat, from.alt);
        (self.mocap, self.gravcomp, self.sleep, self.simple) =
            (from.mocap, from.gravcomp, from.sleep, from.simple);
        self.userdata = from.userdata;
    }
}

fn read_in_body(reader: &mut Reader<'_>, holder: &Element) -> Option<Spec> {
    let expansion = &mut reader.expansion;
    check_piece(holder, &BODY, expansion.sources, expansion.diagnostics);
    if expansion.diagnostics.has_errors() {
        return None;
    }
    reader.open = vec![Body::default()];
    reader.inside(holder, Place { frame: None, class: 0, body_class: 0, world: false });
    let world = reader.open.pop()?;
    Some(Spec { world, ..Spec::default() })
}

fn read_section(reader: &mut Reader<'_>, holder: Element) -> Option<Spec> {
    let root = Element { children: vec![holder], ..element("mujoco", &[]) };
    let expansion = &mut reader.expansion;
    check_piece(&root, &MUJOCO, expansion.sources, expansion.diagnostics);
    if expansion.diagnostics.has_errors() {
        return None;
    }
    reader.sections(&root);
    Some(std::mem::take(&mut reader.spec))
}

/// An element that is written and read by itself.
trait Piece: Sized {
    /// The element as MJCF.
    fn write(&self) -> Result<Element, String>;
    /// The only element of this kind.
    fn take(spec: Spec) -> Option<Self>;
    /// Keeps of `old` what its element does not say.
    fn keep(&mut self, old: &Self, attribute: &str);
}

macro_rules! pieces {
    ($($type:ident $write:path, |$spec:ident| $list:expr, |$new:ident, $old:ident, $attribute:ident| $keep:expr;)*) => {
        $(impl Piece for $type {
            fn write(&self) -> Result<Element, String> {
                $write(self)
            }

            fn take(mut $spec: Spec) -> Option<Self> {
                $list.pop()
            }

            fn keep(&mut self, old: &Self, attribute: &str) {
                self.loc = old.loc;
                let ($new, $old, $attribute) = (self, old, attribute);
                $keep
            }
        })*
    };
}

pieces! {
    Joint write::joint, |spec| spec.world.joints,
        |new, old, _a| { new.frame = old.frame; new.keyed.clone_from(&old.keyed); };
    Geom write::geom, |spec| spec.world.geoms, |new, old, _a| new.frame = old.frame;
    Site write::site, |spec| spec.world.sites, |new, old, _a| new.frame = old.frame;
    Camera write::camera, |spec| spec.world.cameras, |new, old, _a| new.frame = old.frame;
    Light write::light, |spec| spec.world.lights, |new, old, _a| new.frame = old.frame;
    Mesh write::mesh, |spec| spec.meshes, |new, old, a| if a != "file" {
        new.file.clone_from(&old.file);
        new.path.clone_from(&old.path);
    };
    Skin write::skin, |spec| spec.skins, |new, old, a| if a != "file" {
        new.file.clone_from(&old.file);
        new.path.clone_from(&old.path);
    };
    Hfield write::hfield, |spec| spec.hfields, |new, old, a| if a != "file" {
        new.file.clone_from(&old.file);
        new.path.clone_from(&old.path);
    };
    Texture write::texture, |spec| spec.textures, |new, old, a| if !a.starts_with("file") {
        new.file.clone_from(&old.file);
        new.path.clone_from(&old.path);
        new.cubefiles.clone_from(&old.cubefiles);
        new.cubepaths.clone_from(&old.cubepaths);
    };
    Material write::material, |spec| spec.materials, |_n, _o, _a| ();
    Pair write::pair, |spec| spec.pairs, |_n, _o, _a| ();
    Exclude write::exclude, |spec| spec.excludes, |_n, _o, _a| ();
    Flex write::flex, |spec| spec.flexes, |new, old, a| if a != "cellcount" {
        new.empty_cells.clone_from(&old.empty_cells);
    };
    Equality write::equality, |spec| spec.equalities, |_n, _o, _a| ();
    Tendon write::tendon, |spec| spec.tendons, |_n, _o, _a| ();
    Actuator write::actuator, |spec| spec.actuators, |new, old, _a| new.keyed.clone_from(&old.keyed);
    Sensor write::sensor, |spec| spec.sensors, |_n, _o, _a| ();
    Numeric write::numeric, |spec| spec.numerics, |_n, _o, _a| ();
    Text write::text_of, |spec| spec.texts, |_n, _o, _a| ();
    Tuple write::tuple, |spec| spec.tuples, |_n, _o, _a| ();
    Key write::key, |spec| spec.keys, |_n, _o, _a| ();
}
