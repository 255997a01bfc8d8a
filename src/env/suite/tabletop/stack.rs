//! Stacking: cube A is to stand on cube B (Gu et al., "ManiSkill2", 2023, whose StackCube has this test).
//!
//! Observation: what all tasks of the suite observe; offsets of the cube from the tool and of its place from the cube \[m\], the sides of
//! both cubes, their x axes, and the speed of A \[m/s\]. Solved: A is within half its size of the place in the plane, its height within 5 mm, it is at rest, and
//! the arm touches nothing, for 0.5 s. A cube that falls off the table ends the episode. Cubes start anywhere in the `area` of the
//! station, turned by any angle, at least `apart` from each other.

use super::bench::{Bench, Loose, Start};
use super::place::{self, Area};
use super::{HOLD, REST};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::math::{Vec3, add, column, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;

/// How far the height of the cube may be off \[m\].
const HEIGHT: f64 = 0.005;

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
    /// Where cubes start.
    area: Area,
    /// Least distance between the cubes at the start \[m\].
    apart: f64,
}

/// The task.
#[derive(Clone)]
pub struct Stack {
    bench: Bench,
    cubes: [Loose; 2],
    half: f64,
    floor: f64,
    args: Args,
    hold: Hold,
}

impl Stack {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no two cubes on free joints.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let start = Start { roles: &args.roles, pose: args.pose.as_deref(), noise: args.joint_noise };
        let bench = Bench::new("stack", start, setup)?;
        let cubes = [Loose::new("cube_a", setup)?, Loose::new("cube_b", setup)?];
        let half = setup.scene.model.geom_size[setup.scene.geom("cube_a")?.index()][0];
        let floor = setup.scene.data.body(cubes[1].body).xpos()[2] - 2.0 * half;
        if !place::fits([&args.area; 2], args.apart) {
            return Err(setup.wrong("apart is more than the area is wide"));
        }
        Ok(Stack { bench, cubes, half, floor, args, hold: Hold::new(HOLD) })
    }

    /// The way from the cube to its place on the other one \[m\].
    fn offset(&self, data: &Data) -> Vec3 {
        let [a, b] = self.cubes.map(|cube| *data.body(cube.body).xpos());
        sub(add(b, [0.0, 0.0, 2.0 * self.half]), a)
    }

    fn stands(&self, m: &Model, data: &Data) -> bool {
        let [x, y, z] = self.offset(data);
        norm(&[x, y]) < self.half
            && z.abs() < HEIGHT
            && self.cubes.iter().all(|cube| cube.speed(m, data) < REST)
            && !self.bench.touches(data)
    }
}

impl Task for Stack {
    fn defaults(&self) -> Defaults {
        let own = ["cube_error", "place_error", "cube_axes", "cube_speed"];
        Bench::defaults(&own, &[("reach", -1.0), ("place", -2.0)])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.hold.begin();
        self.bench.start(episode)?;
        let places = place::apart(episode.rng, [&self.args.area; 2], self.args.apart)?;
        for (cube, place) in self.cubes.into_iter().zip(places) {
            let yaw = episode.rng.uniform(-PI, PI)?;
            cube.put(episode, place, yaw);
        }
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.bench.observe(view, &self.hold, self.stands(view.model, view.data), rows);
        let [a, b] = self.cubes.map(|cube| view.data.body(cube.body));
        rows.set("cube_error", "m", sub(*a.xpos(), self.bench.tool(view.data)));
        rows.set("place_error", "m", self.offset(view.data));
        rows.set("cube_axes", "", [a.xmat(), b.xmat()].into_iter().flat_map(|axes| column(axes, 0)));
        rows.set("cube_speed", "m/s", [self.cubes[0].speed(view.model, view.data)]);
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.hold.leave(self.stands(&turn.scene.model, &turn.scene.data));
        Ok(())
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let height = rows["tool"][2] + rows["cube_error"][2];
        terms.set("reach", "m", [norm(&rows["cube_error"])]);
        terms.set("place", "m", [norm(&rows["place_error"])]);
        self.hold.judge(rows["held"][0], rows["holds"][0] > 0.5, height < self.floor, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        Bench::resting(&["cube_speed"])
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.hold.keep(keeper);
    }
}
