//! Dexterous manipulation with the Adroit hand.

mod adroit;
pub(super) mod baoding;
pub(super) mod door;
pub(super) mod hammer;
pub(super) mod pen;
pub(super) mod relocate;
