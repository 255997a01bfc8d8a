//! What depends on positions: poses, centres of mass, cameras, tendon paths, and the Jacobians of points and frames.

pub mod camera;
pub mod chain;
pub mod com;
pub mod frame;
pub mod jacobian;
pub mod kinematics;
pub mod tendon;
pub mod wrap;
