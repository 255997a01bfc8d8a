//! Wiping marks off a board with a sponge under the hand, without pressing too hard, and lifting it clear of the board.
//!
//! Observation beside that of all tasks: `sponge`, the places of the nodes that carry its elasticity \[m\]; `marks`, where the marks are
//! on the board, two numbers each \[m\]; `wiped`, 1 for each that has been wiped; `nearest`, the way along the board from the middle of
//! the sponge's underside to the nearest mark that has not, 0 when all have \[m\]; `remaining`, their share; `force`, by which the sponge
//! presses on the board \[N\]; `clearance`, the height of its lowest point over the board \[m\]; `held`, for how long all marks have been
//! wiped and the sponge has been clear \[s\]. A mark is wiped in a state in which a point of the sponge touches the board within 10 mm of
//! it and the sponge presses by 4 N or more. Dense reward: minus twice the share remaining, minus the distance to the nearest; one more
//! while all is as wanted, 100 at the end. Sparse reward: 1 while it is. Solved: all marks wiped, and the sponge 20 mm clear of the board
//! for 0.5 s. More than 40 N in any state end the episode, at 20 less. The place of the marks as a whole, their direction, and some
//! millimetres of each are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::GeomId;
use physics::math::{Vec3, ops};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

/// How far below the board marks are that have been wiped \[m\].
const BELOW: f64 = 0.02;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Least force by which the sponge wipes, and the largest that it may press by \[N\].
    force: [f64; 2],
    /// How far from a mark the sponge touches the board at most where it wipes the mark \[m\].
    near: f64,
    /// Height of the sponge over the board at which it is clear \[m\].
    clear: f64,
    /// For how long it is to be clear \[s\].
    hold: f64,
    /// Middle of the marks on the board \[m\], and how they are turned about the vertical from the scene \[rad\].
    places: Ranges<3>,
    /// How far each mark is moved at most, along either axis \[m\].
    jitter: f64,
}

/// The task.
#[derive(Clone)]
pub struct SpongeWipe {
    bench: Bench,
    /// Bodies of the nodes.
    nodes: Vec<usize>,
    /// Vertices of the underside.
    sole: Vec<usize>,
    board: GeomId,
    /// Place of each mark among the mocap bodies, and from the middle of all in the scene \[m\].
    marks: Vec<(usize, [f64; 2])>,
    /// Which marks were wiped up to the state before the present one.
    wiped: Vec<bool>,
    force: [f64; 2],
    near: f64,
    clear: f64,
    places: Ranges<3>,
    jitter: f64,
    done: Hold,
}

impl SpongeWipe {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles, the flex, the board, or mocap bodies whose names begin with `mark` are missing; forces that are no range.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if !(0.0 < args.force[0] && args.force[0] < args.force[1]) {
            return Err(setup.wrong("force: the least is above 0 and below the largest"));
        }
        let (bench, m) = (Bench::new(&args.arm, "wipe a board", setup)?, &setup.scene.model);
        if m.nflex != 1 || m.nflexnode == 0 {
            return Err(setup.wrong("the scene needs one flex that is moved by nodes"));
        }
        let vertices = &setup.scene.data.flex.flexvert_xpos;
        let lowest = vertices.iter().map(|place| place[2]).fold(f64::INFINITY, f64::min);
        let named = m.body_names().filter(|(_, name)| name.starts_with("mark"));
        let mark = |body: usize| Some((usize::try_from(m.body_mocapid[body]).ok()?, m.body_pos[body]));
        let marks: Option<Vec<(usize, Vec3)>> = named.map(|(id, _)| mark(id.index())).collect();
        let marks = marks
            .filter(|marks| !marks.is_empty())
            .ok_or_else(|| setup.wrong("the scene needs mocap bodies named mark…"))?;
        let middle = |i: usize| marks.iter().map(|(_, place)| place[i]).sum::<f64>() / marks.len() as f64;
        let middle = [middle(0), middle(1)];
        Ok(SpongeWipe {
            bench,
            nodes: m.flex_nodebodyid.iter().map(|&body| body as usize).collect(),
            sole: (0..vertices.len()).filter(|&k| vertices[k][2] < lowest + 1e-6).collect(),
            board: setup.scene.geom("board")?,
            wiped: vec![false; marks.len()],
            marks: marks
                .into_iter()
                .map(|(mocap, [x, y, _])| (mocap, [x - middle[0], y - middle[1]]))
                .collect(),
            force: args.force,
            near: args.near,
            clear: args.clear,
            places: args.places,
            jitter: args.jitter,
            done: Hold::new(args.hold),
        })
    }

    /// Places where the sponge touches the board, each with its share of the force that presses it \[m, N\].
    fn touches<'d>(&self, m: &'d Model, data: &'d Data) -> impl Iterator<Item = (Vec3, f64)> + use<'d> {
        let board = self.board;
        let touches = data.contacts().filter(move |contact| {
            contact.touches(board) && contact.parameters().flex.iter().any(|&flex| flex >= 0)
        });
        touches.map(|contact| (*contact.pos(), contact.force(m)[0])).filter(|(_, force)| *force > 0.0)
    }

    /// Force by which the sponge presses on the board \[N\].
    fn pressed(&self, m: &Model, data: &Data) -> f64 {
        self.touches(m, data).map(|(_, force)| force).sum()
    }

    /// Whether a mark has been wiped by now, where the sponge presses by `force`.
    fn is_wiped(&self, mark: usize, force: f64, m: &Model, data: &Data) -> bool {
        let [x, y, _] = data.state.mocap_pos[self.marks[mark].0];
        let is_near = |[at, beside, _]: Vec3| norm(&[at - x, beside - y]) < self.near;
        self.wiped[mark] || (force >= self.force[0] && self.touches(m, data).any(|(place, _)| is_near(place)))
    }

    /// Height of the lowest point of the sponge over the board \[m\].
    fn clearance(&self, data: &Data) -> f64 {
        let heights = self.sole.iter().map(|&vertex| data.flex.flexvert_xpos[vertex][2]);
        heights.fold(f64::INFINITY, f64::min) - data.geom(self.board).xpos()[2]
    }

    /// The way along the board from the middle of the underside to a mark \[m\].
    fn way(&self, mark: usize, data: &Data) -> [f64; 2] {
        let place = data.state.mocap_pos[self.marks[mark].0];
        let each = |i: usize| self.sole.iter().map(|&vertex| data.flex.flexvert_xpos[vertex][i]).sum::<f64>();
        std::array::from_fn(|i| place[i] - each(i) / self.sole.len() as f64)
    }

    fn is_done(&self, remaining: f64, clearance: f64) -> bool {
        remaining == 0.0 && clearance >= self.clear
    }
}

