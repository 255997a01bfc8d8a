//! Classical problems of control.

pub mod balance;
pub mod ball_on_beam;
pub mod car_trailer;
mod ground;
pub mod hopper_boom;
pub mod knife_edge;
pub mod planar_arm;
pub mod swing_up;
pub mod tendon_finger;
pub mod unicycle;
