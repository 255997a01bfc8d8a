//! Where the agent starts: in a key frame of a step, perhaps elsewhere on the ground and looking elsewhere.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::{euler_of_quat, norm, quat_of_euler};
use crate::task::Pose;
use physics::Model;
use physics::math::ops;
use robot::Compat;
use serde::Deserialize;
use std::f64::consts::TAU;

/// Standard deviation of the joint positions around a key frame \[rad\].
const SPREAD: f64 = 0.02;
/// Starts lie within this distance of the middle, along x and along y \[m\].
const REACH: f64 = 5.0;
/// Key frames of standing, and of steps with either leg.
const STANDING: usize = 0;
const STEPS: [usize; 2] = [2, 3];

/// How an episode starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Start {
    /// Standing.
    None,
    /// In a step.
    Init,
    /// In one of two steps, anywhere, with noise.
    Random,
}

impl Start {
    /// What is missing in a model for starts of this kind.
    pub fn missing_keys(self, m: &Model) -> Option<String> {
        let needed = 1 + match self {
            Start::None => STANDING,
            Start::Init => STEPS[0],
            Start::Random => STEPS[1],
        };
        let fits = m.nkey >= needed && m.nq >= 7;
        (!fits).then(|| format!("episodes start in key frames, and its model has {} of {needed}", m.nkey))
    }

    /// Writes a start. In the original, noise turns the root although it is meant to keep its orientation.
    ///
    /// # Errors
    /// None in practice: all ranges are finite.
    pub fn draw(self, m: &Model, pose: &mut Pose, rng: &mut Rng, compat: Compat) -> Result<(), EnvError> {
        match self {
            Start::None => set_key(m, STANDING, pose),
            Start::Init => set_key(m, STEPS[0], pose),
            Start::Random => {
                set_key(m, STEPS[usize::from(rng.random() >= 0.5)], pose);
                let kept = [2, 3, 4, 5, 6].map(|k| pose.qpos[k]);
                for position in &mut pose.qpos {
                    *position += rng.normal(0.0, SPREAD)?;
                }
                let restored = if compat == Compat::Fixed { &kept[..] } else { &kept[..1] };
                pose.qpos[2..2 + restored.len()].copy_from_slice(restored);
                displace(pose, rng)?;
            }
        }
        Ok(())
    }
}

/// Moves and turns the agent, and the direction in which it moves.
fn displace(pose: &mut Pose, rng: &mut Rng) -> Result<(), EnvError> {
    rng.fill_uniform(-REACH, REACH, &mut pose.qpos[..2])?;
    let heading = rng.uniform(0.0, TAU)?;
    let [pitch, roll, _] = euler_of_quat([3, 4, 5, 6].map(|k| pose.qpos[k]));
    pose.qpos[3..7].copy_from_slice(&quat_of_euler([pitch, roll, heading]));
    let speed = norm(&pose.qvel[..2]);
    pose.qvel[..2].copy_from_slice(&[ops::cos(heading) * speed, ops::sin(heading) * speed]);
    Ok(())
}

/// Takes positions and velocities from a key frame.
pub fn set_key(m: &Model, key: usize, pose: &mut Pose) {
    pose.qpos.copy_from_slice(&m.key_qpos[key * m.nq..(key + 1) * m.nq]);
    pose.qvel.copy_from_slice(&m.key_qvel[key * m.nv..(key + 1) * m.nv]);
}
