//! Reorienting: an object between three fingers is to take a target's place and orientation.

use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rotation::{euler_of_mat, norm, quat_of_euler};
use crate::rows::Rows;
use crate::suite::bonus::bonus;
use crate::task::{Defaults, Episode, Setup, Task, Verdict, View};
use physics::elements::SiteId;
use physics::math::sub;
use robot::Compat;
use serde::Deserialize;

/// Beyond this distance \[m\] the episode ends.
const FAR: f64 = 1.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    object_site_name: String,
    target_site_name: String,
    target_xyz_range: Ranges,
    target_euler_range: Ranges,
}

#[derive(Clone)]
pub struct Reorient {
    object: SiteId,
    target: SiteId,
    places: Ranges,
    eulers: Ranges,
    compat: Compat,
}

impl Reorient {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings or sites are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(Reorient {
            object: setup.scene.site(&args.object_site_name)?,
            target: setup.scene.site(&args.target_site_name)?,
            places: args.target_xyz_range,
            eulers: args.target_euler_range,
            compat: setup.compat,
        })
    }
}

impl Task for Reorient {
    fn defaults(&self) -> Defaults {
        Defaults::new(
            &["qp", "qv", "reach_pos_err", "reach_rot_err"],
            &[("reach_pos", -1.0), ("reach_rot", -0.01), ("bonus", 4.0), ("penalty", -50.0)],
            40,
        )
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let pos = self.places.draw(episode.rng)?;
        let quat = quat_of_euler(self.eulers.draw(episode.rng)?);
        episode.scene.overwrite(|m| {
            m.site_pos[self.target.index()] = pos;
            m.site_quat[self.target.index()] = quat;
        })?;
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (object, target) = (view.data.site(self.object), view.data.site(self.target));
        rows.set("qp", "rad, m", &view.data.state.qpos);
        rows.set("qv", "rad/s, m/s", &view.data.state.qvel);
        rows.set("reach_pos_err", "m", sub(*target.xpos(), *object.xpos()));
        // A difference of angles, which jumps by a turn where one of them wraps around.
        rows.set("reach_rot_err", "rad", sub(euler_of_mat(target.xmat()), euler_of_mat(object.xmat())));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (place, turn) = (norm(&rows["reach_pos_err"]), norm(&rows["reach_rot_err"]));
        terms.set("reach_pos", "m", [place]);
        terms.set("reach_rot", "rad", [turn]);
        let near = [place < 0.1, place < 0.05, turn < 0.3, turn < 0.1];
        terms.set("bonus", "", [bonus(self.compat, &near)]);
        terms.set("penalty", "", [f64::from(place > FAR)]);
        Verdict { sparse: -place - turn, solved: place < 0.05 && turn < 0.1, done: place > FAR }
    }
}
