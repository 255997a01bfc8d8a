//! Weaving: to a place behind posts that stand in the way, without touching one.

use super::mark::Mark;
use super::walker::{Disturbance, Walker};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use robot::Keeper;
use serde::Deserialize;

/// Names of the posts begin so.
const POST: &str = "post";
/// Steps at the place that make a success: 0.5 s.
const STEPS: usize = 25;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the body.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Distance from one post to the next, and from the last one to the place, in heights of the root.
    spacing: f64,
    /// Largest distance of a post from the line to the place, in heights of the root.
    aside: f64,
    /// Distance from the place that solves the task, in heights of the root.
    radius: f64,
    /// Distance of the root from a post at which the body touches it, in heights of the root: half the width of the body and the
    /// post.
    clearance: f64,
}

/// The task.
#[derive(Clone)]
pub struct Weave {
    walker: Walker,
    mark: Mark,
    posts: Vec<BodyId>,
    spacing: f64,
    aside: f64,
    clearance: f64,
}

impl Weave {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no site `target` or no body whose name begins with `post`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let m = &setup.scene.model;
        let posts: Vec<_> =
            m.body_names().filter(|(_, name)| name.starts_with(POST)).map(|(id, _)| id).collect();
        if posts.is_empty() {
            return Err(setup.wrong("the model has no post: a body whose name begins with `post`"));
        }
        let walker = Walker::new(&args.roles, "weave", args.disturbance, setup)?;
        let height = walker.height;
        Ok(Weave {
            mark: Mark::new(args.radius, &walker, setup)?,
            posts,
            spacing: args.spacing * height,
            aside: args.aside * height,
            clearance: args.clearance * height,
            walker,
        })
    }
}

impl Task for Weave {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", 1.0), ("upright", 0.5), ("touch", 5.0), ("bonus", 2.0), ("fallen", 10.0)];
        Walker::defaults(&["target_error", "posts"], &weights, STEPS)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(&scene.model, pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)?;
        let [x, y] = self.walker.ahead_at_start();
        let at = |along: f64, left: f64| [along * x - left * y, along * y + left * x];
        for (k, post) in self.posts.iter().enumerate() {
            let left = episode.rng.uniform(-self.aside, self.aside)?;
            let [px, py] = at((k + 1) as f64 * self.spacing, left);
            episode
                .scene
                .overwrite(|m| (m.body_pos[post.index()][0], m.body_pos[post.index()][1]) = (px, py))?;
        }
        self.mark.put(episode.scene, at((self.posts.len() + 1) as f64 * self.spacing, 0.0))
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let posture = self.walker.observe(view, rows);
        self.mark.observe(&posture, view, rows);
        let posts = self.posts.iter().flat_map(|post| posture.towards(view.data.body(*post).xpos()));
        rows.set("posts", "m", posts);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(&rows["target_error"]);
        let nearest = rows["posts"].chunks(2).map(norm).fold(f64::INFINITY, f64::min);
        let touches = nearest < self.clearance;
        let solved = distance < self.mark.radius;
        terms.set("distance", "m", [-distance]);
        terms.set("touch", "", [-f64::from(touches)]);
        let verdict = self.walker.judge(solved, rows, terms);
        Verdict { done: verdict.done || touches, ..verdict }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
    }
}
