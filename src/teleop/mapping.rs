//! What keys, buttons and axes do, from a file in TOML.

use crate::error::TeleopError;
use crate::event::{Axis, Button, Device, HandPose, Key};
use crate::gamepad::{self, Ends};
use crate::held::Sample;
use crate::lead::Leading;
use crate::motion::{ARMS, ArmMotion, HandMove, Input, MARKS, Mark, Motion};
use crate::{quest, space_mouse};
use physics::math::{Quat, Vec3, quat_conj, quat_mul, quat_normalize, sub};
use std::collections::BTreeSet;
use toml::{Table, Value};

/// The mapping that there is without a file: RoboHive's.
pub const DEFAULTS: &str = include_str!("defaults.toml");

/// Names of what a hand does, in the order of [`Motion::along`].
const ALONG: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
/// Joints that a mapping can name.
const JOINTS: usize = 64;

/// What something does while it is held.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Effect {
    /// To the arm of a number.
    Arm(usize, ArmEffect),
    Joint(usize, f64),
    Quarter,
    Mark(Mark),
}

/// What something does to an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ArmEffect {
    Along(usize, f64),
    Gripper(f64),
    /// An axis from open to closed.
    Grip,
    Clutch,
}

/// How far a tick moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains {
    /// The hand \[m\].
    pub position: f64,
    /// The hand \[rad\].
    pub rotation: f64,
    /// A joint, in parts of the range of its actuator.
    pub joint: f64,
    /// Metres of the robot for a metre of a tracked hand.
    pub hand: f64,
}

/// What an arm is driven by.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmSettings {
    /// Names of sites that can be moved; the first that a model has is.
    pub sites: Vec<String>,
    /// The same of a left arm that is driven beside it; none for one arm.
    pub left_sites: Vec<String>,
    /// Largest distance of the joints that are asked for from where they are \[rad\].
    pub reach: f64,
    /// See [`robot::Reach::pull`].
    pub pull: f64,
    /// Where the gripper is first, -1 (closed) to 1.
    pub gripper: f64,
}

