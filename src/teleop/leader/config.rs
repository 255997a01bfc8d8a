//! Config of a leader arm, from a TOML file.

use crate::error::TeleopError;
use crate::held::Sample;
use crate::settings::{number, wrong};
use toml::{Table, Value};

/// A joint of the leader, and the control of the robot that follows it: control = joint × scale + offset.
#[derive(Clone, Debug, PartialEq)]
pub struct LedJoint {
    /// The sensor of the leader's robot config that reads its position \[rad\].
    pub sensor: String,
    /// The actuator of the environment.
    pub actuator: String,
    /// Units of the control for a radian of the joint; its sign is the direction.
    pub scale: f64,
    /// Control for the leader's joint at 0.
    pub offset: f64,
}

/// How a robot moves to the position of its leader before it follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CatchUp {
    /// Largest velocity of a joint, in units of the leader \[rad/s\].
    pub speed: f64,
    /// Distance of a joint, in units of the leader, beyond which the robot does not move \[rad\].
    pub far: f64,
}

/// Gravity compensation by the leader's servos.
#[derive(Clone, Debug, PartialEq)]
pub struct GravitySettings {
    /// The leader as MJCF, beside the config; its sensors and actuators have the names of the robot config.
    pub model: String,
    /// Share of the weight that is compensated.
    pub share: f64,
    /// Torque of one ampere \[N m/A\].
    pub torque_constant: f64,
    /// Largest current \[A\].
    pub current: f64,
}

/// A leader arm.
#[derive(Clone, Debug, PartialEq)]
pub struct LeaderConfig {
    /// The robot config of its servos, beside this file.
    pub devices: String,
    /// Its joints.
    pub joints: Vec<LedJoint>,
    /// How the robot catches up with it.
    pub catch_up: CatchUp,
    /// Gravity compensation, if any.
    pub gravity: Option<GravitySettings>,
}

impl LeaderConfig {
    /// Reads a config: `devices`, a list of `joint`s, and the sections `catch_up` and `gravity`. `file` is its name, for errors.
    ///
    /// # Errors
    /// It is not valid TOML, or has a missing or unknown entry.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, TeleopError> {
        let wrong = |message: String| wrong(file, message);
        let table: Table = text.parse().map_err(|error: toml::de::Error| wrong(error.to_string()))?;
        let top = Section { table: &table, title: "the file".to_owned() };
        top.knows(&["devices", "joint", "catch_up", "gravity"]).map_err(wrong)?;
        let joints = table.get("joint").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        let joints: Result<Vec<_>, _> = joints.iter().enumerate().map(|(k, entry)| joint(k, entry)).collect();
        let config = LeaderConfig {
            devices: top.text("devices").map_err(wrong)?,
            joints: joints.map_err(wrong)?,
            catch_up: top
                .section("catch_up")
                .and_then(|section| section.map_or(Ok(CatchUp { speed: 0.5, far: 1.0 }), catch_up))
                .map_err(wrong)?,
            gravity: top
                .section("gravity")
                .and_then(|section| section.map(gravity).transpose())
                .map_err(wrong)?,
        };
        if config.joints.is_empty() {
            return Err(wrong(
                "it has no [[joint]] with the sensor that leads and the actuator that follows".to_owned(),
            ));
        }
        let actuators = || config.joints.iter().map(|joint| &joint.actuator);
        if let Some((_, twice)) =
            actuators().enumerate().find(|(k, name)| actuators().take(*k).any(|n| n == *name))
        {
            return Err(wrong(format!("two joints lead the actuator '{twice}'")));
        }
        Ok(config)
    }

    /// Targets of the controls of its joints; `None` while a joint has no reading.
    pub(crate) fn read(&self, sample: &Sample) -> Option<Vec<f64>> {
        let place = |(k, joint): (u16, &LedJoint)| Some(sample.leader.get(&k)? * joint.scale + joint.offset);
        (0..).zip(&self.joints).map(place).collect()
    }
}

fn joint(k: usize, entry: &Value) -> Result<LedJoint, String> {
    let title = format!("joint {}", k + 1);
    let table = entry.as_table().ok_or_else(|| format!("{title} is not a section: write [[joint]]"))?;
    let section = Section { table, title };
    section.knows(&["sensor", "actuator", "scale", "offset"])?;
    let scale = section.number("scale", Some(1.0), [f64::MIN, f64::MAX])?;
    if scale == 0.0 {
        return Err(format!("{}: scale must not be 0", section.title));
    }
    Ok(LedJoint {
        sensor: section.text("sensor")?,
        actuator: section.text("actuator")?,
        scale,
        offset: section.number("offset", Some(0.0), [f64::MIN, f64::MAX])?,
    })
}

fn catch_up(section: Section<'_>) -> Result<CatchUp, String> {
    section.knows(&["speed", "far"])?;
    Ok(CatchUp {
        speed: section.number("speed", Some(0.5), [1e-3, 100.0])?,
        far: section.number("far", Some(1.0), [1e-3, 100.0])?,
    })
}

fn gravity(section: Section<'_>) -> Result<GravitySettings, String> {
    section.knows(&["model", "share", "torque_constant", "current"])?;
    Ok(GravitySettings {
        model: section.text("model")?,
        share: section.number("share", Some(1.0), [0.0, 1.5])?,
        torque_constant: section.number("torque_constant", None, [1e-6, 1e3])?,
        current: section.number("current", None, [1e-6, 1e3])?,
    })
}

/// A section, and its name for errors.
struct Section<'a> {
    table: &'a Table,
    title: String,
}

impl<'a> Section<'a> {
    fn section(&self, name: &str) -> Result<Option<Section<'a>>, String> {
        let Some(value) = self.table.get(name) else { return Ok(None) };
        let table = value.as_table().ok_or_else(|| format!("{name} is a section: [{name}]"))?;
        Ok(Some(Section { table, title: format!("[{name}]") }))
    }

    fn knows(&self, names: &[&str]) -> Result<(), String> {
        match self.table.keys().find(|key| !names.contains(&&key[..])) {
            Some(key) => Err(format!(
                "{} has the unknown entry '{key}'; the entries are {}",
                self.title,
                names.join(", ")
            )),
            None => Ok(()),
        }
    }

    fn text(&self, name: &str) -> Result<String, String> {
        let text = self.table.get(name).and_then(Value::as_str);
        text.map(str::to_owned).ok_or_else(|| format!("{} lacks the text '{name}'", self.title))
    }

    fn number(&self, name: &str, otherwise: Option<f64>, [low, high]: [f64; 2]) -> Result<f64, String> {
        let Some(value) = self.table.get(name) else {
            return otherwise.ok_or_else(|| format!("{} lacks the number '{name}'", self.title));
        };
        let fits = number(value).filter(|x| x.is_finite() && (low..=high).contains(x));
        fits.ok_or_else(|| format!("{}: {name} = {value} is no number from {low:?} to {high:?}", self.title))
    }
}
