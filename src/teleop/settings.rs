//! Numbers of a mapping file: motions in a tick, and settings of arms and legs.

use crate::error::TeleopError;
use toml::{Table, Value};

/// How far a tick moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains {
    /// The hand \[m\].
    pub position: f64,
    /// The hand \[rad\].
    pub rotation: f64,
    /// A joint, as a fraction of the range of its actuator.
    pub joint: f64,
    /// Metres of the robot for a metre of a tracked hand.
    pub hand: f64,
}

/// Settings of an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmSettings {
    /// Names of sites; the first that the model has is the hand.
    pub sites: Vec<String>,
    /// The same for a second, left arm; empty for one arm.
    pub left_sites: Vec<String>,
    /// Largest distance between the target and the present position of a joint \[rad\].
    pub reach: f64,
    /// See [`robot::Reach::pull`].
    pub pull: f64,
    /// First target of the gripper, -1 (closed) to 1 (open).
    pub gripper: f64,
}

/// The gait of a four-legged robot. Velocities are the largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseSettings {
    /// Forward \[m/s\].
    pub forward: f64,
    /// To the left \[m/s\].
    pub left: f64,
    /// Counterclockwise \[rad/s\].
    pub turn: f64,
    /// Time from rest to the largest velocity \[s\].
    pub ramp: f64,
    /// Period of the gait, in which every leg makes a step \[s\].
    pub period: f64,
    /// Height to which feet are lifted \[m\].
    pub lift: f64,
    /// Angle of the forward direction from the x axis of the torso \[rad\].
    pub heading: f64,
}

pub(crate) fn gains(section: &Table, file: &str) -> Result<Gains, TeleopError> {
    let mut gains = Gains { position: 0.0, rotation: 0.0, joint: 0.0, hand: 0.0 };
    for (name, value) in section {
        let place = match &name[..] {
            "position" => &mut gains.position,
            "rotation" => &mut gains.rotation,
            "joint" => &mut gains.joint,
            "hand" => &mut gains.hand,
            _ => {
                return Err(wrong(
                    file,
                    format!("[gains] {name} is unknown; the entries are position, rotation, joint, hand"),
                ));
            }
        };
        *place = positive(file, "gains", name, value)?;
    }
    Ok(gains)
}

pub(crate) fn arm(section: &Table, file: &str) -> Result<ArmSettings, TeleopError> {
    let mut arm =
        ArmSettings { sites: Vec::new(), left_sites: Vec::new(), reach: 0.0, pull: 0.0, gripper: 0.0 };
    for (name, value) in section {
        match &name[..] {
            "sites" => arm.sites = sites(file, name, value)?,
            "left_sites" => arm.left_sites = sites(file, name, value)?,
            "reach" => arm.reach = positive(file, "arm", name, value)?,
            "pull" => {
                arm.pull = number(value)
                    .filter(|pull| (0.0..=1.0).contains(pull))
                    .ok_or_else(|| wrong(file, "[arm] pull must be from 0 to 1".to_owned()))?
            }
            "gripper" => {
                arm.gripper = number(value).filter(|place| (-1.0..=1.0).contains(place)).ok_or_else(|| {
                    wrong(file, "[arm] gripper must be from -1 (closed) to 1 (open)".to_owned())
                })?
            }
            _ => {
                return Err(wrong(
                    file,
                    format!(
                        "[arm] {name} is unknown; the entries are sites, left_sites, reach, pull, gripper"
                    ),
                ));
            }
        }
    }
    Ok(arm)
}

pub(crate) fn base(section: &Table, file: &str) -> Result<BaseSettings, TeleopError> {
    let mut base =
        BaseSettings { forward: 0.0, left: 0.0, turn: 0.0, ramp: 0.0, period: 0.0, lift: 0.0, heading: 0.0 };
    for (name, value) in section {
        let place = match &name[..] {
            "forward" => &mut base.forward,
            "left" => &mut base.left,
            "turn" => &mut base.turn,
            "ramp" => &mut base.ramp,
            "period" => &mut base.period,
            "lift" => &mut base.lift,
            "heading" => {
                base.heading = number(value)
                    .filter(|angle| angle.is_finite())
                    .ok_or_else(|| wrong(file, "[base] heading must be an angle [rad]".to_owned()))?;
                continue;
            }
            _ => {
                let known = "forward, left, turn, ramp, period, lift, heading";
                return Err(wrong(file, format!("[base] {name} is unknown; the entries are {known}")));
            }
        };
        *place = positive(file, "base", name, value)?;
    }
    Ok(base)
}

fn sites(file: &str, name: &str, value: &Value) -> Result<Vec<String>, TeleopError> {
    let named =
        |entries: &Vec<Value>| entries.iter().map(|entry| entry.as_str().map(str::to_owned)).collect();
    let all: Option<Vec<String>> = value.as_array().and_then(named);
    all.ok_or_else(|| wrong(file, format!("[arm] {name} is a list of names, and not {value}")))
}

/// A number, with or without a decimal point.
pub(crate) fn number(value: &Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|whole| whole as f64))
}

pub(crate) fn positive(file: &str, section: &str, name: &str, value: &Value) -> Result<f64, TeleopError> {
    let fits = number(value).filter(|x| x.is_finite() && *x > 0.0);
    fits.ok_or_else(|| wrong(file, format!("[{section}] {name} must be a positive number, not {value}")))
}

pub(crate) fn wrong(file: &str, message: String) -> TeleopError {
    TeleopError::Mapping { file: file.to_owned(), message }
}
