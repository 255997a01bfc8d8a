//! Soft things under the hand of an arm.

pub mod grain_pour;
mod hand;
pub mod rope_straighten;
pub mod rope_wrap;
pub mod sponge_press;
mod strand;
