//! Reaching by inverse kinematics: the joints that bring the tip to the target are looked for once, and approached by a
//! minimum-jerk motion. What the servos lack of the way, under the weight of the arm, is added to their targets step by step.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::MinimumJerk;
use env::Env;
use physics::elements::{JointId, SiteId};
use physics::model::TrnType;
use robot::{Pose, Search};

/// Fastest joint \[rad/s, m/s\].
const SPEED: f64 = 1.0;
/// Share of what the joints lack that a step adds to the targets.
const CORRECTION: f64 = 0.1;
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

impl Reach {
    /// The controller for an arm whose actuators servo joints.
    ///
    /// # Errors
    /// An actuator that moves no joint; settings without the names of tip and target.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (scene, m) = (env.scene(), &env.scene().model);
        let name = |setting: &str| {
            let named = env.spec().args.get::<String>(setting);
            named.ok_or_else(|| ControlError::unfit(env, format!("the setting {setting} is needed")))
        };
        let joint = |k: usize| {
            let moves = m.actuator_trntype[k] == TrnType::Joint as i32;
            let id = usize::try_from(m.actuator_trnid[k][0]).ok().filter(|_| moves);
            let joint = id.and_then(|id| m.joints().nth(id));
            joint.ok_or_else(|| ControlError::unfit(env, format!("actuator {k} servos no joint")))
        };
        Ok(Reach {
            tip: scene.site(&name("robot_site_name")?)?,
            target: scene.site(&name("target_site_name")?)?,
            joints: (0..m.nu).map(joint).collect::<Result<_, _>>()?,
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
}

impl Controller for Reach {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let scene = env.scene();
        let goal = Pose { position: Some(*scene.data.site(self.target).xpos()), ..Pose::default() };
        let reach = robot::Reach { joints: &self.joints, rest: None, pull: 0.0 };
        let search = Search { tolerance: 1e-3, ..Search::default() };
        let solution = search.run_within(&scene.model, &scene.data, self.tip, &goal, &reach);
        let start = self.places(env, &scene.data.state.qpos);
        let end = self.places(env, &solution.qpos);
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
