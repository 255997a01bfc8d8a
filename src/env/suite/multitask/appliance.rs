//! An appliance in front of the robot, opened, closed, or anywhere around it.

use super::chore::{Args, Chore};
use crate::error::EnvError;
use crate::rotation::quat_of_euler;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use physics::elements::BodyId;
use physics::math::ops;
use robot::Keeper;
use toml::Table;

/// Share of a robot joint's span over which it starts.
const NOISE: f64 = 0.05;

/// The distance \[m\] of appliances from a point in front of the robot, and the angle \[rad\] around it.
const DISTANCE: [f64; 2] = [0.4, 0.7];
const ANGLE: [f64; 2] = [-1.57, 1.57];

/// How far ahead \[m\] that point is.
const AHEAD: f64 = 0.5;

#[derive(Clone)]
pub struct Appliance {
    chore: Chore,
    /// Bodies that every episode places.
    placed: Vec<BodyId>,
}

impl Appliance {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit; elements are missing.
    pub fn new(mut own: Table, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let placed: Vec<String> = match own.remove("obj_body_randomize") {
            None => Vec::new(),
            Some(names) => names
                .try_into()
                .map_err(|_| setup.wrong("obj_body_randomize is a list of names of bodies"))?,
        };
        let args: Args = setup.spec.task_args(own)?;
        let placed = placed.iter().map(|name| setup.scene.body(name)).collect::<Result<_, _>>()?;
        Ok(Appliance { chore: Chore::new(&args, setup)?, placed })
    }
}

impl Task for Appliance {
    fn defaults(&self) -> Defaults {
        self.chore.defaults(&["robot_jnt", "objs_jnt", "obj_goal", "goal_err", "approach_err"], false)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.chore.initial_pose(scene, pose)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for body in &self.placed {
            let distance = episode.rng.uniform(DISTANCE[0], DISTANCE[1])?;
            let angle = episode.rng.uniform(ANGLE[0], ANGLE[1])?;
            episode.scene.overwrite(|m| {
                let pos = &mut m.body_pos[body.index()];
                pos[0] = distance * ops::sin(angle);
                pos[1] = AHEAD + distance * ops::cos(angle);
                m.body_quat[body.index()] = quat_of_euler([0.0, 0.0, -angle]);
            })?;
        }
        self.chore.draw_first(episode.rng)?;
        self.chore.draw_goals(episode.rng)?;
        self.chore.place_objects(episode.start);
        self.chore.shake(NOISE, episode.rng, episode.start);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.chore.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        self.chore.reward(rows, terms)
    }

    fn constant_rows(&self) -> Vec<String> {
        self.chore.constant_rows()
    }

    fn resting_rows(&self) -> Vec<String> {
        ["objs_jnt", "goal_err"].map(String::from).into()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.chore.keep(keeper);
    }
}
