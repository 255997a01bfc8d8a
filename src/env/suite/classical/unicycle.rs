//! The unicycle: a body on two driven wheels is to come to a pose; it turns on the spot and rolls, and never moves sideways, so no
//! smooth feedback of the pose alone steadies it (Brockett, Asymptotic stability and feedback stabilization, 1983; Aicardi, Casalino,
//! Bicchi and Balestrino, Closed loop steering of unicycle-like vehicles via Lyapunov techniques, IEEE Robotics and Automation Magazine
//! 2, 1995). The wheels are bodies that touch the ground.
//!
//! Action: speeds of the left and the right wheel, -1 to 1 for -10 to 10 rad/s, which is 0.5 m/s. Observation: place \[m\], cosine
//! and sine of the heading, speed \[m/s\] and turning \[rad/s\], seconds for which it has been there. Dense reward: minus the distance
//! \[m\], minus half the angle \[rad\], one more while there, 100 at the end. Sparse reward: 1 while there. Solved: within
//! 5 cm and 5 degrees of the origin, looking along x, for 0.5 s, which ends the episode. Episodes start 0.8 to 1.5 m away in any direction, at any heading, and last 20 s.

use super::ground::{at_origin, pose, put, velocity};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Distance \[m\] and angle \[rad\] that count as there.
    within: [f64; 2],
    /// How long \[s\].
    hold: f64,
    /// Distances from the origin at the start \[m\].
    away: [f64; 2],
}

#[derive(Clone)]
pub struct Unicycle {
    body: BodyId,
    args: Args,
    there: Hold,
}

impl Unicycle {
    /// The task with these settings.
    ///
    /// # Errors
    /// The body is missing, or does not move freely.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let (body, joint) = (setup.scene.body("unicycle")?, setup.scene.joint("unicycle")?);
        if setup.scene.model.jnt_qposadr[joint.index()] != 0 {
            return Err(setup.wrong("the free joint of the unicycle is the model's first"));
        }
        Ok(Unicycle { body, there: Hold::new(args.hold), args })
    }
}

impl Task for Unicycle {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", -1.0), ("angle", -0.5), ("held", 1.0), ("bonus", 100.0)];
        let defaults = Defaults::new(&["place", "heading", "motion", "held"], &weights, 10);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["motion"])
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos.copy_from_slice(&scene.model.qpos0);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let distance = episode.rng.uniform(self.args.away[0], self.args.away[1])?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(-PI, PI)?);
        let heading = episode.rng.uniform(-PI, PI)?;
        put(&mut episode.start.qpos, [distance * cosine, distance * sine, heading]);
        self.there.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.there.leave(at_origin(pose(&turn.scene.data, self.body), self.args.within));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let pose = pose(view.data, self.body);
        let (sine, cosine) = ops::sincos(pose[2]);
        rows.set("place", "m", &pose[..2]);
        rows.set("heading", "", [cosine, sine]);
        rows.set("motion", "m/s, rad/s", velocity(view.data, self.body, 0));
        rows.set("held", "s", [self.there.seconds(at_origin(pose, self.args.within), view.dt)]);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let pose = pose(view.data, self.body);
        terms.set("distance", "m", [(pose[0] * pose[0] + pose[1] * pose[1]).sqrt()]);
        terms.set("angle", "rad", [pose[2].abs()]);
        self.there.judge(rows["held"][0], at_origin(pose, self.args.within), false, terms)
    }

    fn rewards_paths(&self) -> bool {
        false
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.there.keep(keeper);
    }
}
