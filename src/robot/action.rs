//! From a policy's action to controls: units, then limits of velocity, position and effort.

use crate::binding::{Actuator, Binding};
use crate::compat::Compat;
use crate::effort::Effort;
use crate::error::RobotError;
use crate::interval::{clip, middle_and_half, stretch};
use crate::options::{ActionMode, Options};
use physics::elements::ActuatorId;
use physics::elements::Element;
use physics::{Data, Model};

/// How the controls of one robot follow from actions.
#[derive(Clone, Debug)]
pub(crate) struct Actions {
    mode: ActionMode,
    compat: Compat,
    normalized: bool,
    single_precision: bool,
    /// There is no config: all actuators are commanded alike.
    default: bool,
    /// Of the actuators of the config: torque, with its limits.
    efforts: Vec<Option<(Effort, [f64; 2])>>,
}

impl Actions {
    /// The rules for actuators that the config lists.
    ///
    /// # Errors
    /// Modes for which config or model do not say enough; effort limits of actuators that have no such limits.
    pub(crate) fn new(
        model: &Model,
        binding: &Binding,
        default: bool,
        options: &Options,
    ) -> Result<Actions, RobotError> {
        let mode = options.mode;
        if default && mode != ActionMode::Position {
            let reason = "a robot without config has positions only; a config has the ranges of the others";
            return Err(RobotError::Mode { mode, reason: reason.to_owned() });
        }
        let efforts = binding.actuators.iter().map(|actuator| effort(model, actuator, mode));
        Ok(Actions {
            mode,
            compat: options.compat,
            normalized: options.normalized,
            single_precision: options.single_precision && !default,
            default,
            efforts: efforts.collect::<Result<_, _>>()?,
        })
    }

    /// Writes the controls of `action` for the next `duration` seconds.
    pub(crate) fn control(
        &self,
        robot: (&Model, &Binding),
        data: &Data,
        (action, duration): (&[f64], f64),
        controls: &mut [f64],
    ) {
        let (model, binding) = robot;
        for (place, actuator) in binding.actuators.iter().enumerate() {
            let wanted = action[actuator.control];
            controls[actuator.control] = match (self.mode, &self.efforts[place]) {
                (ActionMode::Torque, Some((effort, range))) => {
                    let torque = if self.normalized { stretch(wanted, *range) } else { wanted };
                    effort.control(data, clip(torque, *range))
                }
                (_, limit) => {
                    let position = self.position(data, actuator, wanted, duration);
                    limit.map_or(position, |(effort, range)| effort.limit(data, position, range))
                }
            };
        }
        for &control in &binding.unlisted {
            let range = self.range_of_unlisted(model, control).filter(|_| self.normalized);
            controls[control] = range.map_or(action[control], |range| stretch(action[control], range));
        }
        if self.single_precision {
            controls.iter_mut().for_each(|control| *control = f64::from(*control as f32));
        }
    }

    /// The position to command: as near to the wanted one as velocity and position ranges allow.
    fn position(&self, data: &Data, actuator: &Actuator, wanted: f64, duration: f64) -> f64 {
        let now = data.state.qpos[actuator.position];
        let (positions, velocities) = (actuator.position_range(), actuator.config.velocity_range);
        let velocity = if self.mode == ActionMode::Velocity {
            if self.normalized { stretch(wanted, velocities) } else { wanted }
        } else {
            let position = if self.normalized { stretch(wanted, positions) } else { wanted };
            clip((position - now) / duration, velocities)
        };
        clip(now + velocity * duration, positions)
    }

    /// Range of the normalised actions of an actuator that is in no config; `None` where actions are controls.
    fn range_of_unlisted(&self, model: &Model, control: usize) -> Option<[f64; 2]> {
        let limited = model.actuator_ctrllimited[control];
        let normalized = match self.compat {
            Compat::Fixed => limited,
            Compat::RoboHive07 => self.default,
        };
        normalized.then(|| model.actuator_ctrlrange[control])
    }

