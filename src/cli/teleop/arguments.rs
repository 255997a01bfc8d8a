//! The arguments of `teleop`, and the help that teaches it.

use super::device::DeviceChoice;
use crate::input::library::{Making, Source};
use crate::pictures::film::FilmArguments;
use crate::recordings::names::{PictureForm, PrecisionName};
use crate::robots::live::Live;
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;

/// Drive an environment by hand, and record demonstrations
#[derive(Args)]
#[command(
    after_help = "An episode begins from the reset of its seed, SEED, SEED + 1 and so on, and time stands still until something moves.

Keys (those of RoboHive, and what episodes need):
  d a  w x  q z      the hand along x, y, z         arrows  , .    turn it: roll, pitch, yaw
  [ ]                close, open the gripper         v              a quarter of the speed while held
  Enter              success, next episode           Backspace      failure, next episode
  Delete             throw away, same reset again    Tab            throw away, next reset
  Space              pause                           s              slow motion
  b n                back and forward by one state   PgUp PgDn      by a second
  p                  with --policy: take over, give back  Esc       end
Any motion goes on from the state that is shown: what was gone back over is no part of the episode. With --control joints keys in \
pairs move one joint each: 1 2, 3 4, 5 6, 7 8, 9 0, r f, t g, y h, u j, i k. With --control base w and x walk forward and back, a and d sideways, left and right \
turn; on a pad the left stick walks and the right one turns.

Gamepad: left stick and triggers move, the cross and TL TR turn, WEST EAST close and open, NORTH slows down, SOUTH is success, a \
press of the left stick throws away, of the right one pauses, SELECT and START end. Six-axis mouse: its six axes; left and right button close and \
open, both end. Quest: the right hand is followed while RG is held, rightTrig closes, A success, X again, Y pause, B end; with --left-site the left hand leads a second arm by LG and leftTrig. A glove leads the joints of a hand, by --calibration FILE; Space begins and pauses. So it is with a leader arm: the robot comes to where it is, slowly, and then follows it joint by joint; with --arm its servos carry its weight where \
its config says how. The keyboard's marks \
work beside every device.

With --policy POLICY the policy acts once time goes on (Space), and any motion of yours takes over from where the robot is; p gives back. The line says who acts, and env_infos/intervention of a recording holds it for every step: 1 where you did.

--mapping FILE changes all of this; --print-mapping prints the mapping that is used without one, to begin from. A target whose joints would be \
more than 0.5 rad away, or out of range, is not taken. Terminals with the kitty keyboard protocol tell when keys are released; in others a key counts as released 0.15 s after its last \
repetition. --preview shows the scene in the terminal.

--record writes as `robohive run --record` does, an episode when it is finished, so that a kill loses none of those; teleop/success \
holds the person's judgement. `robohive view FILE` shows it. --layout lerobot writes a dataset of LeRobot instead, complete after every episode; one \
that is there goes on if its features and its frames a second are those of the session. Frames also have judged_success, and intervention with --policy.

--hardware CONFIG drives the devices that a robot config names, and nothing moves without --arm; --rehearse puts simulated ones in their \
place. The robot goes to the start of an episode by itself and rests there until you move it. What a device has not said for 0.15 s is over, \
and the robot stops where it was last sent. A pause repeats the last command, so that the watchdogs of the devices know that the session lives; when it \
dies, they make the devices safe. Hardware goes neither back in time nor in slow motion.

