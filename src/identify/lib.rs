//! System identification: parameters of a model from a log of commands and readings.
//!
//! A [`Log`] has the initial state of a robot, the controls that it was given and what its sensors read. [`Quantity::choose`]
//! makes [`Parameter`]s of damping, friction, armature, gains, masses and delay; [`identify`] finds the values with which
//! simulated readings are nearest to recorded ones, how certain they are, and which of them the log cannot tell.
//! [`patched`] writes them into a description, and [`report()`] says all of it on one page.
//!
//! The readings of each channel are weighted by the noise that is left in it after a first fit, so that channels of different
//! units count by what they know (feasible generalised least squares: Seber and Wild, "Nonlinear regression", 2003, section
//! 2.1.4). Residuals are minimised by Levenberg and Marquardt's method within bounds, derivatives are central differences,
//! simulated side by side.
//!
//! ```
//! # use physics as robohive_physics;
//! use robohive_identify::{Log, Options, Quantity, Readings, identify};
//! use robohive_physics::{Data, step};
//!
//! let text = |damping: f64| format!("<mujoco><worldbody><body><joint name='hinge' axis='0 1 0' damping='{damping}'/>\
//!     <geom type='capsule' size='.02' fromto='0 0 0 .3 0 0'/></body></worldbody></mujoco>");
//! let robot = mjcf::load_str(text(0.03))?.model;
//! let mut data = Data::new(&robot);
//! let mut positions = Vec::new();
//! for _ in 0..400 {
//!     positions.push(data.state.qpos[0]);
//!     step(&robot, &mut data)?;
//! }
//! let times = (0..400).map(|row| f64::from(row) * robot.opt.timestep).collect();
//! let model = mjcf::load_str(text(0.1))?.model;
//! let log = Log::of_arrays("pendulum", times, &Data::new(&model), vec![], Readings::positions(&model, positions), &model)?;
//! let parameters = Quantity::choose("damping", &model)?;
//! let found = identify(&model, &[log], &parameters, &Options::default())?;
//! assert!((found.values[0] - 0.03).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod choose;
mod command;
mod error;
mod fit;
mod log;
mod minimise;
mod parameter;
mod patch;
mod problem;
mod quantity;
mod report;
mod simulate;
mod svg;
mod uncertainty;
mod window;

pub use error::IdentifyError;
pub use fit::{Found, Options, identify};
pub use log::{Log, Readings};
pub use minimise::Trace;
pub use parameter::{Parameter, Prior};
pub use patch::{fragment, patched};
pub use quantity::Quantity;
pub use report::report;
pub use svg::{Curve, plot};
pub use uncertainty::Direction;
