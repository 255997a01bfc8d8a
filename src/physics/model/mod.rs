//! The compiled model: arrays, options, and the enumerations their integers stand for.
//!
//! ```
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! assert_eq!((model.nq, model.nv, model.nbody), (7, 6, 2));
//! let ball = model.body("ball").ok_or("no ball")?;
//! assert_eq!(model.body_mass[ball], model.body(ball).mass());
//!
//! let mut wide = model.clone();
//! let geom = wide.geom("ball").ok_or("no geom")?;
//! wide.edit(|m| m.geom_size[geom][0] = 0.2)?;
//! assert_eq!((wide.geom_rbound[geom], model.geom_rbound[geom]), (0.2, 0.1));
//! wide.overwrite(|m| m.geom_size[geom][0] = 0.3)?;
//! assert_eq!(wide.geom_rbound[geom], 0.2, "nothing is derived");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod appearance;
mod distance_field;
pub(crate) mod flex;
mod not_simulated;
mod plugin_config;
mod plugin_error;
pub(crate) mod reflected_load;
mod suggestion;
mod with_plugins;

pub use crate::arrays::{
    Arrays, BiasType, ColorSpace, Columns, Cone, ConstraintState, ConstraintType, ContactField, DataType,
    Disable, Draft, DynType, Enable, EqType, FlexSelf, GainType, GeomType, Integrator, Jacobian, JointType,
    LengthRangeMode, LightType, ObjType, Options, Projection, RayField, Rows, SameFrame, SensorType,
    SleepPolicy, Solver, Stage, Statistic, TextureRole, TextureType, TrackMode, TrnType, Visual,
    VisualGlobal, VisualHeadlight, VisualMap, VisualQuality, VisualRgba, VisualScale, WrapType, array,
    bounds, counts, input,
};
pub use appearance::{Appearance, Mark};
pub use distance_field::Field;
pub use not_simulated::NotSimulated;
pub use plugin_config::{AttributeError, Config};
pub use plugin_error::{PluginError, RegistryError};
#[doc(hidden)]
pub use reflected_load::dof_armature;
pub use suggestion::Suggestions;
pub use with_plugins::{
    ActuatorInputs, AppearanceInputs, Capability, Instance, Model, PassiveInputs, Plugin, Registry,
    SensorInputs,
};
pub(crate) use with_plugins::{Instances, Running};

// Public names of what stands above the model: its file, and why an edit of it is refused.
pub use crate::binary;
pub use crate::edit::EditError;
