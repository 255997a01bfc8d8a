//! What an MJCF file says, as typed elements: the reader fills a [`Spec`], `compile` turns it into a `Model`.
//!
//! Conventions
//! - Fields are called as in MuJoCo's `mjSpec`, and `Default` is MuJoCo 3.12's default. Default classes, includes and
//!   `<replicate>` are already expanded; frames are kept (an element carries an index into [`Spec::frames`]).
//! - Numbers stand as in the file. Angles are converted by `compile` with `compiler.degree`: joint `range`, `ref`
//!   and `springref` of hinges and (range only) balls, all alternative orientations, equality `joint` coefficients
//!   are not touched. Camera `fovy` and light `cutoff` are always degrees.
//! - `Option` is `None` where the file is silent and silence has a meaning of its own; an empty string is "no reference".
//! - References are names; `compile` resolves them and reports a missing one at the `loc` of the element.
//! - Asset files are resolved by the reader: `file` is what a `FileProvider` opens, `path` what MuJoCo stores.

use std::collections::BTreeMap;

use crate::diagnostic::Loc;

mod actuator;
mod asset;
mod constraint;
mod custom;
mod sensor;
mod settings;
mod tree;

pub use actuator::*;
pub use asset::*;
pub use constraint::*;
pub use custom::*;
pub use sensor::*;
pub use settings::*;
pub use tree::*;

/// Declares elements with their defaults; every element also has a `name` and a `loc`.
macro_rules! elements {
    ($($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $field:ident : $t:ty = $default:expr,)* })*) => {$(
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs)]
        pub struct $name {
            /// Name of the element, empty when it has none.
            pub name: String,
            /// Where the element stands in the sources.
            pub loc: crate::diagnostic::Loc,
            $($(#[$doc])* pub $field: $t,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { name: String::new(), loc: crate::diagnostic::Loc::NONE, $($field: $default,)* }
            }
        }
    )*};
}
use elements;

/// Constraint time constant and damping ratio when the file is silent.
pub const SOLREF: [f64; 2] = [0.02, 1.0];
/// Constraint impedance when the file is silent.
pub const SOLIMP: [f64; 5] = [0.9, 0.95, 0.001, 0.5, 2.0];

/// Three-valued switch: `auto` follows from the presence of a range when `compiler.autolimits` is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum Limited {
    False,
    True,
    #[default]
    Auto,
}

/// An orientation that is not a quaternion; angles in the unit of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// Axis (any length) and angle.
    AxisAngle([f64; 4]),
    /// X axis and a second axis that spans the xy-plane.
    XyAxes([f64; 6]),
    /// Z axis; minimal rotation from the vertical.
    ZAxis([f64; 3]),
    /// Euler angles in the order of `compiler.eulerseq`.
    Euler([f64; 3]),
}

/// A model as its file describes it.
#[derive(Clone, Debug, Default)]
#[allow(missing_docs)]
pub struct Spec {
    pub modelname: String,
    pub compiler: Compiler,
    /// Settings of attached models by the index of their first text.
    pub attached: BTreeMap<u32, Compiler>,
    pub option: physics::model::Options,
    pub visual: physics::model::Visual,
    pub stat: StatisticOverride,
    pub size: Size,
    /// The world body; everything in the tree hangs below it.
    pub world: Body,
    /// Frames, parents before children.
    pub frames: Vec<Frame>,
    pub meshes: Vec<Mesh>,
    pub hfields: Vec<Hfield>,
    pub textures: Vec<Texture>,
    pub materials: Vec<Material>,
    pub pairs: Vec<Pair>,
    pub excludes: Vec<Exclude>,
    pub equalities: Vec<Equality>,
    pub tendons: Vec<Tendon>,
    pub actuators: Vec<Actuator>,
    pub sensors: Vec<Sensor>,
    pub numerics: Vec<Numeric>,
    pub texts: Vec<Text>,
    pub tuples: Vec<Tuple>,
    pub keys: Vec<Key>,
    /// Keyframes of attached models.
    pub kept_keys: Vec<KeptKey>,
}

impl Spec {
    /// The settings that an element at `loc` is compiled with: those of the text it stands in.
    pub fn compiler_at(&self, loc: Loc) -> &Compiler {
        let model = if loc == Loc::NONE { None } else { self.attached.range(..=loc.file).next_back() };
        model.map_or(&self.compiler, |(_, compiler)| compiler)
    }
}
