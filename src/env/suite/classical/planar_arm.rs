//! A redundant arm in a plane: six motors bring a tip to a point that two would reach (Maciejewski and Klein, Obstacle avoidance for
//! kinematically redundant manipulators in dynamically varying environments, International Journal of Robotics Research 4, 1985;
//! Khatib, A unified approach for motion and force control of robot manipulators: the operational space formulation, IEEE Journal on
//! Robotics and Automation 3, 1987).
//!
//! Action: torques, -1 to 1 for the range of each motor, 4 N m at the base to 1 N m at the tip. Observation: angles \[rad\] and velocities
//! \[rad/s\] of the joints, offset of the target from the tip \[m\], seconds for which the tip has been there. Dense reward: minus the
//! distance \[m\], one more while there, 100 at the end. Sparse reward: 1 while there. Solved: within 2 cm for 1 s, which ends the
//! episode. Episodes start with joints within 0.6 rad, the target anywhere 0.3 to 0.8 m from the base within 2 rad, at least 0.15 m from the tip, and last 8 s.

use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::SiteId;
use physics::math::{ops, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Distance that counts as there \[m\].
    within: f64,
    /// How long \[s\].
    hold: f64,
    /// Largest angle of a joint at the start \[rad\].
    joint_noise: f64,
    /// Distances of the target from the base \[m\].
    away: [f64; 2],
    /// Largest direction of the target from the x axis \[rad\].
    direction: f64,
    /// Least distance between target and tip at the start \[m\].
    apart: f64,
}

#[derive(Clone)]
pub struct PlanarArm {
    tip: SiteId,
    target: SiteId,
    args: Args,
    there: Hold,
}

impl PlanarArm {
    /// The task with these settings.
    ///
    /// # Errors
    /// A site is missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let (tip, target) = (setup.scene.site("arm_tip")?, setup.scene.site("arm_target")?);
        if args.away[1] - args.away[0] <= args.apart {
            return Err(setup.wrong("apart is less than the targets' distances differ"));
        }
        Ok(PlanarArm { tip, target, there: Hold::new(args.hold), args })
    }

    /// Offset of the target from the tip \[m\].
    fn offset(&self, m: &Model, data: &Data) -> [f64; 2] {
        let offset = sub(m.site_pos[self.target.index()], *data.site(self.tip).xpos());
        [offset[0], offset[1]]
    }
}

impl Task for PlanarArm {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", -1.0), ("held", 1.0), ("bonus", 100.0)];
        let defaults = Defaults::new(&["angles", "velocities", "target_error", "held"], &weights, 10);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["angles", "velocities"])
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.there.begin();
        // The tip is known only now.
        loop {
            let distance = episode.rng.uniform(self.args.away[0], self.args.away[1])?;
            let direction = episode.rng.uniform(-self.args.direction, self.args.direction)?;
            let (sine, cosine) = ops::sincos(direction);
            episode.scene.overwrite(|m| {
                let target = &mut m.site_pos[self.target.index()];
                (target[0], target[1]) = (distance * cosine, distance * sine);
            })?;
            if norm(&self.offset(&episode.scene.model, &episode.scene.data)) > self.args.apart {
                return Ok(());
            }
        }
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for angle in &mut episode.start.qpos {
            *angle += self.args.joint_noise * episode.rng.uniform(-1.0, 1.0)?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let offset = self.offset(&turn.scene.model, &turn.scene.data);
        self.there.leave(norm(&offset) < self.args.within);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let offset = self.offset(view.model, view.data);
        rows.set("angles", "rad", &view.data.state.qpos);
        rows.set("velocities", "rad/s", &view.data.state.qvel);
        rows.set("target_error", "m", offset);
        rows.set("held", "s", [self.there.seconds(norm(&offset) < self.args.within, view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(&rows["target_error"]);
        terms.set("distance", "m", [distance]);
        self.there.judge(rows["held"][0], distance < self.args.within, false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.there.keep(keeper);
    }
}
