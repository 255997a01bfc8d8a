//! Insertion: a square peg is to stand in the hole of a board (Gu et al., "ManiSkill2", 2023, has a peg and a hole that lie).
//!
//! Observation: what all tasks of the suite observe; offsets of the upper half of the peg from the tool and of the bottom of the hole from the tip of
//! the peg \[m\], the peg's z and x axes, and the x axis of the board. Solved: the tip is at least `depth` in the hole, the peg is at rest, and
//! the arm touches nothing, for 0.5 s. A peg that falls off the table ends the episode. Peg and board start anywhere in the `area` of
//! the station, turned by any angle. `clearance` is by how much the hole is wider than the peg.

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
use physics::math::{Vec3, add_scaled, column, ops, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;

/// Width of the hole \[m\].
const HOLE: f64 = 0.03;
/// By how much the tip is thinner than the peg \[m\].
const TAPER: f64 = 0.004;
/// Distance from the middle of the peg to the part that is to be grasped \[m\].
const GRASP: f64 = 0.025;

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
    /// Where peg and board start.
    area: Area,
    /// Least distance between them at the start \[m\].
    apart: f64,
    /// By how much the hole is wider than the peg \[m\].
    clearance: f64,
    /// How deep the tip is to be in the hole \[m\].
    depth: f64,
}

/// The task.
#[derive(Clone)]
pub struct Insert {
    bench: Bench,
    peg: Loose,
    board: BodyId,
    tip: SiteId,
    /// The mouth of the hole, and its bottom.
    hole: [SiteId; 2],
    floor: f64,
    args: Args,
    hold: Hold,
}

impl Insert {
    /// The task with these settings. The peg gets its width.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no peg and board; a clearance that leaves no peg.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let start = Start { roles: &args.roles, pose: args.pose.as_deref(), noise: args.joint_noise };
        let bench = Bench::new("insert", start, setup)?;
        let (peg, board) = (Loose::new("peg", setup)?, setup.scene.body("board")?);
        if !(0.0..HOLE / 2.0).contains(&args.clearance) {
            return Err(setup.wrong(format!("clearance is {}, not 0 to {} m", args.clearance, HOLE / 2.0)));
        }
        if !place::fits(&args.area, args.apart) {
            return Err(setup.wrong("apart is more than the area is wide"));
        }
        let geoms: Vec<usize> = setup.scene.model.body(peg.body).geoms().map(|geom| geom.index()).collect();
        let half = (HOLE - args.clearance) / 2.0;
        setup.scene.model.edit(|m| {
            for (geom, half) in geoms.iter().zip([half, half - TAPER / 2.0]) {
                (m.geom_size[*geom][0], m.geom_size[*geom][1]) = (half, half);
            }
        })?;
        let site = |name: &str| setup.scene.site(name);
        let (tip, hole) = (site("peg_tip")?, [site("board_hole")?, site("board_bottom")?]);
        let floor = setup.scene.data.body(peg.body).xpos()[2] - 0.2;
        Ok(Insert { bench, peg, board, tip, hole, floor, args, hold: Hold::new(HOLD) })
    }

    /// The way from the tip of the peg to a site \[m\].
    fn way(&self, data: &Data, site: SiteId) -> Vec3 {
        sub(*data.site(site).xpos(), *data.site(self.tip).xpos())
    }

    fn stands(&self, m: &Model, data: &Data) -> bool {
        let [x, y, z] = self.way(data, self.hole[0]);
        norm(&[x, y]) < HOLE / 2.0
            && z > self.args.depth
            && self.peg.speed(m, data) < REST
            && !self.bench.touches(data)
    }
}

impl Task for Insert {
    fn defaults(&self) -> Defaults {
        let own = ["peg_error", "hole_error", "peg_axes", "board_axis"];
        Bench::defaults(&own, &[("reach", -1.0), ("place", -2.0)])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.hold.begin();
        self.bench.start(episode)?;
        let [peg, board] = place::apart(episode.rng, &self.args.area, self.args.apart)?;
        let yaw = episode.rng.uniform(-PI, PI)?;
        self.peg.put(episode, peg, yaw);
        let (sine, cosine) = ops::sincos(episode.rng.uniform(-PI, PI)? / 2.0);
        let body = self.board.index();
        episode.scene.overwrite(|m| {
            (m.body_pos[body][0], m.body_pos[body][1]) = (board[0], board[1]);
            m.body_quat[body] = [cosine, 0.0, 0.0, sine];
        })
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.hold.leave(self.stands(&turn.scene.model, &turn.scene.data));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let data = view.data;
        self.bench.observe(view, &self.hold, self.stands(view.model, data), rows);
        let peg = data.body(self.peg.body);
        // Its z axis points at the tip.
        let top = add_scaled(*peg.xpos(), column(peg.xmat(), 2), -GRASP);
        rows.set("peg_error", "m", sub(top, self.bench.tool(data)));
        rows.set("hole_error", "m", self.way(data, self.hole[1]));
        rows.set("peg_axes", "", [2, 0].into_iter().flat_map(|axis| column(peg.xmat(), axis)));
        rows.set("board_axis", "", column(data.body(self.board).xmat(), 0));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let height = rows["tool"][2] + rows["peg_error"][2];
        terms.set("reach", "m", [norm(&rows["peg_error"])]);
        terms.set("place", "m", [norm(&rows["hole_error"])]);
        self.hold.judge(rows["held"][0], rows["holds"][0] > 0.5, height < self.floor, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        Bench::resting(&["board_axis"])
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.hold.keep(keeper);
    }
}
