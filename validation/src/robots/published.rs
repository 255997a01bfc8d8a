//! Numbers that makers and papers publish of a robot: the text of a `published.toml`.

use serde::Deserialize;
use std::collections::BTreeMap;

/// What is published of one robot.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Where the numbers stand, if a row names no other place.
    pub source: String,
    /// The model that they describe, in the robot's folder.
    #[serde(default = "robot")]
    pub model: String,
    /// Mass of the whole model \[kg\].
    pub mass: Option<f64>,
    /// Largest distance of two points over all ranges of joints.
    pub reach: Option<Reach>,
    /// Distances with all joints at 0.
    #[serde(default)]
    pub length: Vec<Length>,
    /// Ranges of joints \[rad or m\].
    #[serde(default)]
    pub range: BTreeMap<String, [f64; 2]>,
    /// Largest torque or force at joints \[N m or N\].
    #[serde(default)]
    pub torque: BTreeMap<String, f64>,
    /// Why ours differs, by quantity: `mass`, `reach`, the name of a length, `range` or `torque`.
    #[serde(default)]
    pub why: BTreeMap<String, String>,
}

/// A published reach.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reach {
    /// Joint (its anchor), site or body.
    pub from: String,
    /// Joint (its anchor), site or body.
    pub to: String,
    /// Metres.
    pub value: f64,
    /// Where it stands.
    pub source: Option<String>,
}

/// A published distance.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Length {
    /// What is so long.
    pub name: String,
    /// Joint (its anchor), site or body.
    pub from: String,
    /// Joint (its anchor), site or body.
    pub to: String,
    /// Metres.
    pub value: f64,
    /// Where it stands.
    pub source: Option<String>,
}

fn robot() -> String {
    "robot.xml".into()
}
