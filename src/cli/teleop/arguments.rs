//! The arguments of `teleop`, and its help.

use super::device::DeviceChoice;
use crate::input::library::{Making, Source};
use crate::pictures::film::FilmArguments;
use crate::recordings::names::{LayoutName, PictureForm, PrecisionName};
use crate::robots::live::Live;
use clap::builder::PossibleValue;
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
  p                  with --policy: take, return control  Esc       end
Any motion continues from the state that is shown; later states are removed from the episode. With --control joints pairs \
of keys move one joint each: 1 2, 3 4, 5 6, 7 8, 9 0, r f, t g, y h, u j, i k. With --control base w and x walk forward and back, a and d sideways, left and right \
turn; on a pad the left stick walks and the right one turns.

Gamepad: left stick and triggers move, the cross and TL TR turn, WEST EAST close and open, NORTH slows down, SOUTH is success, a \
press of the left stick throws away, of the right one pauses, SELECT and START end. Six-axis mouse: its six axes; left and right button close and \
open, both end. Quest: the right hand is followed while RG is held, rightTrig closes, A success, X again, Y pause, B end; with --left-site the left hand leads a second arm by LG and leftTrig. OpenXR: the same \
with the controllers of any headset; the session prints a command, `python -m robohive.openxr ADDRESS`, that you run where the headset's runtime is (`pip install pyopenxr websockets`). A glove leads the joints of a hand, by --calibration FILE; Space begins and pauses. A leader arm leads joints too: the robot first moves slowly to its position, and then follows it; with --arm the leader's servos compensate its weight if \
its config has a section [gravity]. The keyboard's marks \
work beside every device.

With --policy POLICY the policy acts when you start time (Space), and any motion of yours takes control from where the robot is; p returns it. The status line shows who acts, and env_infos/intervention of a recording is 1 for every step in which you act.

--mapping FILE changes all of this; --print-mapping prints the mapping that is used without one, to begin from. A target whose joints would be \
more than 0.5 rad away, or out of range, is refused. Terminals with the kitty keyboard protocol report when keys are released; in others a key counts as released 0.15 s after its last \
repetition. --preview shows the scene in the terminal.

--record writes as `robohive run --record` does, each episode when it is finished, so that a kill loses no finished episode; teleop/success \
holds your judgement. `robohive view FILE` shows the recording. --layout lerobot writes a LeRobot dataset instead, complete after every episode; an \
existing dataset is extended if its features and its frame rate are those of the session. Frames also have judged_success, and intervention with --policy.

--hardware CONFIG drives the devices that a robot config names, and nothing moves without --arm; --rehearse puts simulated ones in their \
place. The robot moves to the start of an episode by itself and rests there until you move it. Input older than 0.15 s is ignored, \
and the robot stops at its last target. During a pause the last command is repeated, so that the watchdogs of the devices do not trip; when the session \
dies, they make the devices safe. Hardware can neither go back in time nor run in slow motion.

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
    /// What drives: keyboard, gamepad, spacemouse (Linux), quest[:HOST:PORT] (by an adb server), glove:PORT (a CyberGlove on a serial port), leader:FILE (an arm that you move by hand, by its config), phone[:PORT] (a page for phones and headsets), phone-lan[:PORT] or phone-lan:ADDRESS:PORT (the same on the local network behind TLS; builds with --features tls), openxr[:PORT] (controllers on SteamVR, Monado or WiVRn, by a program in Python)
    #[arg(long, value_name = "DEVICE", default_value = "keyboard", value_parser = DeviceChoice::read)]
    pub device: DeviceChoice,
    /// File of the device, instead of the first that is found; for quest a pipe with lines of its log
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub path: Option<PathBuf>,
    /// How a glove's sensors map to the joints of a hand (TOML); required for gloves
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub calibration: Option<PathBuf>,
    /// What acts until you take over, by any motion or by p: best, random, zero, or a file with a policy, as for `robohive run`
    #[arg(long, value_name = "POLICY")]
    pub policy: Option<String>,
    /// What is driven; a glove or a leader arm always drives joints
    #[arg(long, value_name = "WHAT", default_value = "hand")]
    pub control: ControlName,
    /// Site of the model that is the hand [default: the first of the mapping's sites that the model has]
    #[arg(long, value_name = "NAME")]
    pub site: Option<String>,
    /// Site of a second, left arm: driven by the left controller of a headset, or by entries of a mapping
    #[arg(long, value_name = "NAME")]
    pub left_site: Option<String>,
    /// Mapping of keys, buttons and axes (TOML); missing sections have their defaults
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub mapping: Option<PathBuf>,
    /// Print the default mapping and end
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
    /// Record every finished episode in this file, .h5 or .hdf5 (HDF5), or .npz, and replace it; with --layout lerobot a folder, which is extended
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub record: Option<PathBuf>,
    /// What is recorded
    #[arg(long, default_value = "robohive", requires = "record")]
    pub layout: RecordForm,
    /// Description of the task, for --layout lerobot [default: the id]
    #[arg(long, value_name = "TEXT", requires = "record")]
    pub task: Option<String>,
    /// Where --layout lerobot keeps the images of --visual
    #[arg(long, default_value = "video", requires = "visual")]
    pub pictures: PictureForm,
    /// Precision of the recorded numbers; that of RoboHive's own files is reduced
    #[arg(long, default_value = "full", requires = "record")]
    pub precision: PrecisionName,
    /// Record the images of the visual keys too; drawing them takes time
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordForm {
    /// A file in a layout.
    File(LayoutName),
    /// A folder, a dataset of LeRobot.
    Dataset,
}

impl ValueEnum for RecordForm {
    fn value_variants<'a>() -> &'a [Self] {
        &[RecordForm::File(LayoutName::Robohive), RecordForm::File(LayoutName::Roboset), RecordForm::Dataset]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            RecordForm::File(layout) => layout.to_possible_value(),
            RecordForm::Dataset => Some(PossibleValue::new("lerobot").help(
                "A folder, a dataset of LeRobot (version 3.0): frames with observation.state, action, next.reward...",
            )),
        }
    }
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
