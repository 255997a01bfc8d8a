//! What RoboHive 0.7 does otherwise than it should, and which of the two a robot does.

use std::fmt;
use std::str::FromStr;

/// Whether peculiarities of the original are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Compat {
    /// Each is corrected, as [`QUIRKS`] says.
    #[default]
    Fixed,
    /// Those that shape numbers are reproduced: the same actions make the same controls as RoboHive 0.7 under
    /// MuJoCo.
    RoboHive07,
}

impl fmt::Display for Compat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Compat::Fixed => "fixed",
            Compat::RoboHive07 => "robohive-0.7",
        })
    }
}

/// A name that no [`Compat`] has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownCompat(String);

impl fmt::Display for UnknownCompat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no compatibility '{}'; there are 'fixed' and 'robohive-0.7'", self.0)
    }
}

impl std::error::Error for UnknownCompat {}

impl FromStr for Compat {
    type Err = UnknownCompat;

    fn from_str(name: &str) -> Result<Compat, UnknownCompat> {
        [Compat::Fixed, Compat::RoboHive07]
            .into_iter()
            .find(|compat| compat.to_string() == name)
            .ok_or_else(|| UnknownCompat(name.to_owned()))
    }
}

/// A peculiarity of RoboHive's robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quirk {
    /// Short name.
    pub name: &'static str,
    /// What RoboHive 0.7 does.
    pub original: &'static str,
    /// What happens here under [`Compat::Fixed`].
    pub fixed: &'static str,
    /// [`Compat::RoboHive07`] does as the original; otherwise it does as [`Compat::Fixed`].
    pub reproduced: bool,
}

impl Quirk {
    /// The peculiarities as a table of Markdown.
    ///
    /// ```
    /// let table = robohive_robot::Quirk::table(robohive_robot::QUIRKS);
    /// assert!(table.contains("| unlisted-actuators | controls of actuators that the config does not list are"));
    /// ```
    pub fn table(quirks: &[Quirk]) -> String {
        let rows = quirks.iter().map(|Quirk { name, original, fixed, reproduced }| {
            let kept = if *reproduced { "as the original" } else { "fixed" };
            format!("| {name} | {original} | {fixed} | {kept} |\n")
        });
        let head = "| name | RoboHive 0.7 | here | with `robohive-0.7` |\n|---|---|---|---|\n";
        head.to_owned() + &rows.collect::<String>()
    }
}

/// All peculiarities of RoboHive's robot that are known; the table of the documentation is made of them.
pub const QUIRKS: &[Quirk] = &[
    Quirk {
        name: "unlisted-actuators",
        original: "controls of actuators that the config does not list are the actions themselves, not normalised \
                   (the fingers in the configs of Franka's reach, bin, microwave and cabinet)",
        fixed: "they are normalised by the actuator's `ctrlrange`",
        reproduced: true,
    },
    Quirk {
        name: "unlimited-controls",
        original: "without a config, an actuator without `ctrlrange` always gets control 0",
        fixed: "its control is the action itself",
        reproduced: true,
    },
    Quirk {
        name: "actuator-address",
        original: "the position that an actuator moves is read from `qpos` at the address of its degree of freedom: \
                   another joint's behind a free or ball joint",
        fixed: "it is read at the address of the joint's position",
        reproduced: true,
    },
    Quirk {
        name: "sensor-address",
        original: "a sensor is read from `sensordata` at its number: another sensor's value behind one with several \
                   values",
        fixed: "it is read at the sensor's address",
        reproduced: true,
    },
    Quirk {
        name: "normalized-velocity",
        original: "`normalize_actions` takes half of `vel_range[1] - pos_range[0]` for half the range in velocity mode",
        fixed: "half of `vel_range[1] - vel_range[0]`, as controls are computed",
        reproduced: true,
    },
    Quirk {
        name: "hardware-order",
        original: "`remap_space` stores values at the index `hdr_id`, from the end where it is negative, in a vector of \
                   the model's length, and fails for motors with larger numbers",
        fixed: "the hardware's vector has one value for each entry of the config, in its order",
        reproduced: true,
    },
    Quirk {
        name: "readings-into-the-truth",
        original: "clipped and noisy readings are written into the simulated state itself, so that they move the robot",
        fixed: "`write_readings` writes into the observed state; the environment gives that a `Data` of its own",
        reproduced: true,
    },
    Quirk {
        name: "single-precision-actions",
        original: "with a config, controls have the precision of the actions: those of `float32` actions are rounded",
        fixed: "controls are double; `Options::single_precision` rounds them",
        reproduced: false,
    },
    Quirk {
        name: "evaluated-config",
        original: "a config is Python code that is run",
        fixed: "it is read as a literal, with `+ - * /` and `np.pi`",
        reproduced: false,
    },
    Quirk {
        name: "quitting",
        original: "a sensor or actuator of a kind that is not supported ends the interpreter",
        fixed: "it is an error that names the device and the element",
        reproduced: false,
    },
    Quirk {
        name: "lost-session",
        original: "the connection meant to outlive a robot is stored in the instance and lost with it",
        fixed: "devices belong to the robot and are closed with it",
        reproduced: false,
    },
    Quirk {
        name: "camera-key",
        original: "`cams` instead of `cam` in one config hides a camera",
        fixed: "both are read",
        reproduced: false,
    },
];
