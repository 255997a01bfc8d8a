//! Pressing a sponge to a depth with the closed fingers, and holding it there.
//!
//! Observation beside that of all tasks: `sponge`, the places of the nodes that carry its elasticity \[m\]; `top`, the middle of its upper
//! face \[m\]; `depth`, how far that is below its height at rest \[m\]; `depth_error`, how far it is still to go \[m\]; `held`, for how
//! long it has been there \[s\]. Dense reward: minus ten times the error of the depth, minus the distance from the fingertips to the
//! middle of the upper face; one more while the depth is right, 100 at the end. Sparse reward: 1 while the depth is right. Solved: within
//! 2 mm of the depth for 1 s. The depth, 8 to 20 mm, and the place of the sponge are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::math::{Vec3, norm, sub};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// How far from the depth counts as there \[m\].
    tolerance: f64,
    /// For how long it is to be there \[s\].
    hold: f64,
    /// Depths to press to \[m\].
    depth_range: [f64; 2],
    /// Places of the sponge, from that in the scene \[m\].
    places: Ranges<2>,
}

/// The task.
#[derive(Clone)]
pub struct SpongePress {
    bench: Bench,
    /// Bodies of the nodes, and where `qpos` has their slides.
    nodes: Vec<[usize; 2]>,
    /// The vertex in the middle of the upper face.
    top: usize,
    rest: f64,
    tolerance: f64,
    depths: [f64; 2],
    places: Ranges<2>,
    wanted: f64,
    pressed: Hold,
}

impl SpongePress {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles or the flex are missing; a depth that is no pressing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if args.depth_range[0] <= args.tolerance {
            return Err(setup.wrong("depth_range begins above the tolerance, or a sponge at rest is pressed"));
        }
        let (bench, m) = (Bench::new(&args.arm, "press a sponge", setup)?, &setup.scene.model);
        if m.nflex != 1 || m.nflexnode == 0 {
            return Err(setup.wrong("the scene needs one flex that is moved by nodes"));
        }
        let node = |body: &i32| {
            let body = *body as usize;
            [body, m.jnt_qposadr[m.body_jntadr[body] as usize] as usize]
        };
        let vertices = &setup.scene.data.flex.flexvert_xpos;
        let middle = mean(vertices);
        let height = vertices.iter().map(|place| place[2]).fold(f64::NEG_INFINITY, f64::max);
        let away = |k: &usize| norm(sub(vertices[*k], [middle[0], middle[1], height]));
        let top = (0..vertices.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0);
        Ok(SpongePress {
            bench,
            nodes: m.flex_nodebodyid.iter().map(node).collect(),
            top,
            rest: vertices[top][2],
            tolerance: args.tolerance,
            depths: args.depth_range,
            places: args.places,
            wanted: args.depth_range[0],
            pressed: Hold::new(args.hold),
        })
    }

    /// How far the middle of the upper face is still to go down \[m\].
    fn error(&self, data: &Data) -> f64 {
        self.wanted - (self.rest - data.flex.flexvert_xpos[self.top][2])
    }
}

fn mean(places: &[Vec3]) -> Vec3 {
    let sum = places.iter().fold([0.0; 3], |sum, place| std::array::from_fn(|i| sum[i] + place[i]));
    sum.map(|x| x / places.len() as f64)
}

impl Task for SpongePress {
    fn defaults(&self) -> Defaults {
        let weights = [("depth", -10.0), ("reach", -1.0), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["arm_pos", "arm_vel", "tip", "sponge", "top", "depth", "depth_error", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let [x, y] = self.places.draw(episode.rng)?;
        self.wanted = episode.rng.uniform(self.depths[0], self.depths[1])?;
        for &[_, place] in &self.nodes {
            episode.start.qpos[place] += x;
            episode.start.qpos[place + 1] += y;
        }
        self.pressed.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let there = self.error(&turn.scene.data).abs() < self.tolerance;
        self.pressed.leave(there);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let error = self.error(view.data);
        self.bench.observe(view, rows);
        rows.set("sponge", "m", self.nodes.iter().flat_map(|node| view.data.kin.xpos[node[0]]));
        rows.set("top", "m", view.data.flex.flexvert_xpos[self.top]);
        rows.set("depth", "m", [self.wanted - error]);
        rows.set("depth_error", "m", [error]);
        rows.set("held", "s", [self.pressed.seconds(error.abs() < self.tolerance, view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let error = rows["depth_error"][0].abs();
        let way: Vec3 = std::array::from_fn(|i| rows["top"][i] - rows["tip"][i]);
        terms.set("depth", "m", [error]);
        terms.set("reach", "m", [norm(way)]);
        self.pressed.judge(rows["held"][0], error < self.tolerance, false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.number(&mut self.wanted);
        self.pressed.keep(keeper);
    }
}
