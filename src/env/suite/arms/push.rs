//! Pushing: an object on the table is to come to a target.

use super::delivery::{Delivery, Names};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Verdict, View};
use robot::Compat;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    robot_ndof: usize,
    robot_site_name: String,
    object_site_name: String,
    target_site_name: String,
    target_xyz_range: Ranges,
}

#[derive(Clone)]
pub struct Push {
    delivery: Delivery,
    targets: Ranges,
    compat: Compat,
}

impl Push {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings or sites are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let names = Names {
            robot_ndof: args.robot_ndof,
            robot_site_name: &args.robot_site_name,
            object_site_name: &args.object_site_name,
            target_site_name: &args.target_site_name,
        };
        let delivery = Delivery::new(setup.spec, setup.scene, &names)?;
        Ok(Push { delivery, targets: args.target_xyz_range, compat: setup.compat })
    }
}

impl Task for Push {
    fn defaults(&self) -> Defaults {
        Delivery::defaults().proprio(&Delivery::PROPRIO)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let target = self.targets.draw(episode.rng)?;
        episode.scene.overwrite(|m| m.site_pos[self.delivery.target.index()] = target)?;
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.delivery.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        Delivery::reward(self.compat, rows, terms)
    }
}
