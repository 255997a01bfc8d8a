//! Muscle-driven finger, elbow, hand and legs.

pub(super) mod baoding;
pub(super) mod key_turn;
pub(super) mod leg_stand;
pub(super) mod leg_walk;
pub(super) mod object_hold;
pub(super) mod pen_twirl;
pub(super) mod pose;
pub(super) mod reach;
pub(super) mod shape_reorient;
mod terrain;
mod tips;
mod turning;