Examples:
  robohive teleop --print-mapping
  robohive teleop hive/FrankaReach-v0 --preview --record reach.h5
  robohive teleop hive/FrankaReach-v0 --device gamepad --record reach.h5 --episodes 20
  robohive teleop hive/FrankaReach-v0 --device quest --record reach.h5
  robohive teleop hive/FrankaReach-v0 --policy random --record corrected.h5
  robohive teleop hive/FrankaReach-v0 --record reach --layout lerobot --task reach
  robohive teleop hive/ElbowPose-v0 --control joints --video elbow.mp4
  robohive teleop hive/QuadrupedWalk-v0 --control base --record walk.h5
  robohive teleop hive/QuadrupedWalk-v0 --control joints --arm --rehearse\\
 --hardware assets/quadruped/servos.toml"
)]
pub struct Teleop {
    /// The environment
    #[command(flatten)]
    pub source: OptionalSource,
    /// What drives: keyboard, gamepad, spacemouse (Linux), quest[:HOST:PORT] (by an adb server), glove:PORT (a CyberGlove on a serial port), leader:FILE (an arm that is led by hand, by its config), phone[:PORT] (a page for phones and headsets), phone-lan[:PORT] (the same on the local network behind TLS; builds with --features tls)
    #[arg(long, value_name = "DEVICE", default_value = "keyboard", value_parser = DeviceChoice::read)]
    pub device: DeviceChoice,
    /// File of the device, instead of the first that is found; of a quest a pipe with lines of its log
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub path: Option<PathBuf>,
    /// What a glove's sensors say of the joints of a hand (TOML); needed for gloves
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub calibration: Option<PathBuf>,
    /// What acts until you take over, by any motion or by p: random, zero, or a file with a policy, as for `robohive run`
    #[arg(long, value_name = "POLICY")]
    pub policy: Option<String>,
    /// What is driven; by a glove or a leader arm always joints
    #[arg(long, value_name = "WHAT", default_value = "hand")]
    pub control: ControlName,
    /// Site of the model that is the hand [default: the first that there is of those that the mapping names]
    #[arg(long, value_name = "NAME")]
    pub site: Option<String>,
    /// Site of a left arm that is driven beside it: by the left controller of a headset, or as a mapping says
    #[arg(long, value_name = "NAME")]
    pub left_site: Option<String>,
    /// Mapping of keys, buttons and axes (TOML); sections that it lacks are the usual ones
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub mapping: Option<PathBuf>,
    /// Print the usual mapping and end
    #[arg(long, exclusive = true)]
    pub print_mapping: bool,
    /// Seed of the first reset
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub seed: u64,
    /// Episodes to keep, after which the session ends [default: until it is ended]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub episodes: usize,
    /// Steps after which an episode ends by itself, judged by the task [default: never]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub horizon: usize,
    /// Steps in a row that must solve the task for an episode to end as a success by itself [default: never]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub solved_for: usize,
    /// Record every finished episode in this file, .h5 or .hdf5 (HDF5), or .npz, and replace it; a folder with --layout lerobot, which goes on
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub record: Option<PathBuf>,
    /// What is recorded
    #[arg(long, default_value = "robohive", requires = "record")]
    pub layout: LayoutName,
    /// What the episodes of --layout lerobot are attempts at, in words [default: the id]
    #[arg(long, value_name = "TEXT", requires = "record")]
    pub task: Option<String>,
    /// Where --layout lerobot keeps the images of --visual
    #[arg(long, default_value = "video", requires = "visual")]
    pub pictures: PictureForm,
    /// Precision of the recorded numbers; that of RoboHive's own files is reduced
    #[arg(long, default_value = "full", requires = "record")]
    pub precision: PrecisionName,
    /// Record the images of the visual keys too, which takes their drawing
    #[arg(long, requires = "record")]
    pub visual: bool,
    /// Its video
    #[command(flatten)]
    pub film: FilmArguments,
    /// Its robot
    #[command(flatten)]
    pub live: Live,
}

/// An environment, where one is named.
#[derive(Args)]
pub struct OptionalSource {
    /// Id of the environment, as `robohive list` shows them
    #[arg(value_name = "ID", required_unless_present = "print_mapping")]
    pub id: Option<String>,
    /// How it is made
    #[command(flatten)]
    pub making: Making,
}

/// What is recorded, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LayoutName {
    /// A file, rows by environment: time, observations, actions, rewards, done, env_infos/...
    Robohive,
    /// A file, rows by robot: data/..., derived/..., config/...
    Roboset,
    /// A folder, a dataset of LeRobot (version 3.0): frames with observation.state, action, next.reward...
    Lerobot,
}

/// What can be driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ControlName {
    /// The hand of an arm, by inverse kinematics
    Hand,
    /// Joints one by one
    Joints,
    /// A robot on four legs, by its velocity
    Base,
}

impl Teleop {
    /// The environment, which is named wherever the mapping is not printed.
    pub fn environment(&self) -> Option<Source> {
        let OptionalSource { id, making } = &self.source;
        Some(Source { id: id.clone()?, making: making.clone() })
    }
}
