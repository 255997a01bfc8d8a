//! Pushing a box to a place that is marked on the ground.

use super::mark::Mark;
use super::walker::{Disturbance, Walker};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

/// Steps with the box at the place that make a success: 0.5 s.
const STEPS: usize = 25;
/// Half the edge of the box, in heights of the root.
const HALF: f64 = 0.6;
/// Mass of the box, as a share of that of the body.
const MASS: f64 = 0.2;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the body.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Distance of the box from the body, in heights of the root.
    box_distance_range: [f64; 2],
    /// Distance that the box is to be pushed, in heights of the root.
    target_distance_range: [f64; 2],
    /// Direction of the place from the box, from where the body looks at the start \[rad\].
    target_angle_range: [f64; 2],
    /// Distance of the box from the place that solves the task, in heights of the root.
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct PushBox {
    walker: Walker,
    mark: Mark,
    load: BodyId,
    /// Where `qpos` has the free joint of the box.
    place: usize,
    near: [f64; 2],
    far: [f64; 2],
    angle: [f64; 2],
}

impl PushBox {
    /// The task with these settings. The box gets the size and a fifth of the mass of the body.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no site `target` or no body `box` with a free joint and one geom.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let walker = Walker::new(&args.roles, "push a box", args.disturbance, setup)?;
        let (height, body) = (walker.height, walker.mass(&setup.scene.model));
        let (load, pose) = setup.loose_body("box")?;
        let m = &setup.scene.model;
        if m.body_geomnum[load.index()] != 1 {
            return Err(setup.wrong("the body `box` needs one geom"));
        }
        let (place, geom) = (pose.start, m.body_geomadr[load.index()] as usize);
        let (half, mass) = (HALF * height, MASS * body);
        let inertia = mass * (2.0 * half).powi(2) / 6.0;
        setup.scene.model.edit(|m| {
            m.geom_size[geom] = [half; 3];
            m.body_mass[load.index()] = mass;
            m.body_inertia[load.index()] = [inertia; 3];
            m.qpos0[place + 2] = half;
        })?;
        Ok(PushBox {
            mark: Mark::new(args.radius, &walker, setup)?,
            load,
            place,
            near: args.box_distance_range.map(|distance| distance * height),
            far: args.target_distance_range.map(|distance| distance * height),
            angle: args.target_angle_range,
            walker,
        })
    }
}

impl Task for PushBox {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", 1.0), ("reach", 0.5), ("upright", 0.5), ("bonus", 2.0), ("fallen", 10.0)];
        Walker::defaults(&["box_error", "target_error"], &weights, STEPS)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(&scene.model, pose);
        pose.qpos[self.place + 2] = scene.model.qpos0[self.place + 2];
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)?;
        let [x, y] = self.walker.ahead_at_start();
        let near = episode.rng.uniform(self.near[0], self.near[1])?;
        let far = episode.rng.uniform(self.far[0], self.far[1])?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(self.angle[0], self.angle[1])?);
        let here = [near * x, near * y];
        episode.start.qpos[self.place..self.place + 2].copy_from_slice(&here);
        let there = [here[0] + far * (cosine * x - sine * y), here[1] + far * (cosine * y + sine * x)];
        self.mark.put(episode.scene, there)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let posture = self.walker.observe(view, rows);
        rows.set("box_error", "m", posture.towards(view.data.body(self.load).xpos()));
        self.mark.observe(&posture, view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (load, place) = (&rows["box_error"], &rows["target_error"]);
        let distance = norm(&[place[0] - load[0], place[1] - load[1]]);
        let solved = distance < self.mark.radius;
        terms.set("distance", "m", [-distance]);
        terms.set("reach", "m", [-norm(load)]);
        self.walker.judge(solved, rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
    }
}
