//! Insertion: a thing with a tip is to be in the hole of a seat: a square peg upright in a board, or a plug with two prongs in a socket
//! that faces the arm (Gu et al., "ManiSkill2", 2023, has a peg and a hole that lie, and a charger with its receptacle).
//!
//! Observation: what all tasks of the suite observe; offsets of the part that is to be grasped from the tool and of the bottom of the
//! hole from the tip \[m\], z and x axes of the thing, and the x axis of the bottom. Solved: the tip is within `within` \[m, rad\] of the
//! bottom, the thing is at rest, and, where it is to be `released`, the arm touches nothing, for 0.5 s. A thing that falls off the table
//! ends the episode. Thing and seat start anywhere in their areas, turned by angles within `turns`. `clearance` is by how much the hole
//! is wider than what goes into it.

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
use physics::math::{Vec3, add_scaled, column, dot, ops, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

/// By how much holes are wider than what goes into them in the models \[m\].
const DRAWN: f64 = 0.001;

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
    /// Bodies of thing and seat. The thing's z axis ends in its tip, the site `peg_tip` of a `peg`; the bottom of the hole is the site
    /// `board_bottom` of a `board`, and its z axis points out of the hole.
    bodies: [String; 2],
    /// The geoms of the thing that go into the hole, by their numbers in it. Their z axes are the thing's.
    shafts: Vec<usize>,
    /// Where the thing is to be grasped, along its z axis \[m\].
    grip: f64,
    /// Where the thing and where the seat starts.
    areas: [Area; 2],
    /// By how much they are turned at most \[rad\].
    turns: [f64; 2],
    /// Least distance between them at the start \[m\].
    apart: f64,
    /// By how much the hole is wider than what goes into it \[m\].
    clearance: f64,
    /// How far the tip may be from the bottom \[m\], and its direction from that of the hole \[rad\].
    within: [f64; 2],
    /// Whether the arm is to let go.
    released: bool,
}

/// The task.
#[derive(Clone)]
pub struct Insert {
    bench: Bench,
    thing: Loose,
    seat: BodyId,
    tip: SiteId,
    bottom: SiteId,
    floor: f64,
    args: Args,
    hold: Hold,
}

impl Insert {
    /// The task with these settings. What goes into the hole gets its width.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no such thing and seat; a clearance that leaves nothing to go in; no place for both.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let start = Start { roles: &args.roles, pose: args.pose.as_deref(), noise: args.joint_noise };
        let bench = Bench::new("insert", start, setup)?;
        let [thing, seat] = &args.bodies;
        let site = |name: String| setup.scene.site(&name);
        let (tip, bottom) = (site(format!("{thing}_tip"))?, site(format!("{seat}_bottom"))?);
        let (thing, seat) = (Loose::new(thing, setup)?, setup.scene.body(seat)?);
        let [first, second] = &args.areas;
        if !place::fits([first, second], args.apart) {
            return Err(setup.wrong("apart is more than the areas are wide"));
        }
        let geoms: Vec<usize> = setup.scene.model.body(thing.body).geoms().map(|geom| geom.index()).collect();
        let more = (DRAWN - args.clearance) / 2.0;
        for number in &args.shafts {
            let geom = geoms.get(*number).ok_or_else(|| {
                setup.wrong(format!("shafts has {number}, but {} has {} geoms", args.bodies[0], geoms.len()))
            })?;
            let [x, y, _] = setup.scene.model.geom_size[*geom];
            if args.clearance.is_nan() || args.clearance < 0.0 || x.min(y) + more <= 0.0 {
                let most = DRAWN + 2.0 * x.min(y);
                return Err(setup.wrong(format!("clearance is {}, not 0 to {most} m", args.clearance)));
            }
            setup
                .scene
                .model
                .edit(|m| m.geom_size[*geom].iter_mut().take(2).for_each(|half| *half += more))?;
        }
        let floor = setup.scene.data.body(thing.body).xpos()[2] - 0.2;
        Ok(Insert { bench, thing, seat, tip, bottom, floor, args, hold: Hold::new(HOLD) })
    }

    /// The way from the tip to the bottom of the hole \[m\].
    fn way(&self, data: &Data) -> Vec3 {
        sub(*data.site(self.bottom).xpos(), *data.site(self.tip).xpos())
    }

    fn is_in(&self, m: &Model, data: &Data) -> bool {
        let [far, angle] = self.args.within;
        let (own, out) =
            (column(data.body(self.thing.body).xmat(), 2), column(data.site(self.bottom).xmat(), 2));
        norm(&self.way(data)) < far
            && -dot(own, out) > ops::cos(angle)
            && self.thing.speed(m, data) < REST
            && !(self.args.released && self.bench.touches(data))
    }
}

impl Task for Insert {
    fn defaults(&self) -> Defaults {
        let own = ["grip_error", "hole_error", "thing_axes", "hole_axis"];
        Bench::defaults(&own, &[("reach", -1.0), ("place", -2.0)])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.hold.begin();
        self.bench.start(episode)?;
        let [first, second] = &self.args.areas;
        let [here, there] = place::apart(episode.rng, [first, second], self.args.apart)?;
        let [own, seat] = self.args.turns;
        let yaw = episode.rng.uniform(-own, own)?;
        self.thing.put(episode, here, yaw);
        let (sine, cosine) = ops::sincos(episode.rng.uniform(-seat, seat)? / 2.0);
        let body = self.seat.index();
        episode.scene.overwrite(|m| {
            (m.body_pos[body][0], m.body_pos[body][1]) = (there[0], there[1]);
            m.body_quat[body] = [cosine, 0.0, 0.0, sine];
        })
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.hold.leave(self.is_in(&turn.scene.model, &turn.scene.data));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let data = view.data;
        self.bench.observe(view, &self.hold, self.is_in(view.model, data), rows);
        let thing = data.body(self.thing.body);
        let grip = add_scaled(*thing.xpos(), column(thing.xmat(), 2), self.args.grip);
        rows.set("grip_error", "m", sub(grip, self.bench.tool(data)));
        rows.set("hole_error", "m", self.way(data));
        rows.set("thing_axes", "", [2, 0].into_iter().flat_map(|axis| column(thing.xmat(), axis)));
        rows.set("hole_axis", "", column(data.site(self.bottom).xmat(), 0));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let height = rows["tool"][2] + rows["grip_error"][2];
        terms.set("reach", "m", [norm(&rows["grip_error"])]);
        terms.set("place", "m", [norm(&rows["hole_error"])]);
        self.hold.judge(rows["held"][0], rows["holds"][0] > 0.5, height < self.floor, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        Bench::resting(&["hole_axis"])
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.hold.keep(keeper);
    }
}
