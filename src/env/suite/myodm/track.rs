//! Grasping an object with a muscle-driven hand and moving it along a reference.

use super::reference::{Reference, Source};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::{euler_of_quat, norm, quat_of_mat, turn_between};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{ops, sub};
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::f64::consts::PI;

/// Coordinates of the object, the last ones of the model: three slides and three hinges.
const OBJECT_JOINTS: usize = 6;

/// Height above the place of the object in the model at which it counts as lifted \[m\].
const LIFTED: f64 = 0.02;

/// Distance from the reference, and from the wrist, at which the episode ends \[m\].
const LOST: f64 = 0.25;

/// Squared distance of joint positions from the reference at which an episode may end \[rad²\].
const ASTRAY: f64 = 0.75;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Name of the object's body.
    object_name: String,
    reference: Source,
    /// Part of the reference that is left out at its beginning \[s\].
    #[serde(default)]
    motion_start_time: f64,
    /// Whether losing the object ends the episode.
    #[serde(default = "yes", rename = "Termimate_obj_fail")]
    ends_without_object: bool,
    /// Whether leaving the joint positions of the reference ends the episode.
    #[serde(default, rename = "Termimate_pose_fail")]
    ends_astray: bool,
}

fn yes() -> bool {
    true
}

#[derive(Clone)]
pub struct Track {
    compat: Compat,
    muscles: Muscles,
    object: BodyId,
    wrist: BodyId,
    target: SiteId,
    reference: Reference,
    /// Draws of the reference in the original, which no seed of an episode restarts.
    own_rng: Rng,
    start_time: f64,
    lift_height: f64,
    ends_without_object: bool,
    ends_astray: bool,
}

impl Track {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings are wrong, the reference does not fit the model, or the model lacks the object.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(Condition::None, setup)?;
        let scene = &*setup.scene;
        let object = scene.body(&args.object_name)?;
        let Some(joints) = scene.model.nq.checked_sub(OBJECT_JOINTS) else {
            return Err(setup.wrong(format!("its model has fewer than {OBJECT_JOINTS} joints")));
        };
        let reference = args.reference.load(joints, setup.assets, setup.compat);
        Ok(Track {
            compat: setup.compat,
            muscles,
            object,
            wrist: scene.body("lunate")?,
            target: scene.site("target")?,
            reference: reference.map_err(|message| setup.wrong(message))?,
            own_rng: setup.rng.clone(),
            start_time: args.motion_start_time,
            lift_height: scene.data.body(object).xipos()[2] + LIFTED,
            ends_without_object: args.ends_without_object,
            ends_astray: args.ends_astray,
        })
    }

    /// Puts the mark where the object should be at a time \[s\].
    fn show_target(&self, scene: &mut Scene, time: f64) -> Result<(), EnvError> {
        let [x, y, z, ..] = self.reference.at(time + self.start_time).object;
        scene.overwrite(|m| m.site_pos[self.target.index()] = [x, y, z])
    }
}

impl Task for Track {
    fn defaults(&self) -> Defaults {
        let keys = ["qp", "qv", "hand_qpos_err", "hand_qvel_err", "obj_com_err"];
        let weights = [("pose", 0.0), ("object", 1.0), ("bonus", 1.0), ("penalty", -2.0)];
        self.muscles.defaults(&keys, &weights)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        let joints = pose.qpos.len() - OBJECT_JOINTS;
        let (robot, object) = pose.qpos.split_at_mut(joints);
        robot.copy_from_slice(self.reference.robot_init());
        let init = self.reference.object_init();
        object[..3].copy_from_slice(&init[..3]);
        object[3..].copy_from_slice(&euler_of_quat([init[3], init[4], init[5], init[6]]));
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        match self.compat {
            Compat::RoboHive07 => self.reference.draw(&mut self.own_rng)?,
            Compat::Fixed => self.reference.draw(episode.rng)?,
        }
        self.show_target(episode.scene, 0.0)?;
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)?;
        if self.compat == Compat::RoboHive07 {
            self.reference.draw(&mut self.own_rng)?;
        }
        let after = turn.scene.data.state.time + turn.dt;
        self.show_target(turn.scene, after)?;
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let hand = state.qpos.len() - OBJECT_JOINTS;
        let (positions, velocities) = (&state.qpos[..hand], &state.qvel[..hand]);
        let reference = self.reference.at(state.time + self.start_time);
        let off = || positions.iter().zip(reference.robot.values()).map(|(is, should)| is - should);
        rows.set("qp", "rad, m", &state.qpos);
        rows.set("qv", "rad/s, m/s", &state.qvel);
        rows.set("robot_err", "rad, m", off());
        rows.set("curr_hand_qpos", "rad, m", positions);
        rows.set("curr_hand_qvel", "rad/s, m/s", velocities);
        rows.set("targ_hand_qpos", "rad, m", reference.robot.values());
        let speed = reference.robot_vel;
        match speed {
            Some(speed) => rows.set("targ_hand_qvel", "rad/s, m/s", speed.values()),
            None => rows.set("targ_hand_qvel", "rad/s, m/s", [0.0]),
        }
        let object = view.data.body(self.object);
        let (place, wrist) = (*object.xipos(), *view.data.body(self.wrist).xipos());
        let [x, y, z, turn @ ..] = reference.object;
        rows.set("curr_obj_com", "m", place);
        rows.set("curr_obj_rot", "", quat_of_mat(object.ximat()));
        rows.set("wrist_err", "m", wrist);
        rows.set("base_error", "m", sub(place, wrist));
        rows.set("targ_obj_com", "m", [x, y, z]);
        rows.set("targ_obj_rot", "", turn);
        rows.set("hand_qpos_err", "rad, m", off());
        match speed {
            Some(speed) => {
                let off = velocities.iter().zip(speed.values()).map(|(is, should)| is - should);
                rows.set("hand_qvel_err", "rad/s, m/s", off);
            }
            None => rows.set("hand_qvel_err", "rad/s, m/s", [0.0]),
        }
        rows.set("obj_com_err", "m", sub(place, [x, y, z]));
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let square = |name: &str| rows[name].iter().map(|x| x * x).sum::<f64>();
        let quat = |name: &str| [0, 1, 2, 3].map(|k| rows[name][k]);
        let (angle, _) = turn_between(quat("targ_obj_rot"), quat("curr_obj_rot"));
        let (off, apart) = (norm(&rows["obj_com_err"]), norm(&rows["base_error"]));
        let lifted = |name: &str| rows[name][2] >= self.lift_height;
        let posture = square("hand_qpos_err");
        let pose = 0.35 * ops::exp(-5.0 * posture) + 0.05 * ops::exp(-0.1 * square("hand_qvel_err"));
        terms.set("pose", "", [pose]);
        let object = ops::exp(-50.0 * (off + 0.1 * (angle.abs() / PI)));
        terms.set("object", "", [object + ops::exp(-40.0 * apart)]);
        terms.set("bonus", "", [f64::from(lifted("targ_obj_com") && lifted("curr_obj_com"))]);
        let lost = self.ends_without_object && (off >= LOST || apart >= LOST);
        let done = lost || self.ends_astray && posture >= ASTRAY;
        terms.set("penalty", "", [f64::from(done)]);
        Verdict { sparse: 0.0, solved: false, done }
    }

    fn constant_rows(&self) -> Vec<String> {
        self.reference.constant_rows().into_iter().map(String::from).collect()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
        self.reference.keep(keeper);
        keeper.generator(&mut self.own_rng);
    }
}
