//! Robots: devices with sensors and actuators, simulated or real, behind one face.
//!
//! A [`Robot`] turns the actions of a policy into controls (units, limits of velocity, position and effort) and what
//! its sensors say into readings (range, noise, delay). What it is made of stands in a [`Config`]; without one it reads
//! the whole state and commands every actuator.
//!
//! ```
//! # use physics as robohive_physics;
//! # use random as robohive_random;
//! use robohive_robot::{Config, Options, Robot};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint name='elbow' axis='0 1 0'/><geom size='.1' pos='.3 0 0'/></body></worldbody>
//!      <actuator><position name='servo' joint='elbow' kp='50' kv='5'/></actuator>
//!      <sensor><jointpos name='angle' joint='elbow'/></sensor></mujoco>",
//! )?
//! .model;
//! let config = Config::from_toml(
//!     "[[device]]
//!      name = 'arm'
//!      sensor = [{ name = 'angle', range = [-1.5, 1.5], noise = 0.01 }]
//!      actuator = [{ name = 'servo', pos_range = [-1.5, 1.5], vel_range = [-2, 2] }]",
//!     "arm.toml",
//! )?;
//! let mut robot = Robot::new(&model, Some(&config), Options::default())?;
//! let mut rng = robohive_random::Generator::pcg64(1_u64);
//! let mut data = robohive_physics::Data::new(&model);
//! robohive_physics::forward(&model, &mut data)?;
//! robot.reset(&model, &data, &mut rng)?;
//!
//! // The action asks for 1.5 rad; at 2 rad/s that is 0.2 rad after a tenth of a second.
//! let controls = robot.control(&model, &data, &[1.0], 0.1)?;
//! assert_eq!(controls, [0.2]);
//! data.state.ctrl.copy_from_slice(controls);
//! for _ in 0..50 {
//!     robohive_physics::step(&model, &mut data)?;
//! }
//! robohive_physics::forward(&model, &mut data)?;
//! let readings = robot.sense(&model, &data, &mut rng);
//! assert_eq!((readings.time, readings.values[0]), (data.time(), data.state.qpos[0]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Devices
//!
//! Behind a robot stand devices that implement [`Device`]: [`Simulated`] ones, or with [`Options::hardware`] those that
//! a [`Registry`] makes for the `interface` of each device of the config, such as a [`Replay`] of a recorded log.
//!
//! # RoboHive 0.7
//!
//! The same config means the same here. [`QUIRKS`] lists what the original does otherwise than it should, and
//! [`Compat`] decides whether that is kept.

mod action;
mod binding;
mod cast;
mod compat;
mod config;
mod delay;
mod device;
mod effort;
mod error;
mod interval;
mod inverse_kinematics;
mod keeper;
mod links;
mod memory;
mod options;
mod pacer;
mod reach;
mod reading;
mod remap;
mod robot;
mod symmetric;

pub use binding::free_joint;
pub use cast::Cast;
pub use compat::{Compat, QUIRKS, Quirk, UnknownCompat};
pub use config::{
    ActuatorConfig, CameraConfig, Config, ConfigError, DeviceConfig, Fallen, HardwareId, Interface, Named,
    NominalPose, Roles, SensorConfig, Value, Walk,
};
pub use device::{Device, Fault, Record, Registry, Replay, Simulated, Units};
pub use error::{Part, RobotError};
pub use inverse_kinematics::{Pose, Search, Solution};
pub use keeper::{ForeignWords, Keeper};
pub use memory::Memory;
pub use options::{ActionMode, Noise, Options, UnknownMode};
pub use pacer::{Clock, Pacer, WallClock};
pub use reach::Reach;
pub use reading::Readings;
pub use remap::Space;
pub use robot::Robot;
