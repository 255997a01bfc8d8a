//! Walking with a torso that floats freely: the robot is to come to a target, looking at it.

use super::walk::{Gait, reward};
use crate::error::EnvError;
use crate::rotation::{cosine, norm};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use physics::elements::SiteId;
use physics::math::ops;
use serde::Deserialize;

/// Positions and degrees of freedom of the torso; the legs' stand behind them.
const TORSO: [usize; 2] = [7, 6];
/// Height of the torso's vertical axis below which the robot has fallen.
const UPRIGHT: f64 = 0.9;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    torso_site_name: String,
    target_site_name: String,
    /// Distance of the target \[m\].
    target_distance_range: [f64; 2],
    /// Direction of the target, from the x axis \[rad\].
    target_angle_range: [f64; 2],
    /// Largest turn of a joint away from the first key frame at the start \[rad\].
    joint_noise: f64,
}

#[derive(Clone)]
pub struct FreeWalk {
    torso: SiteId,
    target: SiteId,
    distance: [f64; 2],
    angle: [f64; 2],
    noise: f64,
    gait: Gait,
}

impl FreeWalk {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings, sites or the key frame are missing; the torso does not float.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let m = &setup.scene.model;
        if m.nkey == 0 || m.nq <= TORSO[0] || m.nq - m.nv != TORSO[0] - TORSO[1] {
            return Err(
                setup.wrong("the model needs a torso with a free joint, legs, and a key frame to stand in")
            );
        }
        let [low, high] = args.target_distance_range;
        Ok(FreeWalk {
            torso: setup.scene.site(&args.torso_site_name)?,
            target: setup.scene.site(&args.target_site_name)?,
            distance: args.target_distance_range,
            angle: args.target_angle_range,
            noise: args.joint_noise,
            gait: Gait { upright: UPRIGHT, distance: (low + high) / 2.0, height: m.key_qpos[2] },
        })
    }
}

impl Task for FreeWalk {
    fn defaults(&self) -> Defaults {
        let rows =
            ["upright", "joint_pos", "joint_vel", "torso_vel", "heading", "target_error", "last_action"];
        Defaults::new(&rows, &Gait::WEIGHTS, 40).proprio(&["joint_pos", "joint_vel"])
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos.copy_from_slice(&scene.model.key_qpos[..scene.model.nq]);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for angle in &mut episode.start.qpos[TORSO[0]..] {
            *angle += self.noise * episode.rng.uniform(-1.0, 1.0)?;
        }
        let distance = episode.rng.uniform(self.distance[0], self.distance[1])?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(self.angle[0], self.angle[1])?);
        let place = [distance * cosine, distance * sine, 0.0];
        episode.scene.overwrite(|m| m.site_pos[self.target.index()] = place)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let torso = view.data.site(self.torso);
        let (here, axes) = (*torso.xpos(), torso.xmat());
        let there = view.data.site(self.target).xpos();
        let offset = [there[0] - here[0], there[1] - here[1]];
        // Axis x or y of the torso, in the plane of the ground.
        let along = |axis: usize| axes[axis] * offset[0] + axes[3 + axis] * offset[1];
        rows.set("upright", "", [axes[8]]);
        rows.set("torso_pos", "m", here);
        rows.set("torso_vel", "m/s, rad/s", &state.qvel[..TORSO[1]]);
        rows.set("joint_pos", "rad", &state.qpos[TORSO[0]..]);
        rows.set("joint_vel", "rad/s", &state.qvel[TORSO[1]..]);
        rows.set("heading", "", [cosine(&[axes[1], axes[4]], &offset)]);
        rows.set("target_error", "m", [along(0), along(1)]);
        rows.set("last_action", "rad", &state.ctrl);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [heading, upright] = ["heading", "upright"].map(|row| rows[row][0]);
        reward(&self.gait, norm(&rows["target_error"]), heading, [upright, rows["torso_pos"][2]], terms)
    }
}
