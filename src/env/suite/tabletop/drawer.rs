//! A drawer: it is to be pulled open, and a toy brick that lies on a stand is to be put into it.
//!
//! Observation: what all tasks of the suite observe; offsets of handle and brick from the tool \[m\], where the brick is in the frame of the drawer \[m\],
//! the brick's x axis, and how far the drawer is open \[m\]. Solved: the brick is in the drawer, at rest, and the arm touches nothing, for 0.5 s.
//! A brick that falls to the ground ends the episode. It starts anywhere in the `area` of the stand, turned by any angle; the drawer is shut.

use super::bench::{Bench, Loose, Start};
use super::place::{self, Area};
use super::{HOLD, REST};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, column, mul_mat_t_vec, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;

/// The inside of the drawer in its frame: half its length and width, and the height below which a brick lies in it \[m\].
const INSIDE: Vec3 = [0.21, 0.174, 0.0];
/// Height over the ground below which the brick has fallen \[m\].
const FALLEN: f64 = 0.3;

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
    /// Where the brick starts.
    area: Area,
}

/// The task.
#[derive(Clone)]
pub struct Drawer {
    bench: Bench,
    brick: Loose,
    drawer: BodyId,
    handle: SiteId,
    /// Where `qpos` has the drawer.
    slide: usize,
    area: Area,
    hold: Hold,
}

impl Drawer {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no drawer and no brick.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let start = Start { roles: &args.roles, pose: args.pose.as_deref(), noise: args.joint_noise };
        let scene = &setup.scene;
        Ok(Drawer {
            bench: Bench::new("drawer", start, setup)?,
            brick: Loose::new("block", setup)?,
            drawer: scene.body("desk_drawer")?,
            handle: scene.site("desk_drawer")?,
            slide: scene.model.jnt_qposadr[scene.joint("desk_drawer")?.index()] as usize,
            area: args.area,
            hold: Hold::new(HOLD),
        })
    }

    /// Where the brick is in the frame of the drawer \[m\].
    fn inside(&self, data: &Data) -> Vec3 {
        let (brick, drawer) = (data.body(self.brick.body), data.body(self.drawer));
        mul_mat_t_vec(drawer.xmat(), sub(*brick.xpos(), *drawer.xpos()))
    }

    fn holds(&self, m: &Model, data: &Data) -> bool {
        let [x, y, z] = self.inside(data);
        x.abs() < INSIDE[0]
            && y.abs() < INSIDE[1]
            && z < INSIDE[2]
            && self.brick.speed(m, data) < REST
            && !self.bench.touches(data)
    }
}

impl Task for Drawer {
    fn defaults(&self) -> Defaults {
        let own = ["handle_error", "brick_error", "brick_inside", "brick_axis", "drawer"];
        Bench::defaults(&own, &[("handle", -1.0), ("open", 5.0), ("place", -1.0)])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.hold.begin();
        self.bench.start(episode)?;
        let at = place::draw(episode.rng, &self.area)?;
        let yaw = episode.rng.uniform(-PI, PI)?;
        self.brick.put(episode, at, yaw);
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.hold.leave(self.holds(&turn.scene.model, &turn.scene.data));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let data = view.data;
        self.bench.observe(view, &self.hold, self.holds(view.model, data), rows);
        let (tool, brick) = (self.bench.tool(data), data.body(self.brick.body));
        rows.set("handle_error", "m", sub(*data.site(self.handle).xpos(), tool));
        rows.set("brick_error", "m", sub(*brick.xpos(), tool));
        rows.set("brick_inside", "m", self.inside(data));
        rows.set("brick_axis", "", column(brick.xmat(), 0));
        rows.set("drawer", "m", [data.state.qpos[self.slide]]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let height = rows["tool"][2] + rows["brick_error"][2];
        terms.set("handle", "m", [norm(&rows["handle_error"])]);
        terms.set("open", "m", [rows["drawer"][0]]);
        terms.set("place", "m", [norm(&rows["brick_inside"])]);
        self.hold.judge(rows["held"][0], rows["holds"][0] > 0.5, height < FALLEN, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        Bench::resting(&["drawer", "brick_axis", "brick_inside"])
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.hold.keep(keeper);
    }
}
