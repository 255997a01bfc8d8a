//! Limbs that muscles move.

mod limb;
pub mod pose;
pub mod reach;
