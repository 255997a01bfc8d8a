//! Two arms that carry a tray, with a ball on it, to a place in the air, and keep it level.
//!
//! Each observes the way from the middle of the tray to the ball (`ball_error` \[m\]) and the upward normal of the tray (`tray_up`), in
//! the frame of its base.

use super::arms::{Arms, vector};
use super::part::{Part, STEPS, defaults};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use crate::team::Team;
use physics::elements::BodyId;
use physics::math::{Vec3, mul_mat_t_vec, norm, ops, sub};
use serde::Deserialize;
use std::ops::Range;

/// Height of the ball over the middle of the tray \[m\] beyond which, and below which, it is not on the tray.
const HEIGHTS: [f64; 2] = [0.0, 0.06];

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of both arms.
    roles: String,
    /// Largest difference of a joint from its pose at home at the start \[rad or m\].
    joint_noise: f64,
    /// Where the tray is at the start \[m\].
    load_range: Ranges<2>,
    /// Where the ball is on it \[m\].
    ball_range: Ranges<2>,
    /// Where the tray is to go \[m\].
    target_range: Ranges,
    /// Distance from there that solves the task \[m\].
    radius: f64,
    /// Largest lean of the tray that is level \[rad\].
    tilt: f64,
}

/// The task.
#[derive(Clone)]
pub struct CarryTray {
    arms: Arms,
    ball: BodyId,
    /// Where `qpos` has the free joint of the ball.
    pose: Range<usize>,
    /// Half the sides of the tray \[m\].
    half: [f64; 2],
    start: Ranges<2>,
    on_it: Ranges<2>,
    targets: Ranges,
    radius: f64,
    level: f64,
}

impl CarryTray {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles of `left` and `right`; it lacks a body `load` with a free joint and a geom `tray`, a site on it
    /// for each arm (`left_grip`), a body `ball` with a free joint, or a site `target`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let part = |name| Part {
            name,
            rows: &["ball_error", "tray_up"],
            own: &[("reach", 0.5)],
            shared: &[("distance", 1.0), ("level", 0.5), ("bonus", 2.0), ("dropped", 10.0)],
        };
        let parts = [part("left"), part("right")];
        let arms = Arms::new((&args.roles, args.joint_noise), "carry a tray", &parts, setup)?;
        let (ball, pose) = setup.loose_body("ball")?;
        let tray = setup.scene.geom("tray")?;
        let [x, y, _] = setup.scene.model.geom_size[tray.index()];
        Ok(CarryTray {
            arms,
            ball,
            pose,
            half: [x, y],
            start: args.load_range,
            on_it: args.ball_range,
            targets: args.target_range,
            radius: args.radius,
            level: ops::cos(args.tilt),
        })
    }

    /// The ball in the frame of the tray \[m\].
    fn ball(&self, view: &View<'_>) -> Vec3 {
        let kin = &view.data.kin;
        let (ball, tray) = (self.ball.index(), self.arms.load.index());
        mul_mat_t_vec(&kin.xmat[tray], sub(kin.xpos[ball], kin.xpos[tray]))
    }
}

impl Task for CarryTray {
    fn defaults(&self) -> Defaults {
        defaults(&self.arms.team, STEPS)
    }

    fn team(&self) -> Option<&Team> {
        Some(&self.arms.team)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.arms.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let [x, y] = self.start.draw(episode.rng)?;
        let [u, v] = self.on_it.draw(episode.rng)?;
        let target = self.targets.draw(episode.rng)?;
        episode.start.qpos[self.pose.start..self.pose.start + 2].copy_from_slice(&[x + u, y + v]);
        self.arms.start(episode, [x, y], target)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let kin = &view.data.kin;
        let (ball, tray) = (self.ball.index(), self.arms.load.index());
        let axes = kin.xmat[tray];
        self.arms.observe(view, rows, |local, rows| {
            rows.set("ball_error", "m", local(sub(kin.xpos[ball], kin.xpos[tray])));
            rows.set("tray_up", "", local([axes[2], axes[5], axes[8]]));
        });
        rows.set("ball_on_tray", "m", self.ball(view));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(vector(self.arms.row(rows, 0, "target_error")));
        let up = self.arms.row(rows, 0, "tray_up")[2];
        let [x, y, z] = vector(&rows["ball_on_tray"]);
        let on_it = x.abs() < self.half[0] && y.abs() < self.half[1] && z > HEIGHTS[0] && z < HEIGHTS[1];
        let held = [0, 1].iter().all(|&k| self.arms.row(rows, k, "hold")[0] > 0.0);
        let solved = distance < self.radius && up > self.level && on_it && held;
        terms.set("distance", "m", [-distance]);
        terms.set("level", "", [up - 1.0]);
        terms.set("bonus", "", [f64::from(solved)]);
        terms.set("dropped", "", [-f64::from(!on_it)]);
        self.arms.judge(rows, terms);
        Verdict { sparse: f64::from(solved), solved, done: !on_it }
    }

    fn resting_rows(&self) -> Vec<String> {
        self.arms.resting_rows()
    }
}
