//! A snake that swims: a wave runs along the body towards its tail (Lighthill, "Note on the swimming of slender fish", Journal of Fluid
//! Mechanics 9, 1960), and the whole body bends to the side to which it is to turn.

use super::wish::{Facts, Wish, wish};
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::tasks::roles::roles_of;
use env::Env;
use physics::Data;
use physics::math::{distance, ops};
use physics::model::TrnType;
use physics::position::kinematics::kinematics;
use robot::Walk;
use std::f64::consts::TAU;

/// Frequency of the wave \[Hz\].
const RATE: f64 = 2.0;
/// Waves on the body.
const WAVES: f64 = 1.0;
/// Bend of a joint at the swimming speed \[rad\], and the smallest: what does not swim cannot turn.
const BEND: [f64; 2] = [0.2, 0.1];
/// Bend of every joint that turns the body at its rate of turning \[rad\], and the most of it.
const STEER: [f64; 2] = [0.1, 0.3];
/// Share of what the velocity lacks of the wish that an act adds, and most that is added, in speeds.
const HURRY: [f64; 2] = [0.02, 0.6];

/// What was measured and wished for during the last wave: velocity forward \[m/s\] and rate of turning \[rad/s\] of both.
struct Wave {
    samples: Vec<[f64; 4]>,
    /// The oldest of them.
    next: usize,
}

impl Wave {
    /// Replaces the oldest sample; the mean of all.
    fn mean(&mut self, sample: [f64; 4]) -> [f64; 4] {
        self.samples[self.next] = sample;
        self.next = (self.next + 1) % self.samples.len();
        let count = self.samples.len() as f64;
        [0, 1, 2, 3].map(|i| self.samples.iter().map(|sample| sample[i]).sum::<f64>() / count)
    }
}

/// The controller.
pub struct Swim {
    /// Controls of the servos, from the head to the tail.
    joints: Vec<usize>,
    swim: Walk,
    /// Quarter of the length behind the root \[m\].
    quarter: f64,
    wish: Wish,
    phase: f64,
    wave: Wave,
    lacking: [f64; 2],
    controls: Vec<f64>,
}

impl Swim {
    /// The controller for a body that swims.
    ///
    /// # Errors
    /// A task without roles; a body that does not swim, or whose root the model has not.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let roles = roles_of(env)?;
        let body = roles.cast(m, "", "swim");
        let root = body.root().map_err(|error| ControlError::unfit(env, error.to_string()))?;
        let swim =
            body.swim().ok_or_else(|| ControlError::unfit(env, "the roles of its body have no [swim]"))?;
        let mut posed = Data::new(m);
        kinematics(m, &posed.state, &mut posed.kin);
        let from = |body: usize| distance(posed.kin.xpos[body], posed.kin.xpos[root.index()]);
        let servo = |&actuator: &usize| m.actuator_trntype[actuator] == TrnType::Joint as i32;
        let mut joints: Vec<(f64, usize)> = (0..m.nactuator)
            .filter(servo)
            .map(|actuator| {
                let joint = m.actuator_trnid[actuator][0] as usize;
                (from(m.jnt_bodyid[joint] as usize), m.actuator_ctrladr[actuator] as usize)
            })
            .collect();
        joints.sort_by(|a, b| a.0.total_cmp(&b.0));
        let samples = (1.0 / (RATE * env.dt())).round().max(1.0) as usize;
        Ok(Swim {
            quarter: joints.last().map_or(0.0, |(far, _)| far / 4.0),
            joints: joints.into_iter().map(|(_, control)| control).collect(),
            swim,
            wish: wish(&env.spec().task),
            phase: 0.0,
            wave: Wave { samples: vec![[0.0; 4]; samples], next: 0 },
            lacking: [0.0; 2],
            controls: vec![0.0; m.nu],
        })
    }
}

impl Controller for Swim {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        (self.phase, self.lacking) = (0.0, [0.0; 2]);
        self.wave.samples.fill([0.0; 4]);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let rows = env.rows().of("");
        let [ahead, _, round] = (self.wish)(&Facts { rows, walk: self.swim, height: self.quarter });
        let sample = [rows["velocity"][0], rows["turning"][2], ahead, round];
        let [velocity, turning, ahead, round] = self.wave.mean(sample);
        let Walk { speed, turn } = self.swim;
        let errors = [(ahead - velocity) / speed, (round - turning) / turn];
        for (lacking, error) in self.lacking.iter_mut().zip(errors) {
            *lacking = (*lacking + HURRY[0] * error).clamp(-HURRY[1], HURRY[1]);
        }
        self.phase += TAU * RATE * env.dt();
        let bend = (BEND[0] * (ahead / speed + self.lacking[0])).clamp(BEND[1], 2.0 * BEND[0]);
        let steer = (STEER[0] * (round / turn + self.lacking[1])).clamp(-STEER[1], STEER[1]);
        let count = self.joints.len() as f64;
        for (k, &control) in self.joints.iter().enumerate() {
            let late = TAU * WAVES * k as f64 / count;
            self.controls[control] = bend * ops::sin(self.phase - late) - steer;
        }
        command(env, &self.controls, action)
    }
}
