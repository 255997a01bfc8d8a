//! Parking a car with a trailer: iLQR plans over the kinematics of wheels that do not slip, again and again from where the car is, and
//! the feedback of the last plan acts in between.

use super::ground::pose;
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::{Dynamics, Ilqr, NoSolution, Plan, Quadratic};
use env::Env;
use physics::elements::BodyId;
use physics::math::ops;

/// Distance between the axles \[m\].
const BASE: f64 = 0.22;
/// Distance from the rear axle to the hitch \[m\].
const HITCH: f64 = 0.08;
/// Distance from the hitch to the trailer's axle \[m\].
const TRAILER: f64 = 0.22;
/// Time of a step of a plan \[s\].
const STEP: f64 = 0.12;
/// Steps of the first plan, and of the last ones.
const LONGEST: usize = 110;
const SHORTEST: usize = 25;
/// Steps of a plan after which another one is looked for.
const AGAIN: usize = 3;
/// Improvements of the first plan, and of those that follow it.
const FIRST: usize = 200;
const LATER: usize = 8;
/// Fastest \[m/s\], and steepest steering \[rad\].
const SPEED: f64 = 0.4;
const STEERING: f64 = 0.45;
/// Changes of speed \[m/s²\] and of steering \[rad/s\].
const RATES: [[f64; 2]; 2] = [[-0.8, 0.8], [-1.5, 1.5]];
/// Radius of a wheel \[m\].
const RADIUS: f64 = 0.04;

/// Place and heading of the car, angle of the trailer, speed, steering; controls are the rates of the last two.
struct Kinematics;

impl Kinematics {
    /// Rates of place, heading and angle of the trailer.
    fn rates(x: &[f64]) -> [f64; 4] {
        let (heading, trailer, speed) = (x[2], x[3], x[4]);
        let turning = speed * ops::tan(x[5]) / BASE;
        // Speed of the hitch across the trailer turns the trailer.
        let trailing = (-speed * ops::sin(trailer) - HITCH * turning * ops::cos(trailer)) / TRAILER;
        [speed * ops::cos(heading), speed * ops::sin(heading), turning, trailing - turning]
    }
}

impl Dynamics for Kinematics {
    fn states(&self) -> usize {
        6
    }

    fn controls(&self) -> usize {
        2
    }

    /// The midpoint rule, which follows arcs to second order.
    fn step(&mut self, x: &[f64], u: &[f64], next: &mut [f64]) -> Result<(), NoSolution> {
        let mut middle = x.to_vec();
        let rates = Self::rates(x);
        middle[..4].iter_mut().zip(rates).for_each(|(value, rate)| *value += 0.5 * STEP * rate);
        middle[4] += 0.5 * STEP * u[0];
        middle[5] += 0.5 * STEP * u[1];
        next.copy_from_slice(x);
        next[..4].iter_mut().zip(Self::rates(&middle)).for_each(|(value, rate)| *value += STEP * rate);
        next[4] = (x[4] + STEP * u[0]).clamp(-SPEED, SPEED);
        next[5] = (x[5] + STEP * u[1]).clamp(-STEERING, STEERING);
        Ok(())
    }
}

pub struct CarTrailer {
    car: BodyId,
    /// Position of the hitch.
    hitch: usize,
    /// Speed and steering that were asked for.
    asked: [f64; 2],
    plan: Option<Plan>,
    /// Time since the plan began \[s\].
    age: f64,
}

impl CarTrailer {
    /// The controller.
    ///
    /// # Errors
    /// The model has no car with a trailer.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (scene, m) = (env.scene(), &env.scene().model);
        let hitch = m.jnt_qposadr[scene.joint("hitch")?.index()] as usize;
        Ok(CarTrailer { car: scene.body("car")?, hitch, asked: [0.0; 2], plan: None, age: 0.0 })
    }

    fn state(&self, env: &Env) -> Vec<f64> {
        let [x, y, heading] = pose(env, self.car);
        vec![x, y, heading, env.scene().data.state.qpos[self.hitch], self.asked[0], self.asked[1]]
    }

    /// Plans from the present state, beginning with what is left of the last plan.
    fn replan(&mut self, env: &Env) -> Result<(), ControlError> {
        let search = |iterations| Ilqr {
            cost: Quadratic {
                goal: vec![0.0; 6],
                running: vec![0.1, 0.1, 0.02, 0.05, 0.02, 0.02],
                last: vec![4000.0, 4000.0, 1000.0, 1000.0, 100.0, 1.0],
                effort: vec![0.05, 0.02],
            },
            bounds: RATES.to_vec(),
            iterations,
            tolerance: 1e-5,
        };
        let start = self.state(env);
        let plan = match self.plan.take() {
            None => search(FIRST).solve(&mut Kinematics, &start, vec![vec![0.0; 2]; LONGEST])?,
            Some(last) => {
                let mut left = last.controls[AGAIN.min(last.controls.len())..].to_vec();
                left.resize(left.len().max(SHORTEST), vec![0.0; 2]);
                search(LATER).solve(&mut Kinematics, &start, left)?
            }
        };
        (self.plan, self.age) = (Some(plan), 0.0);
        Ok(())
    }
}

impl Controller for CarTrailer {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        (self.plan, self.asked) = (None, [0.0; 2]);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        if self.plan.is_none() || self.age > AGAIN as f64 * STEP - 1e-9 {
            self.replan(env)?;
        }
        let x = self.state(env);
        let mut rates = [0.0; 2];
        if let Some(plan) = &self.plan {
            plan.act((self.age / STEP) as usize, &x, &RATES, &mut rates);
        }
        self.age += env.dt();
        let limits = [SPEED, STEERING];
        for ((asked, rate), limit) in self.asked.iter_mut().zip(rates).zip(limits) {
            *asked = (*asked + env.dt() * rate).clamp(-limit, limit);
        }
        command(env, &[self.asked[0] / RADIUS, self.asked[1]], action)
    }
}
