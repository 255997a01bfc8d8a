//! Reaching: a site of the robot is to come close to a target site.

use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rotation::norm;
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
    robot_site_name: String,
    target_site_name: String,
    target_xyz_range: Ranges,
}

#[derive(Clone)]
pub struct Reach {
    tip: SiteId,
    target: SiteId,
    targets: Ranges,
    compat: Compat,
}

impl Reach {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings or sites are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(Reach {
            tip: setup.scene.site(&args.robot_site_name)?,
            target: setup.scene.site(&args.target_site_name)?,
            targets: args.target_xyz_range,
            compat: setup.compat,
        })
    }
}

impl Task for Reach {
    fn defaults(&self) -> Defaults {
        let weights = [("reach", -1.0), ("bonus", 4.0), ("penalty", -50.0)];
        Defaults::new(&["qp_robot", "qv_robot", "reach_err"], &weights, 40).proprio(&["qp_robot", "qv_robot"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let target = self.targets.draw(episode.rng)?;
        episode.scene.overwrite(|m| m.site_pos[self.target] = target)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        rows.set("qp_robot", "rad, m", &view.data.state.qpos);
        rows.set("qv_robot", "rad/s, m/s", &view.data.state.qvel);
        rows.set(
            "reach_err",
            "m",
            sub(*view.data.site(self.target).xpos(), *view.data.site(self.tip).xpos()),
        );
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(&rows["reach_err"]);
        terms.set("reach", "m", [distance]);
        terms.set("bonus", "", [bonus(self.compat, &[distance < 0.1, distance < 0.05])]);
        terms.set("penalty", "", [f64::from(distance > FAR)]);
        Verdict { sparse: -distance, solved: distance < 0.05, done: distance > FAR }
    }
}
