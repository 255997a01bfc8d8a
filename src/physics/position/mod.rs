//! What depends on positions: poses, centres of mass, cameras, tendon paths, and the Jacobians of points and frames.
//!
//! ```
//! use robohive_physics::{Data, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body name='rod'><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let rod = model.body("rod").ok_or("no rod")?;
//! let mut data = Data::new(&model);
//! data.state.qpos[0] = std::f64::consts::FRAC_PI_2;
//! forward(&model, &mut data)?;
//! assert!((data.body(rod).xipos()[2] + 1.0).abs() < 1e-12, "it hangs");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[doc(hidden)]
pub mod camera;
pub(crate) mod chain;
#[doc(hidden)]
pub mod com;
#[doc(hidden)]
pub mod frame;
pub mod jacobian;
#[doc(hidden)]
pub mod kinematics;
#[doc(hidden)]
pub mod tendon;
pub(crate) mod wrap;
