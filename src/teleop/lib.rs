//! A person drives an environment by hand and records demonstrations.
//!
//! | stage | what it does |
//! |---|---|
//! | [`Keyboard`], [`Gamepad`], [`SpaceMouse`], [`Quest`] | from the bytes of a device to [`Event`]s; pure, wherever the bytes come from |
//! | [`LeaderArm`] | the servos of an arm that is led by hand, which may carry its weight |
//! | [`Held`] | from events to what is held during a tick; what is not repeated is let go |
//! | [`Mapping`] | from what is held to an [`Input`]: motions and marks, by a file |
//! | [`Pilot`] | from motions to actions: an [`Arm`] by inverse kinematics, joints, or a base that trots |
//! | [`Session`] | episodes: marked, thrown away, gone back in, kept; a tick is a call, so that nothing here has a clock |
//! | [`devices`] | terminals and devices of this machine, opened and read |
//!
//! ```
//! use robohive_teleop::{Control, Event, Button, Held, Key, Mapping, Plan, Session};
//!
//! let env = env::Env::make("hive/FrankaReach-v0", &env::OwnModels, &env::Options::default())?;
//! let mut mapping = Mapping::default();
//! let mut session = Session::new(env, Control::Hand, &mapping, Plan::default())?;
//! let mut held = Held::default();
//! held.apply(Event::Press(Button::Key(Key::Char('d'))), 0.0);
//! let ticked = session.tick(&mapping.read(&held.sample(0.01)))?;
//! assert!(ticked.stepped && ticked.refused.is_none());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arm;
pub mod devices;
mod effect;
mod error;
mod event;
mod gamepad;
mod glove;
mod handover;
mod held;
mod keyboard;
mod latency;
mod lead;
mod leader;
mod link;
mod mapping;
mod moments;
mod motion;
mod pilot;
mod plan;
mod quest;
mod reached;
mod session;
mod settings;
mod space_mouse;
mod trot;

pub use arm::Arm;
pub use error::TeleopError;
pub use event::{Axis, Button, Device, Event, HandPose, Key, Lost};
pub use gamepad::{Ends, Gamepad};
pub use glove::{Calibration, Glove};
pub use handover::INTERVENTION;
pub use held::{BELIEF, Held, Sample};
pub use keyboard::{Answer, Keyboard, QUESTION, TURN_OFF, TURN_ON};
pub use latency::Latencies;
pub use lead::Leading;
pub use leader::{CatchUp, Gravity, GravitySettings, LeaderArm, LeaderConfig, LedJoint};
pub use mapping::{DEFAULTS, Mapping};
pub use motion::{ARMS, ArmMotion, HandMove, Input, MARKS, Mark, Motion};
pub use pilot::{Control, Pilot};
pub use plan::{Finished, Plan, Ticked};
pub use quest::Quest;
pub use reached::Reached;
pub use session::{JUDGED, Session};
pub use settings::{ArmSettings, BaseSettings, Gains};
pub use space_mouse::SpaceMouse;
pub use trot::Trot;
