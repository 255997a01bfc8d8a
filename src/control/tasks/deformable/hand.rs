//! A hand that follows a plan of straight motions: its fingertips move along minimum-jerk profiles, and inverse kinematics finds the joints
//! for every step, from those of the step before and near the posture at the start.

use crate::controller::command;
use crate::error::ControlError;
use crate::maths::MinimumJerk;
use crate::tasks::arms::reach::servoed;
use env::Env;
use physics::Data;
use physics::elements::{JointId, SiteId};
use physics::math::{Quat, Vec3, mat_to_quat, norm, ops, quat_normalize, sub};
use robot::{Pose, Reach, Search};

/// Share of the way back to the posture at the start that an update of the search goes in the freedom that is left.
const PULL: f64 = 0.02;
/// Distance at which the fingertips have arrived \[m\].
const THERE: f64 = 0.004;
/// Number of fingers, the last actuators.
const FINGERS: usize = 2;

/// A motion of the hand from where the last one ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Where the fingertips are at the end \[m\].
    pub tip: Vec3,
    /// How the hand is turned then.
    pub turn: Quat,
    /// What each finger is told from the beginning: its distance from the middle \[m\].
    pub fingers: f64,
    /// How long it takes \[s\].
    pub seconds: f64,
    /// For how long after that it waits for the fingertips, which the arm may not get there in time \[s\].
    pub patience: f64,
}

/// The hand pointing down, with fingers that open along the direction at `angle` in the plane of the table \[rad\].
pub fn down(angle: f64) -> Quat {
    let (sine, cosine) = ops::sincos(angle);
    // Columns are the axes of the hand: y where the fingers open, z down.
    mat_to_quat(&[-sine, cosine, 0.0, cosine, sine, 0.0, 0.0, 0.0, -1.0])
}

/// The hand of an arm whose last two actuators are its fingers.
pub struct Hand {
    site: SiteId,
    joints: Vec<JointId>,
    /// The posture at the start, and what the joints were last told (both nq).
    rest: Vec<f64>,
    told: Data,
    plan: Vec<Move>,
    /// The motion that is made, and when it began.
    step: usize,
    began: f64,
    from: Move,
    /// Where the hand was told to be last.
    at: Move,
    controls: Vec<f64>,
}

impl Hand {
    /// The hand with fingertips at the site `end_effector`.
    ///
    /// # Errors
    /// There is no such site; an actuator that moves no joint; too few actuators.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (scene, joints) = (env.scene(), servoed(env)?);
        if joints.len() <= FINGERS {
            return Err(ControlError::unfit(env, "the arm needs actuators for its joints and two fingers"));
        }
        let site = scene.site("end_effector")?;
        let from =
            Move { tip: [0.0; 3], turn: [1.0, 0.0, 0.0, 0.0], fingers: 0.0, seconds: 0.0, patience: 0.0 };
        Ok(Hand {
            site,
            rest: scene.data.state.qpos.to_vec(),
            told: scene.data.clone(),
            plan: Vec::new(),
            step: 0,
            began: 0.0,
            from,
            at: from,
            controls: vec![0.0; joints.len()],
            joints,
        })
    }

    /// Where the fingertips are \[m\].
    pub fn tip(&self, env: &Env) -> Vec3 {
        *env.scene().data.site(self.site).xpos()
    }

    /// How the hand is turned.
    pub fn turn(&self, env: &Env) -> Quat {
        mat_to_quat(env.scene().data.site(self.site).xmat())
    }

    /// Begins an episode with the hand where it is.
    pub fn begin(&mut self, env: &Env, plan: Vec<Move>) {
        let data = &env.scene().data;
        self.rest.copy_from_slice(&data.state.qpos);
        self.told.state.qpos.copy_from_slice(&data.state.qpos);
        self.from =
            Move { tip: self.tip(env), turn: self.turn(env), fingers: 0.0, seconds: 0.0, patience: 0.0 };
        self.at = self.from;
        (self.plan, self.step, self.began) = (plan, 0, data.time());
    }

    /// The last motion of the plan, if it is over.
    pub fn at_rest(&mut self, env: &Env) -> Option<Move> {
        self.advance(env);
        (self.step == self.plan.len()).then_some(self.from)
    }

    /// Follows another plan from where the hand was told to be last.
    pub fn go_on(&mut self, env: &Env, plan: Vec<Move>) {
        self.from = self.at;
        (self.plan, self.step, self.began) = (plan, 0, env.scene().data.time());
    }

    /// Goes on to the next motion where one is over.
    fn advance(&mut self, env: &Env) {
        let now = env.scene().data.time();
        while let Some(made) = self.plan.get(self.step) {
            let late = now - self.began - made.seconds;
            let there = norm(sub(self.tip(env), made.tip)) < THERE;
            if late < -env.dt() / 2.0 || (late < made.patience && !there) {
                return;
            }
            (self.from, self.began) = (*made, now);
            self.step += 1;
        }
    }

    /// Writes the action that the plan has for the end of the step.
    ///
    /// # Errors
    /// A motion that takes no time.
    pub fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        self.advance(env);
        let (to, mut share) = (*self.plan.get(self.step).unwrap_or(&self.from), [1.0]);
        if self.step < self.plan.len() {
            let profile = MinimumJerk::between(&[0.0], &[1.0], to.seconds)?;
            profile.position(env.scene().data.time() + env.dt() - self.began, &mut share);
        }
        self.at = between(&self.from, &to, share[0]);
        self.follow(env);
        command(env, &self.controls, action)
    }

    /// Finds the joints for where the hand is told to be.
    fn follow(&mut self, env: &Env) {
        let (m, at) = (&env.scene().model, self.at);
        let goal = Pose { position: Some(at.tip), orientation: Some(at.turn) };
        let arm = &self.joints[..self.joints.len() - FINGERS];
        let reach = Reach { joints: arm, rest: Some(&self.rest), pull: PULL };
        let search = Search { tolerance: 1e-4, max_steps: 20, ..Search::default() };
        let solution = search.run_within(m, &self.told, self.site, &goal, &reach);
        self.told.state.qpos.copy_from_slice(&solution.qpos);
        for (control, joint) in self.controls.iter_mut().zip(&self.joints) {
            *control = solution.qpos[m.jnt_qposadr[joint.index()] as usize];
        }
        let fingers = self.controls.len() - FINGERS;
        self.controls[fingers..].fill(at.fingers);
    }
}

/// A place between two, the fingers as in the second.
fn between(from: &Move, to: &Move, share: f64) -> Move {
    let near = (0..4).map(|i| from.turn[i] * to.turn[i]).sum::<f64>();
    let sign = if near < 0.0 { -1.0 } else { 1.0 };
    let turn: Quat = std::array::from_fn(|i| (1.0 - share) * sign * from.turn[i] + share * to.turn[i]);
    let tip: Vec3 = std::array::from_fn(|i| (1.0 - share) * from.tip[i] + share * to.tip[i]);
    Move { tip, turn: quat_normalize(turn), ..*to }
}
