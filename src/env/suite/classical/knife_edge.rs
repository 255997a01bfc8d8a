//! The knife edge: a puck that is pushed along an edge and turned, and cannot move across the edge, is to come to a point (Bloch,
//! Reyhanoglu and McClamroch, Control and stabilization of nonholonomic dynamic systems, IEEE Transactions on Automatic Control 37,
//! 1992). The edge is a free disc that touches the ground; three feet slide without friction.
//!
//! Action: push along the edge, -1 to 1 for -0.5 to 0.5 N, and torque about the vertical, for -0.03 to 0.03 N m. Observation: offset of the
//! point from the puck, along its axes \[m\], speed \[m/s\] and turning \[rad/s\], seconds for which it has been there. Dense
//! reward: minus the distance \[m\], one more while there, 100 at the end. Sparse reward: 1 while there. Solved: within 0.1 m of the point
//! for 2 s, which ends the episode. Episodes start at rest, at any heading, the point 1 to 2 m away in any direction, and last 20 s.

use super::ground::{pose, put, velocity};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::ops;
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Distance that counts as there \[m\].
    within: f64,
    /// How long \[s\].
    hold: f64,
    /// Distances of the point at the start \[m\].
    away: [f64; 2],
}

#[derive(Clone)]
pub struct KnifeEdge {
    puck: BodyId,
    goal: SiteId,
    args: Args,
    there: Hold,
}

impl KnifeEdge {
    /// The task with these settings.
    ///
    /// # Errors
    /// The puck or the point is missing, or the puck does not move freely.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let joint = setup.scene.joint("knife_edge")?;
        if setup.scene.model.jnt_qposadr[joint.index()] != 0 {
            return Err(setup.wrong("the free joint of the puck is the model's first"));
        }
        let (puck, goal) = (setup.scene.body("knife_edge")?, setup.scene.site("goal")?);
        Ok(KnifeEdge { puck, goal, there: Hold::new(args.hold), args })
    }

    /// Offset of the point along the axes of the puck \[m\].
    fn offset(&self, m: &Model, data: &Data) -> [f64; 2] {
        let ([x, y, heading], goal) = (pose(data, self.puck), m.site_pos[self.goal.index()]);
        let ((sine, cosine), away) = (ops::sincos(heading), [goal[0] - x, goal[1] - y]);
        [cosine * away[0] + sine * away[1], cosine * away[1] - sine * away[0]]
    }

    fn is_there(&self, [along, across]: [f64; 2]) -> bool {
        along * along + across * across < self.args.within * self.args.within
    }
}

impl Task for KnifeEdge {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", -1.0), ("held", 1.0), ("bonus", 100.0)];
        let defaults = Defaults::new(&["target_error", "motion", "held"], &weights, 10);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["motion"])
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos.copy_from_slice(&scene.model.qpos0);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let heading = episode.rng.uniform(-PI, PI)?;
        put(&mut episode.start.qpos, [0.0, 0.0, heading]);
        let distance = episode.rng.uniform(self.args.away[0], self.args.away[1])?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(-PI, PI)?);
        self.there.begin();
        episode.scene.overwrite(|m| {
            let goal = &mut m.site_pos[self.goal.index()];
            (goal[0], goal[1]) = (distance * cosine, distance * sine);
        })
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let offset = self.offset(&turn.scene.model, &turn.scene.data);
        self.there.leave(self.is_there(offset));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let offset = self.offset(view.model, view.data);
        rows.set("target_error", "m", offset);
        rows.set("motion", "m/s, rad/s", velocity(view.data, self.puck, 0));
        rows.set("held", "s", [self.there.seconds(self.is_there(offset), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let offset = [rows["target_error"][0], rows["target_error"][1]];
        terms.set("distance", "m", [(offset[0] * offset[0] + offset[1] * offset[1]).sqrt()]);
        self.there.judge(rows["held"][0], self.is_there(offset), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.there.keep(keeper);
    }
}
