//! Effects of keys, buttons and axes, by their words in mapping files.

use crate::error::TeleopError;
use crate::motion::{MARKS, Mark, Motion};
use crate::settings::wrong;
use toml::Value;

/// Names of the motions of a hand, in the order of [`Motion::along`].
const ALONG: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
/// Names of the motions of a base, in the order of [`Motion::base`].
const BASE: [&str; 3] = ["forward", "left", "turn"];
/// Number of joints that a mapping can name.
const JOINTS: usize = 64;

/// The effect of a key, button or axis while it is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Effect {
    /// On the arm with this number.
    Arm(usize, ArmEffect),
    Joint(usize, f64),
    /// A base: forward, to the left, counterclockwise.
    Base(usize, f64),
    Quarter,
    Mark(Mark),
}

/// The effect on an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ArmEffect {
    Along(usize, f64),
    Gripper(f64),
    /// An axis from open to closed.
    Grip,
    Clutch,
}

pub(crate) fn apply(effect: Effect, place: f64, motion: &mut Motion) {
    match effect {
        Effect::Arm(arm, ArmEffect::Along(axis, sign)) => motion.arms[arm].along[axis] += sign * place,
        Effect::Arm(arm, ArmEffect::Gripper(to)) => motion.arms[arm].gripper = Some(to),
        Effect::Joint(joint, sign) => motion.joints.push((joint, sign * place)),
        Effect::Base(axis, sign) => motion.base[axis] += sign * place,
        Effect::Quarter => motion.quarter = true,
        Effect::Arm(_, ArmEffect::Grip | ArmEffect::Clutch) | Effect::Mark(_) => {}
    }
}

/// The effects of an entry: one, or a list.
pub(crate) fn effects(value: &Value) -> Option<Vec<Effect>> {
    match value.as_array() {
        Some(list) => list.iter().map(|value| effect(value.as_str()?)).collect(),
        None => Some(vec![effect(value.as_str()?)?]),
    }
}

fn effect(text: &str) -> Option<Effect> {
    if let Some((_, mark)) = MARKS.iter().find(|(name, _)| *name == text) {
        return Some(Effect::Mark(*mark));
    }
    let (arm, of_arm) = text.strip_prefix("left.").map_or((0, text), |left| (1, left));
    if let Some(effect) = arm_effect(of_arm) {
        return Some(Effect::Arm(arm, effect));
    }
    if text == "quarter" {
        return Some(Effect::Quarter);
    }
    let (sign, name) = signed(text)?;
    if let Some(axis) = BASE.iter().position(|known| *known == name) {
        return Some(Effect::Base(axis, sign));
    }
    let joint: usize = name.parse().ok().filter(|joint| (1..=JOINTS).contains(joint))?;
    Some(Effect::Joint(joint - 1, sign))
}

fn arm_effect(text: &str) -> Option<ArmEffect> {
    match text {
        "close" => return Some(ArmEffect::Gripper(-1.0)),
        "open" => return Some(ArmEffect::Gripper(1.0)),
        "grip" => return Some(ArmEffect::Grip),
        "clutch" => return Some(ArmEffect::Clutch),
        _ => {}
    }
    let (sign, name) = signed(text)?;
    let axis = ALONG.iter().position(|known| *known == name)?;
    Some(ArmEffect::Along(axis, sign))
}

fn signed(text: &str) -> Option<(f64, &str)> {
    match text.split_at_checked(1)? {
        ("+", name) => Some((1.0, name)),
        ("-", name) => Some((-1.0, name)),
        _ => None,
    }
}

pub(crate) fn unknown(file: &str, section: &str, name: &str, does: &Value) -> TeleopError {
    let marks: Vec<&str> = MARKS.iter().map(|(name, _)| *name).collect();
    wrong(
        file,
        format!(
            "[{section}] {name} = {does}: the effects are +x to -yaw, open, close, grip, clutch, each also as left.+x, +1 to -{JOINTS}, +forward, +left, +turn and their opposites, quarter, {}; or a list of these",
            marks.join(", ")
        ),
    )
}
