//! Joints between two parts of a body, and the servos that move them.

use crate::error::ControlError;
use env::Env;
use physics::Model;
use physics::elements::{BodyId, Element, JointId, SiteId};
use physics::model::{BiasType, TrnType};

/// An actuator that moves a joint.
#[derive(Clone, Copy)]
pub struct Servo {
    /// The place in `qpos` of the joint that it moves.
    pub place: usize,
    /// How long it stays behind a steady motion: damping over stiffness \[s\].
    pub lag: f64,
    /// Torque for each radian that the joint is off \[N m/rad\]; 0 for a motor, which is told a torque and not a position.
    pub stiffness: f64,
}

impl Servo {
    /// The servo that an actuator of a joint is.
    pub fn new(m: &Model, actuator: usize) -> Self {
        let joint = m.actuator_trnid[actuator][0] as usize;
        let feeds_back = m.actuator_biastype[actuator] == BiasType::Affine as i32;
        let [stiffness, damping] =
            [1, 2].map(|i| if feeds_back { -m.actuator_biasprm[actuator][i] } else { 0.0 });
        let passive = m.dof_damping[m.jnt_dofadr[joint] as usize];
        let lag = if stiffness > 0.0 { (damping + passive) / stiffness } else { 0.0 };
        Servo { place: m.jnt_qposadr[joint] as usize, lag, stiffness }
    }
}

/// The first place in `qpos` of the joints whose first and last a setting names.
///
/// # Errors
/// The setting or the joint is missing.
pub fn first_place(env: &Env, setting: &str) -> Result<usize, ControlError> {
    let named = env.spec().args.get::<[String; 2]>(setting);
    let [name, _] =
        named.ok_or_else(|| ControlError::unfit(env, format!("the setting {setting} is needed")))?;
    let scene = env.scene();
    Ok(scene.model.joint(scene.joint(&name)?).qpos_range().start)
}

/// The control of the actuator that moves a joint, and its servo.
pub fn servo_of(m: &Model, joint: JointId) -> Option<(usize, Servo)> {
    let moves = |&actuator: &usize| {
        m.actuator_trntype[actuator] == TrnType::Joint as i32
            && m.actuator_trnid[actuator][0] == joint.index() as i32
    };
    let actuator = (0..m.nactuator).find(moves)?;
    Some((m.actuator_ctrladr[actuator] as usize, Servo::new(m, actuator)))
}

/// Hinges and slides on the way from the root to a site, the nearest to the root first.
pub fn between(m: &Model, root: BodyId, site: SiteId) -> Vec<JointId> {
    let mut body = m.site_bodyid[site.index()] as usize;
    let mut joints = Vec::new();
    while body != root.index() && body > 0 {
        let first = m.body_jntadr[body].max(0) as usize;
        let own = (first..first + m.body_jntnum[body] as usize).rev();
        joints.extend(own.filter_map(|joint| JointId::at(m, joint)));
        body = m.body_parentid[body] as usize;
    }
    joints.reverse();
    joints
}