/// Numbers of buttons or axes by name.
type Codes<'a> = &'a [(&'a str, u16)];

/// What keys, buttons and axes do.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// How far a tick moves.
    pub gains: Gains,
    /// What an arm is driven by.
    pub arm: ArmSettings,
    /// Ends of the axes of a gamepad that does not speak xpad's language.
    pub ends: Vec<(u16, Ends)>,
    /// What leads joints, where something does.
    pub led: Option<Leading>,
    buttons: Vec<(BTreeSet<Button>, Effect)>,
    axes: Vec<(Axis, Effect)>,
    faces: bool,
    /// The hand of each arm in the last tick in which its clutch was held.
    clutched: [Option<HandPose>; ARMS],
}

impl Default for Mapping {
    fn default() -> Self {
        let none = Table::new();
        Mapping::of(&none, "the defaults").expect("a test reads the defaults")
    }
}

impl Mapping {
    /// Reads a mapping; sections that it lacks are those of [`DEFAULTS`]. `file` is its name, for errors.
    ///
    /// # Errors
    /// It is no TOML, or names what is not known.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, TeleopError> {
        let table = text.parse::<Table>().map_err(|error| wrong(file, error.to_string()))?;
        Mapping::of(&table, file)
    }

    fn of(given: &Table, file: &str) -> Result<Self, TeleopError> {
        let mut whole: Table = DEFAULTS.parse().map_err(|error| wrong("the defaults", format!("{error}")))?;
        for (name, section) in given {
            let known = whole.get(name).and_then(Value::as_table).cloned();
            let Some(known) = known else {
                let names: Vec<&str> = whole.keys().map(String::as_str).collect();
                return Err(wrong(
                    file,
                    format!("there is no section [{name}]; there are {}", names.join(", ")),
                ));
            };
            let Some(section) = section.as_table() else {
                return Err(wrong(file, format!("{name} is a section: [{name}]")));
            };
            // Numbers one by one, what buttons do as a whole.
            let mut merged = if matches!(&name[..], "gains" | "arm") { known } else { Table::new() };
            merged.extend(section.clone());
            whole.insert(name.clone(), Value::Table(merged));
        }
        let section = |name: &str| whole.get(name).and_then(Value::as_table).cloned().unwrap_or_default();
        let mut mapping = Mapping {
            gains: gains(&section("gains"), file)?,
            arm: arm(&section("arm"), file)?,
            ends: Vec::new(),
            led: None,
            buttons: Vec::new(),
            axes: Vec::new(),
            faces: false,
            clutched: [None; ARMS],
        };
        mapping.bind_keys(&section("keyboard"), file)?;
        for (name, device, buttons, axes) in [
            ("gamepad", Device::Gamepad, &gamepad::BUTTONS[..], &gamepad::AXES[..]),
            ("spacemouse", Device::SpaceMouse, &space_mouse::BUTTONS, &space_mouse::AXES),
            ("quest", Device::Quest, &quest::BUTTONS, &quest::AXES),
        ] {
            mapping.bind(&section(name), (device, buttons, axes), (file, name))?;
        }
        Ok(mapping)
    }

    fn bind_keys(&mut self, section: &Table, file: &str) -> Result<(), TeleopError> {
        for (name, does) in section {
            let key = Key::named(name)
                .ok_or_else(|| wrong(file, format!("[keyboard] {name}: there is no such key; keys are characters, or words such as space, enter, page_up")))?;
            let effect = effect(does).ok_or_else(|| unknown(file, "keyboard", name, does))?;
            self.buttons.push((BTreeSet::from([Button::Key(key)]), effect));
        }
        Ok(())
    }

    fn bind(
        &mut self,
        section: &Table,
        (device, buttons, axes): (Device, Codes<'_>, Codes<'_>),
        (file, title): (&str, &str),
    ) -> Result<(), TeleopError> {
        let find = |list: Codes<'_>, name: &str| {
            list.iter().find(|(known, _)| *known == name).map(|(_, code)| *code)
        };
        for (name, does) in section {
            if let (Some(ends), "ends") = (does.as_table(), &name[..]) {
                for (axis, pair) in ends {
                    let ends = find(axes, axis).zip(ends_of(axis, pair));
                    self.ends.push(ends.ok_or_else(|| {
                        wrong(
                            file,
                            format!("[{title}.ends] {axis}: give the two ends of an axis, as x = [0, 255]"),
                        )
                    })?);
                }
                continue;
            }
            if let (Some(stands), "stands") = (does.as_str(), &name[..]) {
                self.faces = match stands {
                    "behind" => false,
                    "front" => true,
                    _ => return Err(wrong(file, format!("[{title}] stands is \"behind\" or \"front\""))),
                };
                continue;
            }
            let effect = effect(does).ok_or_else(|| unknown(file, title, name, does))?;
            if let Some(code) = find(axes, name) {
                self.axes.push((Axis(device, code), effect));
                continue;
            }
            let chord: Option<BTreeSet<Button>> =
                name.split('+').map(|part| Some(Button::Of(device, find(buttons, part)?))).collect();
            let chord = chord.ok_or_else(|| {
                let names: Vec<&str> = axes.iter().chain(buttons).map(|(name, _)| *name).collect();
                wrong(
                    file,
                    format!("[{title}] {name}: there are {}, and buttons joined by +", names.join(", ")),
                )
            })?;
            self.buttons.push((chord, effect));
        }
        Ok(())
    }

    /// What a person wants who holds this.
    pub fn read(&mut self, sample: &Sample) -> Input {
        let mut input = Input::default();
        let mut clutches = [false; ARMS];
        let held: Vec<_> = self.buttons.iter().filter(|(chord, _)| chord.is_subset(&sample.down)).collect();
        // Of buttons that are held together, the chord counts alone.
        let alone = |chord: &BTreeSet<Button>| {
            !held.iter().any(|(other, _)| other.len() > chord.len() && chord.is_subset(other))
        };
        for (chord, effect) in held.iter().filter(|(chord, _)| alone(chord)) {
            match effect {
                Effect::Mark(mark) => {
                    let struck = chord.iter().any(|button| sample.struck.contains(button));
                    if (struck || mark.repeats()) && !input.marks.contains(mark) {
                        input.marks.push(*mark);
                    }
                }
                Effect::Arm(arm, ArmEffect::Clutch) => clutches[*arm] = true,
                effect => apply(*effect, 1.0, &mut input.motion),
            }
        }
        input.motion.led = self.led.as_ref().and_then(|led| led.read(sample));
        for (axis, effect) in &self.axes {
            let Some(&place) = sample.axes.get(axis) else { continue };
            match effect {
                Effect::Arm(arm, ArmEffect::Grip) => {
                    input.motion.arms[*arm].gripper = Some(1.0 - 2.0 * place);
                }
                effect => apply(*effect, place, &mut input.motion),
            }
        }
        for (arm, motion) in input.motion.arms.iter_mut().enumerate() {
            motion.along.iter_mut().for_each(|x| *x = x.clamp(-1.0, 1.0));
            // The right hand leads the first arm.
            let hand = sample.hands[1 - arm].filter(|_| clutches[arm]);
            self.follow(arm, hand, motion);
        }
        input
    }

    /// Follows a hand while the clutch is held; where it was when the clutch was taken counts as the middle.
    fn follow(&mut self, arm: usize, hand: Option<HandPose>, motion: &mut ArmMotion) {
        let before = std::mem::replace(&mut self.clutched[arm], hand);
        let (Some(before), Some(now)) = (before, hand) else { return };
        let way = self.to_world(sub(now.position, before.position)).map(|x| self.gains.hand * x);
        let [w, x, y, z] = quat_normalize(quat_mul(now.orientation, quat_conj(before.orientation)));
        let [x, y, z] = self.to_world([x, y, z]);
        let turn: Quat = [w, x, y, z];
        motion.hand = Some(HandMove { way, turn });
    }

    /// From the frame of a headset (x right, y up, z backward) to the world's (x forward from the robot, z up).
    fn to_world(&self, [x, y, z]: Vec3) -> Vec3 {
        if self.faces { [z, x, y] } else { [-z, -x, y] }
    }
}

