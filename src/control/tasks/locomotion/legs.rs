//! Legs of servos: the joints that bring each foot to a place relative to the root.

use crate::error::ControlError;
use crate::tasks::joints::{Servo, between};
use env::Env;
use physics::elements::{BodyId, JointId, SiteId};
use physics::math::{Vec3, add, cross, dot, mul_mat_vec, quat_mul, sub};
use physics::model::{JointType, TrnType};
use physics::position::kinematics::kinematics;
use physics::{Data, Model};
use robot::{Pose, Reach, Search};

/// Distance from its place at which a foot is there \[m\].
const TOLERANCE: f64 = 1e-4;
/// Largest number of updates of the search, which starts from the last solution.
const STEPS: usize = 20;
/// Share of the way to the standing pose that an update goes where the leg has more joints than it needs.
const PULL: f64 = 0.02;

struct Leg {
    foot: SiteId,
    joints: Vec<JointId>,
}

/// All legs of a body.
pub struct Legs {
    legs: Vec<Leg>,
    root: BodyId,
    /// The servo of each control that moves the body.
    servos: Vec<Option<Servo>>,
    stand: Vec<f64>,
    /// The body with its root where the model puts it, and its joints as they were found last.
    posed: Data,
}

impl Legs {
    /// The legs between a root and its feet, in the pose `stand` (nq).
    ///
    /// # Errors
    /// A foot that no servo moves.
    pub fn new(env: &Env, root: BodyId, feet: &[SiteId], stand: &[f64]) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let mut servos = vec![None; m.nu];
        let top = m.body_rootid[root.index()];
        for actuator in (0..m.nactuator).filter(|&a| m.actuator_trntype[a] == TrnType::Joint as i32) {
            let control = m.actuator_ctrladr[actuator] as usize;
            let moved = m.jnt_bodyid[m.actuator_trnid[actuator][0] as usize] as usize;
            if m.body_rootid[moved] != top {
                continue;
            }
            servos[control] = Some(Servo::new(m, actuator));
        }
        let leg = |foot: &SiteId| {
            let moved = |joint: &JointId| {
                let place = m.jnt_qposadr[joint.index()] as usize;
                servos.iter().flatten().any(|servo: &Servo| servo.place == place)
            };
            let joints: Vec<_> = between(m, root, *foot).into_iter().filter(moved).collect();
            let name = m.site(*foot).name().to_owned();
            if joints.is_empty() {
                return Err(ControlError::unfit(env, format!("no servo moves the foot {name}")));
            }
            Ok(Leg { foot: *foot, joints })
        };
        let legs = feet.iter().map(leg).collect::<Result<_, _>>()?;
        let mut posed = Data::new(m);
        posed.state.qpos.copy_from_slice(stand);
        free_root(m, root, &mut posed.state.qpos);
        kinematics(m, &posed.state, &mut posed.kin);
        let stand = posed.state.qpos.to_vec();
        Ok(Legs { legs, root, servos, stand, posed })
    }

    /// Returns to the standing pose.
    pub fn restart(&mut self, m: &Model) {
        self.posed.state.qpos.copy_from_slice(&self.stand);
        kinematics(m, &self.posed.state, &mut self.posed.kin);
    }

    /// Begins where the joints are (nq), so that the first motion is from there.
    pub fn begin(&mut self, m: &Model, qpos: &[f64]) {
        self.restart(m);
        for servo in self.servos.iter().flatten() {
            self.posed.state.qpos[servo.place] = qpos[servo.place];
        }
        kinematics(m, &self.posed.state, &mut self.posed.kin);
    }

    /// Where the feet are in the standing pose, relative to the root \[m\], in its frame.
    pub fn homes(&mut self, m: &Model) -> Vec<Vec3> {
        self.restart(m);
        let kin = &self.posed.kin;
        let (here, axes) = (kin.xpos[self.root.index()], kin.xmat[self.root.index()]);
        let home = |leg: &Leg| {
            let there = kin.site_xpos[leg.foot.index()];
            physics::math::mul_mat_t_vec(&axes, sub(there, here))
        };
        self.legs.iter().map(home).collect()
    }

    /// Writes the targets of all servos into `controls` (nu) that bring the feet to `poses`, relative to the root in its frame \[m\], within
    /// `dt` seconds: the positions of joints, and what the servos stay behind their motion. A foot that cannot reach its pose goes as
    /// near as possible; one without an orientation takes any.
    pub fn solve(&mut self, m: &Model, poses: &[Pose], dt: f64, controls: &mut [f64]) {
        let before = self.posed.state.qpos.to_vec();
        let root = self.root.index();
        let (here, axes) = (self.posed.kin.xpos[root], self.posed.kin.xmat[root]);
        let turn = self.posed.kin.xquat[root];
        for (leg, relative) in self.legs.iter().zip(poses) {
            let pose = Pose {
                position: relative.position.map(|place| add(here, mul_mat_vec(&axes, place))),
                orientation: relative.orientation.map(|orientation| quat_mul(turn, orientation)),
            };
            let search = Search { tolerance: TOLERANCE, max_steps: STEPS, ..Search::default() };
            let reach = Reach { joints: &leg.joints, rest: Some(&self.stand), pull: PULL };
            let found = search.run_within(m, &self.posed, leg.foot, &pose, &reach);
            self.posed.state.qpos.copy_from_slice(&found.qpos);
            kinematics(m, &self.posed.state, &mut self.posed.kin);
        }
        for (control, servo) in controls.iter_mut().zip(&self.servos) {
            if let Some(Servo { place, lag, .. }) = *servo {
                let now = self.posed.state.qpos[place];
                *control = now + lag * (now - before[place]) / dt;
            }
        }
    }
}

impl Legs {
    /// Adds to `controls` (nu) what the servos of a leg are off while they bear the leg's weight and a force of the ground \[N\] on its
    /// foot at `point`, world frame.
    pub fn bear(&self, m: &Model, d: &Data, leg: usize, (point, force): (Vec3, Vec3), controls: &mut [f64]) {
        for joint in &self.legs[leg].joints {
            let (place, dof) = (m.jnt_qposadr[joint.index()] as usize, m.jnt_dofadr[joint.index()] as usize);
            let lever = sub(point, d.kin.xanchor[joint.index()]);
            let torque = d.vel.qfrc_bias[dof] - dot(d.kin.xaxis[joint.index()], cross(lever, force));
            for (control, servo) in controls.iter_mut().zip(&self.servos) {
                if let Some(servo) = servo.filter(|servo| servo.place == place && servo.stiffness > 0.0) {
                    *control += torque / servo.stiffness;
                }
            }
        }
    }
}

/// Puts joints of the root and of the bodies above it where the model has them.
fn free_root(m: &Model, root: BodyId, qpos: &mut [f64]) {
    let mut body = root.index();
    while body > 0 {
        let first = m.body_jntadr[body].max(0) as usize;
        for joint in first..first + m.body_jntnum[body] as usize {
            let place = m.jnt_qposadr[joint] as usize;
            let count = if m.jnt_type[joint] == JointType::Free as i32 { 7 } else { 1 };
            qpos[place..place + count].copy_from_slice(&m.qpos0[place..place + count]);
        }
        body = m.body_parentid[body] as usize;
    }
}
