//! The numbers of a model: sizes, arrays, options, and the enumerations that integers stand for. Each array is declared once,
//! in the table of `fields.rs`.

pub mod array;
mod declare;
mod element_names;
mod fields;
mod flags;
mod flex_rows;
mod options;
pub(crate) mod reader;
mod setting;
mod skin_rows;
mod types;

pub(crate) use fields::ArrayId;
pub use fields::{Arrays, Columns, Draft, Rows, counts};
pub use flags::{Disable, Enable};
pub use options::{
    Options, Statistic, Visual, VisualGlobal, VisualHeadlight, VisualMap, VisualQuality, VisualRgba,
    VisualScale,
};
pub use types::{
    BiasType, ColorSpace, Cone, ConstraintState, ConstraintType, ContactField, DataType, DynType, EqType,
    FlexSelf, GainType, GeomType, Integrator, Jacobian, JointType, LengthRangeMode, LightType, ObjType,
    Projection, RayField, SameFrame, SensorType, SleepPolicy, Solver, Stage, TextureRole, TextureType,
    TrackMode, TrnType, WrapType, bounds, input,
};