fn apply(effect: Effect, place: f64, motion: &mut Motion) {
    match effect {
        Effect::Arm(arm, ArmEffect::Along(axis, sign)) => motion.arms[arm].along[axis] += sign * place,
        Effect::Arm(arm, ArmEffect::Gripper(to)) => motion.arms[arm].gripper = Some(to),
        Effect::Joint(joint, sign) => motion.joints.push((joint, sign * place)),
        Effect::Quarter => motion.quarter = true,
        Effect::Arm(_, ArmEffect::Grip | ArmEffect::Clutch) | Effect::Mark(_) => {}
    }
}

fn effect(value: &Value) -> Option<Effect> {
    let text = value.as_str()?;
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

fn ends_of(axis: &str, pair: &Value) -> Option<Ends> {
    let [low, high] = pair.as_array()?.as_slice() else { return None };
    let number = |value: &Value| i32::try_from(value.as_integer()?).ok();
    let (low, high) = (number(low)?, number(high)?);
    (low < high).then_some(Ends { low, high, rests_low: matches!(axis, "z" | "rz") })
}

fn gains(section: &Table, file: &str) -> Result<Gains, TeleopError> {
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
                    format!("[gains] {name}: there are position, rotation, joint, hand"),
                ));
            }
        };
        *place = positive(file, "gains", name, value)?;
    }
    Ok(gains)
}

fn arm(section: &Table, file: &str) -> Result<ArmSettings, TeleopError> {
    let mut arm =
        ArmSettings { sites: Vec::new(), left_sites: Vec::new(), reach: 0.0, pull: 0.0, gripper: 0.0 };
    for (name, value) in section {
        match &name[..] {
            "sites" => arm.sites = names(value),
            "left_sites" => arm.left_sites = names(value),
            "reach" => arm.reach = positive(file, "arm", name, value)?,
            "pull" => {
                arm.pull = number(value)
                    .filter(|pull| (0.0..=1.0).contains(pull))
                    .ok_or_else(|| wrong(file, "[arm] pull is 0 to 1".to_owned()))?
            }
            "gripper" => {
                arm.gripper = number(value)
                    .filter(|place| (-1.0..=1.0).contains(place))
                    .ok_or_else(|| wrong(file, "[arm] gripper is -1 (closed) to 1".to_owned()))?
            }
            _ => {
                return Err(wrong(
                    file,
                    format!("[arm] {name}: there are sites, left_sites, reach, pull, gripper"),
                ));
            }
        }
    }
    Ok(arm)
}

fn names(value: &Value) -> Vec<String> {
    value.as_array().into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect()
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|whole| whole as f64))
}

fn positive(file: &str, section: &str, name: &str, value: &Value) -> Result<f64, TeleopError> {
    let fits = number(value).filter(|x| x.is_finite() && *x > 0.0);
    fits.ok_or_else(|| wrong(file, format!("[{section}] {name} is a positive number, and not {value}")))
}

fn wrong(file: &str, message: String) -> TeleopError {
    TeleopError::Mapping { file: file.to_owned(), message }
}

fn unknown(file: &str, section: &str, name: &str, does: &Value) -> TeleopError {
    let marks: Vec<&str> = MARKS.iter().map(|(name, _)| *name).collect();
    wrong(
        file,
        format!(
            "[{section}] {name} = {does}: there are +x to -yaw, open, close, grip, clutch, each also as left.+x, +1 to -{JOINTS}, quarter, {}",
            marks.join(", ")
        ),
    )
}
