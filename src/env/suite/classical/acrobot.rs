//! The acrobot: two links of 1 m and 1 kg that hang from a shoulder without a motor, and are to be swung up and balanced by a motor
//! between them (Spong, The swing up control problem for the acrobot, IEEE Control Systems 15, 1995; links, masses and damping as in
//! dm_control's suite, Tassa et al., arXiv 1801.00690, 2018).
//!
//! Action: torque of the motor between the links, -1 to 1 for -10 to 10 N m. Observation: cosines and sines of both links from
//! hanging, joint velocities \[rad/s\], seconds for which the tip has been up. Dense reward: height of the tip over the height of
//! both links, -1 to 1, one more while the tip is up, 100 at the end. Sparse reward: 1 while the tip is up. Solved: the tip is
//! above 1.9 of 2 m over the shoulder for 1 s, which ends the episode. Episodes start hanging, each joint within 0.1 rad, and last 20 s.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

/// Length of both links \[m\].
const LENGTH: f64 = 2.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Height of the tip over the shoulder that counts as up \[m\].
    height: f64,
    /// How long it is to stay up \[s\].
    hold: f64,
    /// Largest angle of a joint at the start \[rad\].
    joint_noise: f64,
}

#[derive(Clone)]
pub struct Acrobot {
    shoulder: BodyId,
    tip: SiteId,
    height: f64,
    noise: f64,
    up: Hold,
}

impl Acrobot {
    /// The task with these settings.
    ///
    /// # Errors
    /// A body or site is missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(Acrobot {
            shoulder: setup.scene.body("acrobot_upper")?,
            tip: setup.scene.site("acrobot_tip")?,
            height: args.height,
            noise: args.joint_noise,
            up: Hold::new(args.hold),
        })
    }

    /// Height of the tip over the shoulder \[m\].
    fn tip(&self, data: &Data) -> f64 {
        data.site(self.tip).xpos()[2] - data.body(self.shoulder).xpos()[2]
    }
}

impl Task for Acrobot {
    fn defaults(&self) -> Defaults {
        let weights = [("height", 1.0), ("held", 1.0), ("bonus", 100.0)];
        let defaults = Defaults::new(&["links", "velocities", "held"], &weights, 4);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["links", "velocities"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for angle in &mut episode.start.qpos {
            *angle += self.noise * episode.rng.uniform(-1.0, 1.0)?;
        }
        self.up.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.up.leave(self.tip(&turn.scene.data) > self.height);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let [upper, elbow] = [view.data.state.qpos[0], view.data.state.qpos[1]];
        let links = [upper, upper + elbow].map(ops::sincos);
        let tip = self.tip(view.data);
        rows.set("links", "", [links[0].1, links[0].0, links[1].1, links[1].0]);
        rows.set("velocities", "rad/s", &view.data.state.qvel);
        rows.set("tip", "m", [tip]);
        rows.set("held", "s", [self.up.seconds(tip > self.height, view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let tip = rows["tip"][0];
        terms.set("height", "", [tip / LENGTH]);
        self.up.judge(rows["held"][0], tip > self.height, false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.up.keep(keeper);
    }
}
