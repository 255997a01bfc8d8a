//! Classical problems of control, on models of our own: fewer motors than joints, wheels and edges that cannot move sideways, more
//! motors than joints, contact. A controller of `robohive-control` solves each.

pub(super) mod acrobot;
pub(super) mod ball_on_beam;
pub(super) mod car_trailer;
pub(super) mod double_pole;
pub(super) mod furuta;
mod ground;
pub(super) mod hopper_boom;
pub(super) mod knife_edge;
pub(super) mod planar_arm;
pub(super) mod tendon_finger;
pub(super) mod unicycle;
