//! Leader arms: a person moves one by hand, and a robot follows it joint by joint. Its kinematics may differ from the robot's.

mod arm;
mod config;
mod gravity;

pub use arm::LeaderArm;
pub use config::{CatchUp, GravitySettings, LeaderConfig, LedJoint};
pub use gravity::Gravity;
