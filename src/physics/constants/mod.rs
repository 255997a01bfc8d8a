//! Constants of a model, derived from its reference configuration.
//!
//! ```
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! assert_eq!(model.stat.meanmass, 1.0);
//! let ball = model.body("ball").ok_or("no ball")?;
//! let heavy = model.edited(|m| m.body_mass[ball.index()] = 3.0)?;
//! assert_eq!((heavy.stat.meanmass, model.body(ball).mass()), (3.0, 1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[doc(hidden)]
pub mod bending_factor;
#[doc(hidden)]
pub mod flex_pattern;
mod flex_reference;
mod inverse_weight;
pub mod length_range;
pub(crate) mod reference;
pub mod set_const;
#[doc(hidden)]
pub mod sparsity;
pub(crate) mod statistic;
