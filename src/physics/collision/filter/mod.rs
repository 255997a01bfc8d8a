//! What leaves pairs out: sleep, contact types, a program.
//!
//! ```
//! use robohive_physics::collision::filter::{ByType, Decided, PairFilter};
//!
//! let m = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom type='plane' size='1 1 1'/><body><freejoint/><geom size='.1' contype='2' conaffinity='2'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! assert!(!ByType.admits(&m, 0, 1, || false));
//! assert!(Decided(|g1, g2| (g1, g2) == (0, 1)).admits(&m, 0, 1, || false));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod pairs;
mod sleeping;
mod touching;

pub use pairs::{ByType, Decided, PairFilter};
pub(crate) use sleeping::SleepFilter;
pub use touching::{Touching, touching};
