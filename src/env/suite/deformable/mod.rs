//! Soft things under the hand of an arm, the Panda's gripper or Adroit's fingers: a rope, a sponge, grains, a cloth. Models of our own
//! (`assets/deformable`), and for each task a controller of `robohive-control` that solves it.
//!
//! Every task observes `arm_pos` and `arm_vel`, joints and fingers \[rad, m; rad/s, m/s\], and `tip`, the place between the fingertips
//! \[m\]; the keys of the thing are its own. Places are in the world's frame: the Panda stands at the origin, the table's top is
//! 0.76 m up. A step lasts 0.08 s. Actions are what the servos of the joints are told, -1 to 1 for their ranges. An episode ends when the
//! task has been solved for as long as it asks.

mod bench;
mod cloth;
pub(super) mod cloth_fold;
pub(super) mod cloth_hang;
pub(super) mod cloth_spread;
mod grain;
pub(super) mod grain_flatten;
pub(super) mod grain_pour;
pub(super) mod grain_scoop;
mod rope;
pub(super) mod rope_straighten;
pub(super) mod rope_thread;
pub(super) mod rope_wrap;
pub(super) mod sponge_press;
pub(super) mod sponge_wipe;

/// Time steps of the physics in one step of the environment: 0.08 s at 2 ms.
const FRAME_SKIP: usize = 40;
