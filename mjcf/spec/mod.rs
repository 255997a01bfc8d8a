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
mod constraint;
mod custom;
mod element;
mod orientation;
mod sensor;
mod settings;
mod tree;

pub(crate) use actuator::input;
pub use actuator::*;
pub use asset::*;
pub use constraint::*;
pub use custom::*;
pub use element::{Limited, SOLIMP, SOLREF};
pub use orientation::Orientation;
pub(crate) use orientation::{UNIT, minimal_rotation, resolve};
pub use sensor::*;
pub use settings::*;
pub use tree::*;

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
