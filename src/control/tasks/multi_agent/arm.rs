//! An arm of servos whose tool follows minimum-jerk motions, and its gripper.

use crate::error::ControlError;
use crate::maths::MinimumJerk;
use crate::tasks::locomotion::legs::Legs;
use crate::tasks::roles::roles_of;
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{Quat, Vec3, mat_to_quat, mul_mat_t_vec, quat_conj, quat_mul, quat_normalize, sub};
use physics::position::kinematics::kinematics;
use physics::{Data, Model};
use robot::Pose;

/// Shortest motion \[s\].
const SHORTEST: f64 = 0.02;

/// A servo of the gripper: its control, and its positions when the gripper is open and closed.
struct Finger {
    control: usize,
    positions: [f64; 2],
}

/// An arm.
pub struct Arm {
    /// The arm as a limb, whose end is the tool.
    limb: Legs,
    root: BodyId,
    tool: SiteId,
    fingers: Vec<Finger>,
    /// Orientation of the tool when the arm is at home, where it points down.
    pub down: Quat,
    /// Place \[m\] and orientation of the tool over time.
    motion: Option<MinimumJerk>,
    began: f64,
    closed: bool,
}

impl Arm {
    /// The arm whose elements have names that begin with `prefix`.
    ///
    /// # Errors
    /// A task without roles, a model that does not fill them, an arm without servos.
    pub fn new(env: &Env, prefix: &str, name: &str) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let roles = roles_of(env)?;
        let unfit = |error: robot::ConfigError| ControlError::unfit(env, error.to_string());
        let cast = roles.cast(m, prefix, name);
        let (root, tool) = (cast.root().map_err(unfit)?, cast.tool().map_err(unfit)?);
        let pose = |named: &str| {
            let mut qpos = m.qpos0.to_vec();
            cast.pose(named, &mut qpos).map_err(unfit).map(|()| qpos)
        };
        let (home, open, closed) = (pose("home")?, pose("open")?, pose("closed")?);
        let mut data = Data::new(m);
        data.state.qpos.copy_from_slice(&home);
        kinematics(m, &data.state, &mut data.kin);
        Ok(Arm {
            limb: Legs::new(env, root, &[tool], &home)?,
            root,
            tool,
            fingers: fingers(m, &open, &closed),
            down: mat_to_quat(&data.kin.site_xmat[tool.index()]),
            motion: None,
            began: 0.0,
            closed: false,
        })
    }

    /// Begins where the arm is, with an open gripper.
    ///
    /// # Errors
    /// None that construction has not found.
    pub fn restart(&mut self, env: &Env) -> Result<(), ControlError> {
        let d = &env.scene().data;
        self.limb.begin(&env.scene().model, &d.state.qpos);
        let here = joined(self.place(env), mat_to_quat(&d.kin.site_xmat[self.tool.index()]));
        (self.closed, self.began) = (false, d.time());
        self.motion = Some(MinimumJerk::between(&here, &here, SHORTEST)?);
        Ok(())
    }

    /// Where the tool is \[m\].
    pub fn place(&self, env: &Env) -> Vec3 {
        env.scene().data.kin.site_xpos[self.tool.index()]
    }

    /// Where the tool is to be at a time \[s\].
    fn wanted(&self, time: f64) -> [f64; 7] {
        let mut pose = [0.0; 7];
        if let Some(motion) = &self.motion {
            motion.position(time - self.began, &mut pose);
        }
        pose
    }

    /// Moves the tool from where it is to be now to a place \[m\] and an orientation, within `seconds`.
    ///
    /// # Errors
    /// A time that is not positive.
    pub fn go(&mut self, env: &Env, place: Vec3, turn: Quat, seconds: f64) -> Result<(), ControlError> {
        let now = env.scene().data.time();
        let from = self.wanted(now);
        // The shorter way round.
        let along: f64 = (0..4).map(|i| from[3 + i] * turn[i]).sum();
        let turn = turn.map(|part| part * along.signum());
        self.motion = Some(MinimumJerk::between(&from, &joined(place, turn), seconds)?);
        self.began = now;
        Ok(())
    }

    /// Closes the gripper, or opens it.
    pub fn grip(&mut self, closed: bool) {
        self.closed = closed;
    }

    /// Writes the controls of the arm into `controls` (nu), by which the tool is where it is to be at the end of the step.
    pub fn act(&mut self, env: &Env, controls: &mut [f64]) {
        let (m, d, dt) = (&env.scene().model, &env.scene().data, env.dt());
        let [x, y, z, a, b, c, e] = self.wanted(d.time() + dt);
        let root = self.root.index();
        let pose = Pose {
            position: Some(mul_mat_t_vec(&d.kin.xmat[root], sub([x, y, z], d.kin.xpos[root]))),
            orientation: Some(quat_mul(quat_conj(d.kin.xquat[root]), quat_normalize([a, b, c, e]))),
        };
        self.limb.solve(m, &[pose], dt, controls);
        for finger in &self.fingers {
            controls[finger.control] = finger.positions[usize::from(self.closed)];
        }
    }
}

fn joined([x, y, z]: Vec3, [a, b, c, d]: Quat) -> [f64; 7] {
    [x, y, z, a, b, c, d]
}

/// Servos of the joints that are elsewhere when the gripper is closed.
fn fingers(m: &Model, open: &[f64], closed: &[f64]) -> Vec<Finger> {
    let servo = |actuator: usize| {
        let place = m.jnt_qposadr[usize::try_from(m.actuator_trnid[actuator][0]).ok()?] as usize;
        let control = m.actuator_ctrladr[actuator] as usize;
        (open[place] != closed[place]).then(|| Finger { control, positions: [open[place], closed[place]] })
    };
    (0..m.nactuator).filter_map(servo).collect()
}