    /// The range that -1 to 1 stand for, and its half width as `normalize` takes it.
    fn range_and_half(&self, binding: &Binding, place: usize) -> ([f64; 2], f64) {
        let config = &binding.actuators[place].config;
        match (self.mode, &self.efforts[place]) {
            (ActionMode::Torque, Some((_, range))) => (*range, middle_and_half(*range).1),
            (ActionMode::Velocity, _) => {
                let [low, high] = config.velocity_range;
                let lower = match self.compat {
                    Compat::Fixed => low,
                    Compat::RoboHive07 => config.position_range[0],
                };
                (config.velocity_range, (high - lower) / 2.0)
            }
            _ => (config.position_range, middle_and_half(config.position_range).1),
        }
    }

    /// Turns numbers with units into -1 to 1.
    pub(crate) fn normalize(&self, model: &Model, binding: &Binding, controls: &mut [f64]) {
        for (place, actuator) in binding.actuators.iter().enumerate() {
            let (range, half) = self.range_and_half(binding, place);
            let control = &mut controls[actuator.control];
            *control = clip((*control - middle_and_half(range).0) / half, [-1.0, 1.0]);
        }
        for &control in &binding.unlisted {
            if let Some(range) = self.range_of_unlisted(model, control) {
                let (middle, half) = middle_and_half(range);
                controls[control] = (controls[control] - middle) / half;
            }
        }
    }

    /// Turns -1 to 1 into numbers with units.
    pub(crate) fn unnormalize(&self, model: &Model, binding: &Binding, actions: &mut [f64]) {
        for (place, actuator) in binding.actuators.iter().enumerate() {
            let (range, half) = self.range_and_half(binding, place);
            let action = &mut actions[actuator.control];
            *action = clip(*action, [-1.0, 1.0]) * half + middle_and_half(range).0;
        }
        for &control in &binding.unlisted {
            if let Some(range) = self.range_of_unlisted(model, control) {
                actions[control] = stretch(actions[control], range);
            }
        }
    }
}

/// The torque of an actuator with its limits, where limits or torques are asked for.
fn effort(
    model: &Model,
    actuator: &Actuator,
    mode: ActionMode,
) -> Result<Option<(Effort, [f64; 2])>, RobotError> {
    let wanted = actuator.config.effort_range;
    if wanted.is_none() && mode != ActionMode::Torque {
        return Ok(None);
    }
    let name = &actuator.config.name;
    let effort = Effort::new(model, actuator.id).map_err(|reason| RobotError::Mode {
        mode,
        reason: format!("the torque of actuator '{name}' does not follow from its control: it {reason}"),
    })?;
    let range = wanted.or_else(|| effort.range(model, actuator.id, actuator.control));
    let range = range.ok_or_else(|| RobotError::Mode {
        mode,
        reason: format!("actuator '{name}' has no limits of torque; its config can have an `effort_range`"),
    })?;
    Ok(Some((effort, range)))
}

/// Checks that actions and period are numbers to act on.
///
/// # Errors
/// Wrong lengths, actions that are no finite numbers, periods that are not positive.
pub(crate) fn check(model: &Model, action: &[f64], duration: f64) -> Result<(), RobotError> {
    if action.len() != model.nu {
        return Err(RobotError::Length { what: "an action", given: action.len(), expected: model.nu });
    }
    if let Some(index) = action.iter().position(|value| !value.is_finite()) {
        let owner = (0..ActuatorId::count(model))
            .rev()
            .find(|&id| usize::try_from(model.actuator_ctrladr[id]).is_ok_and(|control| control <= index));
        let name = owner.map_or("", |id| model.name_of(ActuatorId::KIND, id));
        return Err(RobotError::BadAction { index, actuator: name.to_owned(), value: action[index] });
    }
    if !(duration > 0.0 && duration.is_finite()) {
        return Err(RobotError::BadDuration(duration));
    }
    Ok(())
}
