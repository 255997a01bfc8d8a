//! Joints that actuators drive.

use physics::elements::{ActuatorId, JointId};
use physics::model::TrnType;
use physics::{Data, Model};

/// Largest offset of a command from the target of a joint, by which its servo holds the arm's weight \[rad\].
const DROOP: f64 = 0.2;

/// A joint that an actuator drives.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) joint: JointId,
    /// Its indices in `qpos` and `qvel`.
    pub(crate) position: usize,
    velocity: usize,
    /// The control of its actuator.
    pub(crate) control: usize,
    /// Stiffness of its position servo \[N m/rad\]; `None` for other actuators.
    stiffness: Option<f64>,
}

impl Link {
    /// Steady-state error of the joint under its present load \[rad\].
    pub(crate) fn droop(&self, data: &Data) -> f64 {
        let carried = data.vel.qfrc_bias[self.velocity] - data.passive.qfrc_gravcomp[self.velocity];
        self.stiffness.map_or(0.0, |stiffness| (carried / stiffness).clamp(-DROOP, DROOP))
    }

    /// Whether the actuator is a position servo.
    pub(crate) fn is_servo(&self) -> bool {
        self.stiffness.is_some()
    }
}

/// The link of an actuator that drives a joint.
pub(crate) fn link(model: &Model, actuator: ActuatorId, control: usize) -> Option<Link> {
    let id = actuator.index();
    let drives = matches!(TrnType::from_code(model.actuator_trntype[id]), Some(TrnType::Joint));
    let joint = usize::try_from(model.actuator_trnid[id][0]).ok().filter(|_| drives)?;
    let joint = model.joints().nth(joint)?;
    Some(Link {
        joint,
        position: model.jnt_qposadr[joint.index()] as usize,
        velocity: model.jnt_dofadr[joint.index()] as usize,
        control,
        stiffness: Some(-model.actuator_biasprm[id][1]).filter(|stiffness| *stiffness > 0.0),
    })
}
