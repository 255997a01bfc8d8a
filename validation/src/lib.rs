//! Comparison of our physics and compiler with recorded MuJoCo runs.

pub mod bits;
pub mod c_library;
pub mod collide;
pub mod compare;
pub mod compile;
pub mod controllers;
pub mod demonstrations;
pub mod draws;
pub mod environments;
pub mod episodes;
pub mod hulls;
pub mod laws;
pub mod motion;
mod own_ids;
pub mod pictures;
pub mod policies;
pub mod reference;
pub mod robots;
pub mod round_trip;
pub mod scenes;
pub mod shipped;
pub mod solver;
mod stage_list;
pub mod stages;
pub mod status;
pub mod tolerance;
pub mod wider;
