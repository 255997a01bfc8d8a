//! A zip: its slider is to be pulled along the teeth, from one end to the other.
//!
//! Observation: what all tasks of the suite observe; offset of the pull from the tool \[m\], the way of the slider that is left \[m\], the axis of
//! the zip, along which it closes, and the angle of the pull \[rad\]. Solved: no more than `within` is left, and the arm touches nothing, for
//! 0.5 s. The zip lies anywhere in the `area` of the station, turned by up to `turn`.

use super::HOLD;
use super::bench::{Bench, Start};
use super::place::{self, Area};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::{column, ops, sub};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the robot.
    roles: String,
    /// The pose of the roles in which the arm starts.
    pose: Option<String>,
    /// Largest difference of a joint from that pose at the start \[rad\].
    joint_noise: f64,
    /// Where the middle of the zip lies.
    area: Area,
    /// Largest angle between the zip and the x axis \[rad\].
    turn: f64,
    /// Way of the slider that may be left \[m\].
    within: f64,
}

/// The task.
#[derive(Clone)]
pub struct Zip {
    bench: Bench,
    zip: BodyId,
    pull: SiteId,
    /// Where `qpos` has the slider, and how far it goes \[m\].
    slider: (usize, f64),
    hinge: usize,
    args: Args,
    hold: Hold,
}

impl Zip {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no zip.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let start = Start { roles: &args.roles, pose: args.pose.as_deref(), noise: args.joint_noise };
        let bench = Bench::new("zip", start, setup)?;
        let (scene, m) = (&setup.scene, &setup.scene.model);
        let (slider, hinge) = (scene.joint("zip")?.index(), scene.joint("zip_pull")?.index());
        Ok(Zip {
            bench,
            zip: scene.body("zip")?,
            pull: scene.site("zip_pull")?,
            slider: (m.jnt_qposadr[slider] as usize, m.jnt_range[slider][1]),
            hinge: m.jnt_qposadr[hinge] as usize,
            args,
            hold: Hold::new(HOLD),
        })
    }

    /// The way of the slider that is left \[m\].
    fn left(&self, data: &Data) -> f64 {
        self.slider.1 - data.state.qpos[self.slider.0]
    }

    fn is_closed(&self, data: &Data) -> bool {
        self.left(data) < self.args.within && !self.bench.touches(data)
    }
}

impl Task for Zip {
    fn defaults(&self) -> Defaults {
        let own = ["pull_error", "left", "zip_axis", "pull_angle"];
        Bench::defaults(&own, &[("reach", -1.0), ("way", -5.0)])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.hold.begin();
        self.bench.start(episode)?;
        let [x, y] = place::draw(episode.rng, &self.args.area)?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(-self.args.turn, self.args.turn)? / 2.0);
        episode.scene.overwrite(|m| {
            (m.body_pos[self.zip][0], m.body_pos[self.zip][1]) = (x, y);
            m.body_quat[self.zip] = [cosine, 0.0, 0.0, sine];
        })
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.hold.leave(self.is_closed(&turn.scene.data));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let data = view.data;
        self.bench.observe(view, &self.hold, self.is_closed(data), rows);
        rows.set("pull_error", "m", sub(*data.site(self.pull).xpos(), self.bench.tool(data)));
        rows.set("left", "m", [self.left(data)]);
        rows.set("zip_axis", "", column(data.body(self.zip).xmat(), 0));
        rows.set("pull_angle", "rad", [data.state.qpos[self.hinge]]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        terms.set("reach", "m", [norm(&rows["pull_error"])]);
        terms.set("way", "m", [rows["left"][0]]);
        self.hold.judge(rows["held"][0], rows["holds"][0] > 0.5, false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        Bench::resting(&["left", "zip_axis", "pull_angle"])
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.hold.keep(keeper);
    }
}
