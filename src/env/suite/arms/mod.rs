//! Arms at a table.

mod delivery;
pub(super) mod pick_place;
pub(super) mod push;
pub(super) mod reach;
