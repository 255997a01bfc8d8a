//! Reaching by inverse kinematics: the joints that bring the tip to the target are looked for once, from several postures, and the
//! nearest that were found without a collision on the way are approached by a minimum-jerk motion. What the servos lack of the way,
//! under the weight of the arm, is added to their targets step by step.

use super::named::site;
use super::starts::posture;
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::MinimumJerk;
use env::Env;
use physics::elements::{JointId, SiteId};
use physics::model::TrnType;
use physics::{Data, Model};
use robot::{Pose, Search};
use std::cmp::Ordering;

/// Fastest joint \[rad/s, m/s\].
const SPEED: f64 = 1.0;
/// Share of what the joints lack that a step adds to the targets.
const CORRECTION: f64 = 0.1;
/// Postures from which the joints are looked for; a search from the present one alone ends where a straight arm cannot bend.
const STARTS: usize = 12;
/// Distance from the target at which it is reached \[m\].
const TOLERANCE: f64 = 1e-3;
/// Places on the way at which it is looked whether the arm is in something, and depth at which it is \[m\].
const SAMPLES: usize = 8;
const INSIDE: f64 = 0.002;
/// Shortest motion \[s\].
const SHORTEST: f64 = 0.2;

pub struct Reach {
    tip: SiteId,
    target: SiteId,
    /// The joint that each actuator moves.
    joints: Vec<JointId>,
    motion: Option<MinimumJerk>,
    began: f64,
    /// What is added to the targets of the servos.
    correction: Vec<f64>,
    controls: Vec<f64>,
}

/// The joint that each actuator servos.
///
/// # Errors
/// An actuator that moves no joint.
fn servoed(env: &Env) -> Result<Vec<JointId>, ControlError> {
    let m = &env.scene().model;
    let joint = |k: usize| {
        let moves = m.actuator_trntype[k] == TrnType::Joint as i32;
        let id = usize::try_from(m.actuator_trnid[k][0]).ok().filter(|_| moves);
        let joint = id.and_then(|id| m.joints().nth(id));
        joint.ok_or_else(|| ControlError::unfit(env, format!("actuator {k} servos no joint")))
    };
    (0..m.nu).map(joint).collect()
}

impl Reach {
    /// The controller for an arm whose actuators servo joints.
    ///
    /// # Errors
    /// An actuator that moves no joint; settings without the names of tip and target.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        Ok(Reach {
            tip: site(env, "robot_site_name")?,
            target: site(env, "target_site_name")?,
            joints: servoed(env)?,
            motion: None,
            began: 0.0,
            correction: vec![0.0; m.nu],
            controls: vec![0.0; m.nu],
        })
    }

    /// Positions of the actuated joints.
    fn places(&self, env: &Env, qpos: &[f64]) -> Vec<f64> {
        let m = &env.scene().model;
        self.joints.iter().map(|joint| qpos[m.jnt_qposadr[joint.index()] as usize]).collect()
    }

    /// Puts the joints of a state.
    fn put(&self, m: &Model, data: &mut Data, places: &[f64]) {
        for (joint, place) in self.joints.iter().zip(places) {
            data.state.qpos[m.jnt_qposadr[joint.index()] as usize] = *place;
        }
    }

    /// At how many of some places on the way things are in each other.
    fn hits(&self, m: &Model, data: &mut Data, start: &[f64], end: &[f64]) -> Result<usize, ControlError> {
        let mut hits = 0;
        for sample in 1..=SAMPLES {
            let share = sample as f64 / SAMPLES as f64;
            let places: Vec<f64> = start.iter().zip(end).map(|(a, b)| a + share * (b - a)).collect();
            self.put(m, data, &places);
            physics::forward(m, data)?;
            hits += usize::from(data.con.contact.iter().any(|contact| contact.dist < -INSIDE));
        }
        Ok(hits)
    }
}

impl Controller for Reach {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let scene = env.scene();
        let goal = Pose { position: Some(*scene.data.site(self.target).xpos()), ..Pose::default() };
        let reach = robot::Reach { joints: &self.joints, rest: None, pull: 0.0 };
        let search = Search { tolerance: TOLERANCE, ..Search::default() };
        let start = self.places(env, &scene.data.state.qpos);
        let mut data = scene.data.clone();
        let mut found = Vec::new();
        for index in 0..STARTS {
            let from = if index == 0 { start.clone() } else { posture(&scene.model, &self.joints, index) };
            self.put(&scene.model, &mut data, &from);
            let solution = search.run_within(&scene.model, &data, self.tip, &goal, &reach);
            let end = self.places(env, &solution.qpos);
            let hits = self.hits(&scene.model, &mut data, &start, &end)?;
            let way = start.iter().zip(&end).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            found.push(([solution.error.max(TOLERANCE), hits as f64, way], end));
        }
        let nearest = found.into_iter().min_by(|(a, _), (b, _)| a.partial_cmp(b).unwrap_or(Ordering::Equal));
        let end = nearest.map_or_else(|| start.clone(), |(_, end)| end);
        let limits = vec![SPEED; start.len()];
        let duration = MinimumJerk::shortest(&start, &end, &limits).max(SHORTEST);
        self.motion = Some(MinimumJerk::between(&start, &end, duration)?);
        self.began = scene.data.time();
        self.correction.fill(0.0);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let Some(motion) = &self.motion else {
            return Err(ControlError::unfit(env, "reset comes before act"));
        };
        let (state, now) = (&env.scene().data.state, env.scene().data.time() - self.began);
        motion.position(now, &mut self.controls);
        let places = self.places(env, &state.qpos);
        for ((correction, wanted), place) in self.correction.iter_mut().zip(&self.controls).zip(&places) {
            *correction += CORRECTION * (wanted - place);
        }
        // Servos are told where to be at the end of the step.
        motion.position(now + env.dt(), &mut self.controls);
        self.controls.iter_mut().zip(&self.correction).for_each(|(target, more)| *target += more);
        command(env, &self.controls, action)
    }
}
