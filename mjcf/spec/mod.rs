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
//!
//! ```
//! let parsed = robohive_mjcf::parse_str("<mujoco><worldbody><body name='arm'><joint/></body></worldbody></mujoco>")?;
//! let arm = &parsed.spec.world.bodies[0];
//! assert_eq!((&*arm.name, arm.joints[0].axis), ("arm", [0.0, 0.0, 1.0]));
//! assert_eq!(parsed.sources.position(arm.loc).unwrap().column, 20);
//! # Ok::<(), robohive_mjcf::diagnostic::Diagnostics>(())
//! ```

use std::collections::BTreeMap;

use crate::diagnostic::Loc;

mod actuator;
mod asset;
mod attribute_types;
mod classes;
mod constraint;
mod custom;
mod element;
pub(crate) mod field;
mod flex;
mod flexcomp;
mod keys;
mod orientation;
mod plugin;
mod sensor;
mod settings;
mod tree;

pub use actuator::*;
pub use asset::*;
pub(crate) use classes::ClassId;
pub use classes::{Class, Classes, MAIN};
pub use constraint::*;
pub use custom::*;
pub use element::{Limited, SOLIMP, SOLREF};
pub use field::{Fields, Form, Value};
pub use flex::*;
pub(crate) use flexcomp::{Dof, EqualityOf, Flexcomp, Pin};
pub use orientation::{Orientation, OrientationError};
pub(crate) use orientation::{UNIT, from_axes, minimal_rotation, resolve};
pub use plugin::*;
pub use sensor::*;
pub use settings::*;
pub use tree::*;

/// A model as its file describes it.
#[derive(Clone, Debug, Default)]
pub struct Spec {
    /// Name of the model.
    pub modelname: String,
    /// Settings of the compile.
    pub compiler: Compiler,
    /// Settings of attached models by the index of their first text.
    pub attached: BTreeMap<u32, Compiler>,
    /// Options of the simulation.
    pub option: physics::model::Options,
    /// Settings for pictures.
    pub visual: physics::model::Visual,
    /// Statistics that replace computed ones.
    pub stat: StatisticOverride,
    /// Sizes that are asked for.
    pub size: Size,
    /// The world body; everything in the tree hangs below it.
    pub world: Body,
    /// Default classes, for elements that are added.
    pub classes: Classes,
    /// Frames, parents before children.
    pub frames: Vec<Frame>,
    /// Plugins that the model may use.
    pub extensions: Vec<Extension>,
    /// Instances of plugins that elements refer to.
    pub plugins: Vec<PluginInstance>,
    /// Meshes.
    pub meshes: Vec<Mesh>,
    /// Skins.
    pub skins: Vec<Skin>,
    /// Height fields.
    pub hfields: Vec<Hfield>,
    /// Textures.
    pub textures: Vec<Texture>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Pairs of geoms that collide whatever their bits say.
    pub pairs: Vec<Pair>,
    /// Pairs of bodies that do not collide.
    pub excludes: Vec<Exclude>,
    /// Deformable bodies.
    pub flexes: Vec<Flex>,
    /// Equality constraints.
    pub equalities: Vec<Equality>,
    /// Tendons.
    pub tendons: Vec<Tendon>,
    /// Actuators.
    pub actuators: Vec<Actuator>,
    /// Sensors.
    pub sensors: Vec<Sensor>,
    /// Custom arrays of numbers.
    pub numerics: Vec<Numeric>,
    /// Custom texts.
    pub texts: Vec<Text>,
    /// Custom lists of references.
    pub tuples: Vec<Tuple>,
    /// Keyframes of this model.
    pub keys: Vec<Key>,
    /// Keyframes of attached models.
    pub kept_keys: Vec<KeptKey>,
}

impl Spec {
    /// The settings that an element at `loc` is compiled with: the settings of the text that it stands in.
    pub fn compiler_at(&self, loc: Loc) -> &Compiler {
        let model = if loc == Loc::NONE { None } else { self.attached.range(..=loc.file).next_back() };
        model.map_or(&self.compiler, |(_, compiler)| compiler)
    }
}
