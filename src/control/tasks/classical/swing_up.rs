//! Swinging up by a trajectory that iLQR finds over the model itself, followed with the feedback that it finds along the way, and
//! balancing by the regulator of [`Balance`] once that can. Where the trajectory was lost, another one is looked for.

use super::balance::{Balance, Settings};
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::{Ilqr, Plan, Quadratic, Simulated};
use env::Env;
use physics::math::ops;
use std::f64::consts::{PI, TAU};

/// What is looked for, beside the pose.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    /// The pose, with the weights of the regulator.
    pub balance: Settings,
    /// Weights of the state on the way, positions, then velocities.
    pub running: &'static [f64],
    /// Weights of the last state.
    pub last: &'static [f64],
    /// Weight of the control on the way.
    pub effort: f64,
    /// Steps of the trajectory.
    pub knots: usize,
    /// Steps of the environment in one of the trajectory.
    pub hold: usize,
    /// What the regulator may still have to pay where it takes over.
    pub basin: f64,
    /// Periods \[s\] of the oscillating controls from which trajectories are looked for.
    pub periods: &'static [f64],
}

/// Two links of 1 m and 1 kg.
pub const ACROBOT: Swing = Swing {
    balance: Settings { goal: &[PI, 0.0], weights: &[10.0, 10.0, 1.0, 1.0], effort: 0.1 },
    running: &[0.02, 0.02, 0.01, 0.01],
    last: &[2000.0, 2000.0, 200.0, 200.0],
    effort: 0.01,
    knots: 100,
    hold: 2,
    basin: 50.0,
    periods: &[2.4, 1.8, 3.2, 1.4],
};

/// A pendulum of 0.13 m on an arm of 0.085 m.
pub const FURUTA: Swing = Swing {
    balance: Settings { goal: &[0.0, PI], weights: &[1.0, 20.0, 0.02, 0.1], effort: 2000.0 },
    running: &[0.02, 0.02, 0.0005, 0.0005],
    last: &[20.0, 2000.0, 5.0, 20.0],
    effort: 20.0,
    knots: 100,
    hold: 2,
    basin: 60.0,
    periods: &[0.7, 0.6, 0.9, 0.5],
};

/// Most improvements of a trajectory.
const ITERATIONS: usize = 150;
/// How much more the regulator may have to pay, once it acts, before it gives up.
const PATIENCE: f64 = 20.0;
/// Share of the bound that the first controls reach.
const FIRST: f64 = 0.3;

pub struct SwingUp {
    swing: Swing,
    balance: Balance,
    bounds: Vec<[f64; 2]>,
    plan: Option<Plan>,
    /// The regulator acts.
    balances: bool,
    /// Where joints that turn without end stood when the plan began, less where the plan has them.
    turned: Vec<f64>,
    /// Steps of the environment since the plan began.
    steps: usize,
    controls: Vec<f64>,
}

impl SwingUp {
    /// The controller for a model that the settings fit.
    ///
    /// # Errors
    /// As [`Balance::new`].
    pub fn new(env: &Env, swing: Swing) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        Ok(SwingUp {
            swing,
            balance: Balance::new(env, swing.balance)?,
            bounds: m.actuator_ctrlrange[..m.nu].to_vec(),
            plan: None,
            balances: false,
            turned: vec![0.0; m.nq],
            steps: 0,
            controls: vec![0.0; m.nu],
        })
    }

    /// Looks for a trajectory from the present state: the first that ends where the regulator takes over, or else the one that
    /// costs least.
    fn replan(&mut self, env: &Env) -> Result<(), ControlError> {
        let (scene, s) = (env.scene(), self.swing);
        let start = self.balance.error(env);
        let skip = env.frame_skip() * s.hold;
        let mut system = Simulated::new(&scene.model, &scene.data, s.balance.goal, skip)?;
        let states = start.len();
        let search = Ilqr {
            cost: Quadratic {
                goal: vec![0.0; states],
                running: s.running.to_vec(),
                last: s.last.to_vec(),
                effort: vec![s.effort; self.bounds.len()],
            },
            bounds: self.bounds.clone(),
            iterations: ITERATIONS,
            tolerance: 1e-4,
        };
        let mut best: Option<Plan> = None;
        for period in s.periods {
            let rate = TAU * env.dt() * s.hold as f64 / period;
            let first = |t: usize| {
                self.bounds.iter().map(|bound| FIRST * bound[1] * ops::sin(rate * t as f64)).collect()
            };
            let plan = search.solve(&mut system, &start, (0..s.knots).map(first).collect())?;
            let arrives = plan.states.last().is_some_and(|x| self.balance.regulator.to_pay(x) < s.basin);
            if best.as_ref().is_none_or(|best| plan.cost < best.cost) || arrives {
                best = Some(plan);
            }
            if arrives {
                break;
            }
        }
        let qpos = &scene.data.state.qpos;
        let places = qpos.iter().zip(s.balance.goal).zip(&start);
        self.turned = places.map(|((place, goal), start)| place - goal - start).collect();
        (self.plan, self.steps) = (best, 0);
        Ok(())
    }

    /// The state as the plan counts it: joints turn on where they began.
    fn unwrapped(&self, env: &Env) -> Vec<f64> {
        let state = &env.scene().data.state;
        let places = state.qpos.iter().zip(self.swing.balance.goal).zip(&self.turned);
        places
            .map(|((place, goal), turned)| place - goal - turned)
            .chain(state.qvel.iter().copied())
            .collect()
    }

    /// Writes the controls of the plan for the present state; `false` where it is over.
    fn follow(&mut self, env: &Env) -> bool {
        let Some(plan) = &self.plan else { return false };
        let (knot, within) = (self.steps / self.swing.hold, self.steps % self.swing.hold);
        if knot >= plan.controls.len() {
            return false;
        }
        // Between two steps of the plan its states are taken as linear.
        let share = within as f64 / self.swing.hold as f64;
        let mut x = self.unwrapped(env);
        for ((x, now), next) in x.iter_mut().zip(&plan.states[knot]).zip(&plan.states[knot + 1]) {
            *x -= share * (next - now);
        }
        plan.act(knot, &x, &self.bounds, &mut self.controls);
        self.steps += 1;
        true
    }
}

impl Controller for SwingUp {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        (self.plan, self.balances) = (None, false);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let error = self.balance.error(env);
        let basin = self.swing.basin * if self.balances { PATIENCE } else { 1.0 };
        self.balances = self.balance.regulator.to_pay(&error) < basin;
        if self.balances {
            self.plan = None;
            return command(env, self.balance.controls(&error), action);
        }
        if !self.follow(env) {
            self.replan(env)?;
            self.follow(env);
        }
        command(env, &self.controls, action)
    }
}
