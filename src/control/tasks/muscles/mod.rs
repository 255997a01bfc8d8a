//! Limbs that muscles move.

mod limb;
pub mod pose;
mod pulls;
pub mod reach;
mod soles;
pub mod stand;
