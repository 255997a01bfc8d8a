//! Controls that follow a device: the joints of a hand follow a glove, those of an arm a leader arm.

use crate::error::TeleopError;
use crate::glove::Calibration;
use crate::held::Sample;
use crate::leader::{CatchUp, LeaderConfig};
use crate::reached::Reached;
use env::Env;

/// Largest motion of a control in a tick, as a fraction of its range, so that a control that starts elsewhere does not jump.
const STEP: f64 = 0.1;
/// Distance of the joints below which a robot that catches up with its leader begins to follow it \[rad\].
const CAUGHT: f64 = 0.05;

/// The device that leads, and its controls.
#[derive(Clone, Debug, PartialEq)]
pub enum Leading {
    /// A glove.
    Glove(Calibration),
    /// An arm.
    Arm(LeaderConfig),
}

impl Leading {
    /// The actuator of each value; an empty name for values that the robot lacks.
    fn actuators(&self) -> Vec<&str> {
        match self {
            Leading::Glove(calibration) => calibration.actuators().iter().map(String::as_str).collect(),
            Leading::Arm(config) => config.joints.iter().map(|joint| &joint.actuator[..]).collect(),
        }
    }

    /// Targets of the controls, in their units.
    pub(crate) fn read(&self, sample: &Sample) -> Option<Vec<f64>> {
        match self {
            Leading::Glove(calibration) => calibration.read(sample),
            Leading::Arm(config) => config.read(sample),
        }
    }
}

/// A leader arm, which the robot catches up with before it follows.
#[derive(Clone, Debug)]
struct Catching {
    settings: CatchUp,
    /// Units of each control for a radian of the leader.
    scales: Vec<f64>,
    caught: bool,
}

/// The led controls. A copy is sufficient to continue an episode from here.
#[derive(Clone, Debug)]
pub struct Lead {
    controls: Vec<Option<usize>>,
    catching: Option<Catching>,
}

impl Lead {
    /// The controls that a device leads, or none.
    ///
    /// # Errors
    /// The model lacks an actuator.
    pub fn of(env: &Env, leading: Option<&Leading>) -> Result<Self, TeleopError> {
        let model = &env.scene().model;
        let control = |name: &str| {
            if name.is_empty() {
                return Ok(None);
            }
            let found = model.actuator(name).map(|actuator| model.actuator_ctrladr[actuator.index()]);
            let control = found.and_then(|control| usize::try_from(control).ok());
            control.map(Some).ok_or_else(|| TeleopError::Control {
                message: format!(
                    "the model has no actuator {name:?}, which a glove's calibration or a leader's config names; in a calibration \"\" leaves a joint out"
                ),
            })
        };
        let names = leading.map(Leading::actuators).unwrap_or_default();
        let catching = match leading {
            Some(Leading::Arm(config)) => Some(Catching {
                settings: config.catch_up,
                scales: config.joints.iter().map(|joint| joint.scale.abs()).collect(),
                caught: false,
            }),
            _ => None,
        };
        Ok(Lead { controls: names.into_iter().map(control).collect::<Result<_, _>>()?, catching })
    }

    /// Makes the robot catch up before it follows again, since the leader may move in the meantime.
    pub fn let_go(&mut self) {
        if let Some(catching) = &mut self.catching {
            catching.caught = false;
        }
    }

    /// Moves entries of the action towards the targets of the device, by at most [`STEP`] of their ranges in a tick, times
    /// a fraction.
    ///
    /// # Errors
    /// The robot refuses.
    pub fn follow(
        &mut self,
        env: &Env,
        action: &mut [f64],
        led: &[f64],
        part: f64,
    ) -> Result<Reached, TeleopError> {
        let (model, normalized) = (&env.scene().model, env.settings().normalize_act);
        let mut wanted = action.to_vec();
        if normalized {
            env.robot().unnormalize(model, &mut wanted)?;
        }
        let now: Vec<f64> = self.controls.iter().map(|control| control.map_or(0.0, |k| wanted[k])).collect();
        let Some(led) = self.reach(env.dt(), &now, led) else { return Ok(Reached::Apart) };
        for (control, place) in self.controls.iter().zip(led) {
            if let Some(wanted) = control.and_then(|control| wanted.get_mut(control)) {
                *wanted = place;
            }
        }
        if normalized {
            env.robot().normalize(model, &mut wanted)?;
        }
        for control in self.controls.iter().flatten() {
            let [low, high] = env.action_bounds(*control);
            let most = part * STEP * (high - low);
            let (Some(place), Some(wanted)) = (action.get_mut(*control), wanted.get(*control)) else {
                continue;
            };
            *place = (*place + (wanted - *place).clamp(-most, most)).clamp(low, high);
        }
        Ok(Reached::Yes)
    }

    /// The controls after a tick of `dt` seconds towards their targets; `None` if they are too far away.
    fn reach(&mut self, dt: f64, now: &[f64], led: &[f64]) -> Option<Vec<f64>> {
        let Some(Catching { settings, scales, caught }) = self.catching.as_mut().filter(|c| !c.caught) else {
            return Some(led.to_vec());
        };
        let ways: Vec<f64> =
            led.iter().zip(now).zip(&*scales).map(|((to, at), scale)| (to - at) / scale).collect();
        let furthest = ways.iter().fold(0.0_f64, |furthest, way| furthest.max(way.abs()));
        if furthest > settings.far {
            return None;
        }
        *caught = furthest <= CAUGHT;
        let most = settings.speed * dt;
        let reached = |((at, way), scale): ((&f64, &f64), &f64)| at + way.clamp(-most, most) * scale;
        Some(now.iter().zip(&ways).zip(&*scales).map(reached).collect())
    }
}
