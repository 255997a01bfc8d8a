//! The claw in a model: its joints, the poses it may take, and what all its tasks measure.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::scene::Scene;
use crate::spec::Spec;
use crate::task::View;
use physics::math::ops;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};
use std::ops::Range;

/// Joints of a finger: at the top, in the middle, at the bottom.
pub const JOINTS: usize = 3;

/// Where random poses lie, joint by joint of a finger \[rad\]. Middle joints bend outwards only, so that fingers do not get
/// entangled.
const POSES: [[f64; 2]; JOINTS] = [[-0.48, 0.48], [-FRAC_PI_3, 0.0], [-FRAC_PI_2, FRAC_PI_2]];

/// Consecutive joints in the state, finger after finger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fingers {
    /// Their places in `qpos`.
    pub qpos: Range<usize>,
    /// Their places in `qvel`.
    pub qvel: Range<usize>,
}

impl Fingers {
    /// The joints from the first to the last of `names`.
    ///
    /// # Errors
    /// A joint is missing; they are not hinges or slides of whole fingers, in this order.
    pub fn new(spec: &Spec, scene: &Scene, names: &[String; 2]) -> Result<Self, EnvError> {
        let [first, last] = names;
        let m = &scene.model;
        let (from, to) = (m.joint(scene.joint(first)?), m.joint(scene.joint(last)?));
        let fingers = Fingers {
            qpos: from.qpos_range().start..to.qpos_range().end,
            qvel: from.dof_range().start..to.dof_range().end,
        };
        let whole = !fingers.qpos.is_empty() && fingers.qpos.len().is_multiple_of(JOINTS);
        if !whole || fingers.qpos.len() != fingers.qvel.len() {
            let message = format!(
                "the joints from {first} to {last} are to be hinges of fingers, {JOINTS} each; here are {} \
                 positions and {} velocities",
                fingers.qpos.len(),
                fingers.qvel.len()
            );
            return Err(spec.wrong(message));
        }
        Ok(fingers)
    }
}

/// Draws a pose into `pose`, joint by joint.
///
/// # Errors
/// The generator's; none with these ranges.
pub fn draw_pose(rng: &mut Rng, pose: &mut [f64]) -> Result<(), EnvError> {
    for (angle, [low, high]) in pose.iter_mut().zip(POSES.into_iter().cycle()) {
        *angle = rng.uniform(low, high)?;
    }
    Ok(())
}

/// Length of the vector of those velocities that are `limit` or more.
pub fn excess(velocities: &[f64], limit: f64) -> f64 {
    ops::sqrt(
        velocities
            .iter()
            .filter(|velocity| velocity.abs() >= limit)
            .map(|velocity| velocity * velocity)
            .sum(),
    )
}

/// Length of the difference to a pose that every finger repeats \[rad\].
pub fn distance_to(angles: &[f64], finger: [f64; JOINTS]) -> f64 {
    ops::sqrt(
        angles.iter().zip(finger.into_iter().cycle()).map(|(angle, at)| (angle - at) * (angle - at)).sum(),
    )
}

/// The controls as actions: -1 to 1 over the ranges of the actuators. After a reset all are zero.
pub fn last_action<'a>(view: &View<'a>) -> impl Iterator<Item = f64> + use<'a> {
    let ranges = view.model.actuator_ctrlrange.iter();
    view.data.state.ctrl.iter().zip(ranges).map(|(control, [low, high])| {
        let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
        if half > 0.0 { (control - middle) / half } else { *control }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_count_what_they_say() {
        assert_eq!(excess(&[3.0, 0.4, -4.0, 0.5], 0.45), (9.0_f64 + 16.0 + 0.25).sqrt());
        assert_eq!(excess(&[0.5, -0.5], 0.5), 0.5_f64.sqrt());
        assert_eq!(excess(&[0.1, -0.4], 0.5), 0.0);
        assert_eq!(distance_to(&[1.0, 2.0, 3.0, 4.0, 2.0, -1.0], [1.0, 2.0, 3.0]), 5.0);
    }

    #[test]
    fn random_poses_bend_outwards() {
        let (mut rng, mut pose) = (Rng::pcg64(5_u64), [0.0; 9]);
        for _ in 0..100 {
            draw_pose(&mut rng, &mut pose).unwrap();
            for finger in pose.chunks(JOINTS) {
                assert!(finger[0].abs() <= 0.48 && (-FRAC_PI_3..=0.0).contains(&finger[1]));
                assert!(finger[2].abs() <= FRAC_PI_2);
            }
        }
    }
}
