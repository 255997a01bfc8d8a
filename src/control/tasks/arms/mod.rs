//! Arms: reaching, and grasping and placing by scripts of moves.

pub mod arm;
pub mod extent;
pub mod follower;
pub mod frame;
pub mod grasp;
pub mod hand;
pub mod moves;
mod named;
pub mod pick_place;
pub mod reach;
mod starts;
