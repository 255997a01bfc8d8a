//! Arms that a person leads by hand, and that a robot follows joint by joint: servos with the robot's kinematics, or any others.

mod arm;
mod config;
mod gravity;

pub use arm::LeaderArm;
pub use config::{CatchUp, GravitySettings, LeaderConfig, LedJoint};
pub use gravity::Gravity;
