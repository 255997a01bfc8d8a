//! The hand of the four tasks of Rajeswaran et al. (2018): the stiffness of its actuators, and where it starts.

use crate::error::EnvError;
use crate::scene::Scene;
use crate::task::Pose;

/// First and last actuator of a group, in the order of the model, and the stiffness of the group \[N m/rad\].
const STIFFNESS: [(&str, &str, f64); 2] = [("A_WRJ1", "A_WRJ0", 10.0), ("A_FFJ3", "A_THJ0", 1.0)];

/// Makes the wrist and the fingers servos of the stiffness that the tasks were learned with.
///
/// # Errors
/// The model lacks one of the actuators.
pub(super) fn set_stiffness(scene: &mut Scene) -> Result<(), EnvError> {
    for (first, last, stiffness) in STIFFNESS {
        let group = scene.actuator(first)?.index()..=scene.actuator(last)?.index();
        scene.overwrite(|m| {
            for actuator in group {
                m.actuator_gainprm[actuator][..3].copy_from_slice(&[stiffness, 0.0, 0.0]);
                m.actuator_biasprm[actuator][..3].copy_from_slice(&[0.0, -stiffness, 0.0]);
            }
        })?;
    }
    Ok(())
}

/// Every joint at zero and at rest, which need not be the middle of its range.
pub(super) fn start_at_zero(pose: &mut Pose) {
    pose.qpos.fill(0.0);
    pose.qvel.fill(0.0);
}
