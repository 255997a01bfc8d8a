//! Soft things under the hand of an arm.

pub mod cloth_fold;
pub mod cloth_hang;
pub mod cloth_spread;
pub mod grain_flatten;
pub mod grain_pour;
pub mod grain_scoop;
pub mod held;
mod rods;
pub mod rope_straighten;
pub mod rope_thread;
pub mod rope_wrap;
pub mod sponge_press;
pub mod sponge_wipe;
mod strand;
