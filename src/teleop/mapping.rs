//! The effects of keys, buttons and axes, from a TOML file.

use crate::effect::{ArmEffect, Effect, apply, effects, unknown};
use crate::error::TeleopError;
use crate::event::{Axis, Button, Device, HandPose, Key};
use crate::gamepad::{self, Ends};
use crate::held::Sample;
use crate::lead::Leading;
use crate::motion::{ARMS, ArmMotion, HandMove, Input};
use crate::settings::{ArmSettings, BaseSettings, Gains, arm, base, gains, wrong};
use crate::{quest, space_mouse};
use physics::math::{Quat, Vec3, quat_conj, quat_mul, quat_normalize, sub};
use std::collections::BTreeSet;
use toml::{Table, Value};

/// The default mapping: RoboHive's.
pub const DEFAULTS: &str = include_str!("defaults.toml");

/// Numbers of buttons or axes by name.
type Codes<'a> = &'a [(&'a str, u16)];

/// The effects of keys, buttons and axes.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// How far a tick moves.
    pub gains: Gains,
    /// Settings of an arm.
    pub arm: ArmSettings,
    /// The gait of a four-legged robot.
    pub base: BaseSettings,
    /// Ends of the axes of a gamepad whose events are not xpad's.
    pub ends: Vec<(u16, Ends)>,
    /// The device that leads joints, if one does.
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
    /// It is not valid TOML, or has an unknown entry.
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
            let mut merged = if matches!(&name[..], "gains" | "arm" | "base") { known } else { Table::new() };
            merged.extend(section.clone());
            whole.insert(name.clone(), Value::Table(merged));
        }
        let section = |name: &str| whole.get(name).and_then(Value::as_table).cloned().unwrap_or_default();
        let mut mapping = Mapping {
            gains: gains(&section("gains"), file)?,
            arm: arm(&section("arm"), file)?,
            base: base(&section("base"), file)?,
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
            for effect in effects(does).ok_or_else(|| unknown(file, "keyboard", name, does))? {
                self.buttons.push((BTreeSet::from([Button::Key(key)]), effect));
            }
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
            let effects = effects(does).ok_or_else(|| unknown(file, title, name, does))?;
            if let Some(code) = find(axes, name) {
                self.axes.extend(effects.into_iter().map(|effect| (Axis(device, code), effect)));
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
            self.buttons.extend(effects.into_iter().map(|effect| (chord.clone(), effect)));
        }
        Ok(())
    }

    /// The input of a tick for a sample of the devices.
    pub fn read(&mut self, sample: &Sample) -> Input {
        let mut input = Input::default();
        let mut clutches = [false; ARMS];
        let held: Vec<_> = self.buttons.iter().filter(|(chord, _)| chord.is_subset(&sample.down)).collect();
        // Of buttons that are held together, only the chord counts.
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
        input.motion.base.iter_mut().for_each(|x| *x = x.clamp(-1.0, 1.0));
        for (arm, motion) in input.motion.arms.iter_mut().enumerate() {
            motion.along.iter_mut().for_each(|x| *x = x.clamp(-1.0, 1.0));
            // The right hand leads the first arm.
            let hand = sample.hands[1 - arm].filter(|_| clutches[arm]);
            self.follow(arm, hand, motion);
        }
        input
    }

    /// Follows a hand while the clutch is held, relative to its pose when the clutch was pressed.
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

fn ends_of(axis: &str, pair: &Value) -> Option<Ends> {
    let [low, high] = pair.as_array()?.as_slice() else { return None };
    let number = |value: &Value| i32::try_from(value.as_integer()?).ok();
    let (low, high) = (number(low)?, number(high)?);
    (low < high).then_some(Ends { low, high, rests_low: matches!(axis, "z" | "rz") })
}
