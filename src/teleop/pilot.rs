//! Converts the input of a person to the action of an environment.

use crate::arm::Arm;
use crate::error::TeleopError;
use crate::lead::Lead;
use crate::mapping::Mapping;
use crate::motion::Motion;
use crate::reached::Reached;
use crate::trot::Trot;
use env::Env;

/// The part of the robot that a person drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The hand of an arm, by inverse kinematics.
    Hand,
    /// Joints one by one, or whatever the actuators move.
    Joints,
    /// The torso of a four-legged robot, by its velocity.
    Base,
}

/// Converts input to actions. A copy is sufficient to continue an episode from here.
#[derive(Clone, Debug)]
pub struct Pilot {
    driven: Driven,
    action: Vec<f64>,
}

#[derive(Clone, Debug)]
enum Driven {
    Arms(Vec<Arm>),
    Base(Box<Trot>),
    /// Entries of the action, the fraction of their range that a tick moves, and the controls that a device leads.
    Joints(Vec<f64>, f64, Lead),
}

impl Pilot {
    /// A pilot of an environment that was reset.
    ///
    /// # Errors
    /// The environment cannot be driven this way.
    pub fn new(env: &Env, control: Control, mapping: &Mapping) -> Result<Self, TeleopError> {
        let action = vec![0.0; env.action_len()];
        if action.is_empty() {
            return Err(TeleopError::Control {
                message: "the environment has no actuators to drive".to_owned(),
            });
        }
        let driven = match control {
            Control::Hand => Driven::Arms(Arm::all_of(env, &mapping.arm, mapping.gains)?),
            Control::Base => {
                Driven::Base(Box::new(Trot::of(&env.scene().model, &env.scene().data, mapping.base)?))
            }
            Control::Joints => {
                Driven::Joints(resting(env)?, mapping.gains.joint, Lead::of(env, mapping.led.as_ref())?)
            }
        };
        Ok(Pilot { driven, action })
    }

    /// Begins with an environment that was reset.
    ///
    /// # Errors
    /// The robot refuses.
    pub fn begin(&mut self, env: &Env) -> Result<(), TeleopError> {
        match &mut self.driven {
            Driven::Arms(arms) => arms.iter_mut().for_each(|arm| arm.begin(env)),
            Driven::Base(trot) => trot.stop(),
            Driven::Joints(at, ..) => *at = resting(env)?,
        }
        self.let_go();
        Ok(())
    }

    /// Pauses following: the robot catches up with a leader before it follows again.
    pub fn let_go(&mut self) {
        if let Driven::Joints(_, _, lead) = &mut self.driven {
            lead.let_go();
        }
    }

    /// Continues from the present state, after something else has moved the robot, so that nothing jumps.
    ///
    /// # Errors
    /// The robot refuses.
    pub fn take_over(&mut self, env: &Env) -> Result<(), TeleopError> {
        match &mut self.driven {
            Driven::Arms(arms) => arms.iter_mut().for_each(|arm| arm.take_over(env)),
            Driven::Base(trot) => trot.stop(),
            Driven::Joints(at, ..) => *at = last_action(env)?,
        }
        self.let_go();
        Ok(())
    }

    /// The action of the next tick.
    ///
    /// # Errors
    /// The robot refuses.
    pub fn act(&mut self, env: &mut Env, motion: &Motion) -> Result<(&[f64], Reached), TeleopError> {
        let normalized = env.settings().normalize_act;
        let mut reached = Reached::Yes;
        let live = env.is_live();
        match &mut self.driven {
            Driven::Arms(arms) => {
                let [low, high] = within(env)?;
                self.action.fill(0.0);
                for (arm, own) in arms.iter_mut().zip(&motion.arms) {
                    let outcome = arm.drive(env, (own, motion.pace()), [&low, &high], &mut self.action);
                    reached = if reached == Reached::Yes { outcome } else { reached };
                }
                if normalized {
                    env.robot().normalize(&env.scene().model, &mut self.action)?;
                }
            }
            Driven::Base(trot) => {
                let part = motion.pace();
                let (scene, wanted) = (env.scene(), motion.base.map(|x| part * x));
                trot.step(&scene.model, &scene.data, wanted, env.dt(), &mut self.action);
                if normalized {
                    env.robot().normalize(&env.scene().model, &mut self.action)?;
                }
            }
            Driven::Joints(at, gain, lead) => {
                if live && env.steps() > 0 {
                    // Targets beyond the robot's limits are dropped, so that it stops when the input ends.
                    *at = last_action(env)?;
                }
                let part = motion.pace();
                for &(joint, along) in &motion.joints {
                    let Some(place) = at.get_mut(joint) else { continue };
                    let [low, high] = env.action_bounds(joint);
                    *place = (*place + part * *gain * along * (high - low)).clamp(low, high);
                }
                if let Some(led) = &motion.led {
                    reached = lead.follow(env, at, led, part)?;
                }
                self.action.clone_from(at);
            }
        }
        Ok((&self.action, reached))
    }

    /// The arms that are driven: none, one, or the first and the left one.
    pub fn arms(&self) -> &[Arm] {
        match &self.driven {
            Driven::Arms(arms) => arms,
            Driven::Base(_) | Driven::Joints(..) => &[],
        }
    }
}

/// The smallest and the largest controls that the robot can follow in the next period.
fn within(env: &mut Env) -> Result<[Vec<f64>; 2], TeleopError> {
    let bounds: Vec<[f64; 2]> = (0..env.action_len()).map(|k| env.action_bounds(k)).collect();
    let mut end = |end: usize| env.controls_of(&bounds.iter().map(|bound| bound[end]).collect::<Vec<_>>());
    Ok([end(0)?, end(1)?])
}

/// The action that repeats the last controls.
fn last_action(env: &Env) -> Result<Vec<f64>, TeleopError> {
    action_of(env, env.robot().last_control().to_vec())
}

/// The action that holds the present state: the positions of the actuators' joints, and the middle of the range for other actuators.
fn resting(env: &Env) -> Result<Vec<f64>, TeleopError> {
    let (model, data) = (&env.scene().model, &env.scene().data);
    let mut controls: Vec<f64> = (0..env.action_len())
        .map(|control| {
            let [low, high] = model.actuator_ctrlrange[control];
            (low + high) / 2.0
        })
        .collect();
    for actuator in model.actuators() {
        let id = actuator.index();
        let control = usize::try_from(model.actuator_ctrladr[id]).ok();
        let servo = model.actuator_biasprm[id][1] < 0.0 && model.actuator_gear[id][0] == 1.0;
        let place = control.filter(|_| servo).and_then(|control| controls.get_mut(control));
        if let (Some(place), Some(length)) = (place, data.actuator(actuator).length().first()) {
            *place = *length;
        }
    }
    action_of(env, controls)
}

/// The action for these controls, within its bounds.
fn action_of(env: &Env, mut controls: Vec<f64>) -> Result<Vec<f64>, TeleopError> {
    if env.settings().normalize_act {
        env.robot().normalize(&env.scene().model, &mut controls)?;
    }
    let bounds = (0..env.action_len()).map(|k| env.action_bounds(k));
    Ok(controls.iter().zip(bounds).map(|(x, [low, high])| x.clamp(low, high)).collect())
}
