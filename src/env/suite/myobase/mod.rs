//! Muscle-driven finger, elbow, hand and legs.

mod baoding;
mod key_turn;
mod leg_stand;
mod leg_walk;
mod object_hold;
mod pen_twirl;
mod pose;
mod reach;
mod shape_reorient;
mod terrain;
mod tips;
mod turning;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] = &[
    ("muscle_pose", pose::build),
    ("muscle_reach", reach::build),
    ("key_turn", key_turn::build),
    ("object_hold", object_hold::build),
    ("pen_twirl", pen_twirl::build),
    ("shape_reorient", shape_reorient::build),
    ("muscle_baoding", baoding::build),
    ("leg_stand", leg_stand::build),
    ("leg_walk", leg_walk::build),
];
