//! Twirling a pen until it points like its target.

use super::turning::{self, Placement};
use crate::error::EnvError;
use crate::rotation::{norm, quat_of_euler};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, scale, sub};
use robot::Keeper;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Whether targets are drawn.
    #[serde(default)]
    randomize: bool,
    #[serde(default)]
    muscle_condition: Condition,
}

/// A body with a site at each end of its axis.
#[derive(Clone)]
struct Rod {
    top: SiteId,
    bottom: SiteId,
    length: f64,
}

#[derive(Clone)]
pub struct PenTwirl {
    muscles: Muscles,
    object: BodyId,
    target: BodyId,
    place: SiteId,
    rods: [Rod; 2],
    randomize: bool,
}

impl PenTwirl {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or elements are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let scene = &*setup.scene;
        Ok(PenTwirl {
            muscles,
            object: scene.body("Object")?,
            target: scene.body("target")?,
            place: scene.site("eps_ball")?,
            rods: [Rod::new(scene, "object")?, Rod::new(scene, "target")?],
            randomize: args.randomize,
        })
    }
}

impl Rod {
    fn new(scene: &Scene, name: &str) -> Result<Self, EnvError> {
        let [top, bottom] = ["top", "bottom"].map(|end| scene.site(&format!("{name}_{end}")));
        let (top, bottom) = (top?, bottom?);
        let place = |site: SiteId| scene.model.site_pos[site.index()];
        Ok(Rod { top, bottom, length: norm(&sub(place(top), place(bottom))) })
    }

    fn axis(&self, data: &Data) -> Vec3 {
        scale(sub(*data.site(self.top).xpos(), *data.site(self.bottom).xpos()), 1.0 / self.length)
    }
}

impl Task for PenTwirl {
    fn defaults(&self) -> Defaults {
        let rows = ["hand_jnt", "obj_pos", "obj_vel", "obj_rot", "obj_des_rot", "obj_err_pos", "obj_err_rot"];
        self.muscles.defaults(&rows, &turning::WEIGHTS)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        turning::open_hand(&mut pose.qpos);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        if self.randomize {
            let [x, y] = [episode.rng.uniform(-1.0, 1.0)?, episode.rng.uniform(-1.0, 1.0)?];
            episode.scene.overwrite(|m| m.body_quat[self.target.index()] = quat_of_euler([x, y, 0.0]))?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let [axis, target] = [0, 1].map(|k| self.rods[k].axis(view.data));
        let position = *view.data.body(self.object).xpos();
        let place = *view.data.site(self.place).xpos();
        turning::observe(view, Placement { position, place, axis, target }, rows);
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        turning::reward(rows, terms)
    }

    fn constant_rows(&self) -> Vec<String> {
        if self.randomize { Vec::new() } else { vec!["obj_des_rot".into()] }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
    }
}