impl Task for SpongeWipe {
    fn defaults(&self) -> Defaults {
        let weights =
            [("remaining", -2.0), ("reach", -1.0), ("held", 1.0), ("bonus", 100.0), ("penalty", -20.0)];
        let rows = [
            "arm_pos",
            "arm_vel",
            "tip",
            "sponge",
            "marks",
            "wiped",
            "nearest",
            "remaining",
            "force",
            "clearance",
            "held",
        ];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, _: &mut Episode<'_>) -> Result<(), EnvError> {
        self.wiped.fill(false);
        self.done.begin();
        Ok(())
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let [x, y, angle] = self.places.draw(episode.rng)?;
        let (sine, cosine) = ops::sincos(angle);
        let height = episode.scene.data.geom(self.board).xpos()[2];
        for &(mocap, [along, across]) in &self.marks {
            let place = &mut episode.scene.data.state.mocap_pos[mocap];
            *place = [x + cosine * along - sine * across, y + sine * along + cosine * across, height];
            for coordinate in &mut place[..2] {
                *coordinate += episode.rng.uniform(-self.jitter, self.jitter)?;
            }
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let Scene { model, data, .. } = &mut *turn.scene;
        let force = self.pressed(model, data);
        for mark in 0..self.marks.len() {
            self.wiped[mark] = self.is_wiped(mark, force, model, data);
        }
        let height = data.geom(self.board).xpos()[2];
        for (&(mocap, _), wiped) in self.marks.iter().zip(&self.wiped) {
            // Pictures show what remains.
            data.state.mocap_pos[mocap][2] = if *wiped { height - BELOW } else { height };
        }
        let all = self.wiped.iter().all(|wiped| *wiped);
        let done = self.is_done(if all { 0.0 } else { 1.0 }, self.clearance(data));
        self.done.leave(done);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (m, data) = (view.model, view.data);
        let force = self.pressed(m, data);
        let wiped = |mark: usize| self.is_wiped(mark, force, m, data);
        let marks = 0..self.marks.len();
        let left = marks.clone().filter(|&mark| !wiped(mark));
        let length = |way: &[f64; 2]| norm(way);
        let ways = left.clone().map(|mark| self.way(mark, data));
        let nearest = ways.min_by(|a, b| length(a).total_cmp(&length(b)));
        let remaining = left.count() as f64 / self.marks.len() as f64;
        let clearance = self.clearance(data);
        self.bench.observe(view, rows);
        rows.set("sponge", "m", self.nodes.iter().flat_map(|&node| data.kin.xpos[node]));
        let places = self.marks.iter().map(|&(mocap, _)| data.state.mocap_pos[mocap]);
        rows.set("marks", "m", places.flat_map(|[x, y, _]| [x, y]));
        rows.set("wiped", "", marks.map(|mark| f64::from(wiped(mark))));
        rows.set("nearest", "m", nearest.unwrap_or([0.0; 2]));
        rows.set("remaining", "", [remaining]);
        rows.set("force", "N", [force]);
        rows.set("clearance", "m", [clearance]);
        rows.set("held", "s", [self.done.seconds(self.is_done(remaining, clearance), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let remaining = rows["remaining"][0];
        terms.set("remaining", "", [remaining]);
        terms.set("reach", "m", [norm(&rows["nearest"])]);
        let (done, lost) = (self.is_done(remaining, rows["clearance"][0]), rows["force"][0] > self.force[1]);
        self.done.judge(rows["held"][0], done, lost, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["wiped", "remaining", "force", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        for wiped in &mut self.wiped {
            keeper.flag(wiped);
        }
        self.done.keep(keeper);
    }
}
