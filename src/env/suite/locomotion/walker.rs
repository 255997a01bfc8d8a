//! A body with feet, or one that swims, by its roles: how an episode of it starts, what all its tasks observe, and when it has fallen.

use super::FRAME_SKIP;
use super::push::Push;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::suite::body::{Bend, is_below, joints_below};
use crate::suite::coupling::{Coupling, follow};
use crate::task::{Defaults, Episode, Pose, Setup, Success, Turn, Verdict, View};
use physics::elements::{BodyId, JointId, SiteId};
use physics::math::{Mat3, Vec3, cross, distance, mul_mat_t_vec, mul_mat_vec, ops, quat_mul};
use physics::model::{JointType, ObjType};
use physics::position::frame::Frame;
use physics::position::kinematics::kinematics;
use physics::{Data, Model};
use robot::{Fallen, Keeper, Walk};
use serde::Deserialize;

/// What makes episodes differ.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disturbance {
    /// Largest difference of a joint from the standing pose at the start \[rad or m\].
    #[serde(default)]
    joint_noise: f64,
    /// Pushes during the episode.
    #[serde(default)]
    push: Option<Push>,
}

/// Share of an axis along the vertical below which it is level, and by which it may miss it.
const LEVEL: f64 = 1e-6;

/// What moves the root in the world.
#[derive(Clone, Copy, Debug)]
enum Carrier {
    /// A free joint, with its place in `qpos`.
    Free(usize),
    /// A slide along, or a hinge about, an axis (world frame): its place in `qpos`, and where it is at 0.
    Along {
        place: usize,
        axis: Vec3,
        zero: Vec3,
    },
    About {
        place: usize,
        axis: Vec3,
    },
}

/// A body with feet, or one that swims and has none.
#[derive(Clone)]
pub struct Walker {
    /// What names of its elements, rows and terms begin with.
    prefix: String,
    root: BodyId,
    feet: Vec<SiteId>,
    forward: Vec3,
    up: Vec3,
    bends: Vec<Bend>,
    couplings: Vec<Coupling>,
    carriers: Vec<Carrier>,
    /// Controls of the body.
    controls: Vec<usize>,
    stand: Vec<f64>,
    /// Height of the root over the feet when it stands; of a body that swims, a quarter of its length behind the root \[m\].
    pub height: f64,
    ahead: [f64; 2],
    /// When it has fallen; what swims does not.
    fallen: Option<Fallen>,
    /// How fast it walks or swims.
    pub walk: Walk,
    noise: f64,
    push: Option<Push>,
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct Posture {
    /// Position of the root \[m\].
    pub place: Vec3,
    /// Height of the root over its lowest foot, 0 for a body without feet \[m\].
    pub height: f64,
    /// Direction that it looks in, in the plane of the ground, of length 1.
    pub ahead: [f64; 2],
    /// The world's vertical in the frame of the root: forward, left, up.
    pub up: Vec3,
    /// Velocity in the frame of its heading: forward, left, up \[m/s\].
    pub velocity: Vec3,
    /// Angular velocity in the same frame \[rad/s\].
    pub turning: Vec3,
}

impl Posture {
    /// Where a point is in the frame of the heading: forward, left \[m\].
    pub fn towards(&self, point: &Vec3) -> [f64; 2] {
        let [x, y] = [point[0] - self.place[0], point[1] - self.place[1]];
        let [c, s] = self.ahead;
        [c * x + s * y, c * y - s * x]
    }
}

impl Walker {
    /// Rows that every task observes.
    pub const ROWS: [&str; 8] =
        ["height", "up", "velocity", "turning", "joint_pos", "joint_vel", "feet", "last_action"];

    /// Defaults of a task that observes `own` rows beside those of all, and succeeds if it is solved in more than `steps` steps.
    pub fn defaults(own: &[&str], weights: &[(&str, f64)], steps: usize) -> Defaults {
        let rows = [&Self::ROWS[..], own].concat();
        let defaults = Defaults::new(&rows, weights, FRAME_SKIP).proprio(&["joint_pos", "joint_vel"]);
        Defaults { success: Success::MoreThan(steps), ..defaults }
    }

    /// Finds the body whose roles the file `path` has in the model, for the task called `task`.
    ///
    /// # Errors
    /// The roles cannot be read, or the model does not fill them.
    pub fn new(
        path: &str,
        task: &str,
        disturbance: Disturbance,
        setup: &Setup<'_>,
    ) -> Result<Self, EnvError> {
        Self::among_others("", path, task, disturbance, setup)
    }

    /// The same of a body among others: the names of its elements begin with `prefix`, and those of its rows and terms are to be
    /// written within it ([`Rows::within`]).
    ///
    /// # Errors
    /// As [`Walker::new`].
    pub fn among_others(
        prefix: &str,
        path: &str,
        task: &str,
        disturbance: Disturbance,
        setup: &Setup<'_>,
    ) -> Result<Self, EnvError> {
        let (roles, m) = (setup.roles(path)?, &setup.scene.model);
        let body = roles.cast(m, prefix, task);
        let (feet, fallen, walk) = match body.swim() {
            Some(swim) => (Vec::new(), None, swim),
            None => (body.feet()?, Some(body.fallen()?), body.walk()?),
        };
        let mut walker = Walker {
            prefix: prefix.into(),
            root: body.root()?,
            feet,
            forward: body.forward(),
            up: body.up(),
            bends: joints_below(m, body.root()?),
            couplings: Coupling::all(m),
            carriers: carriers(m, body.root()?),
            controls: controls(m, prefix),
            stand: m.qpos0.to_vec(),
            height: 0.0,
            ahead: [1.0, 0.0],
            fallen,
            walk,
            noise: disturbance.joint_noise,
            push: disturbance.push,
        };
        if body.swim().is_none() {
            body.pose("stand", &mut walker.stand)?;
        }
        follow(&walker.couplings, &mut walker.stand);
        let mut standing = Data::new(m);
        standing.state.qpos.copy_from_slice(&walker.stand);
        physics::forward(m, &mut standing)?;
        let posture = walker.posture(m, &standing);
        walker.ahead = posture.ahead;
        walker.height = if walker.feet.is_empty() { walker.tail(m, &standing) / 4.0 } else { posture.height };
        Ok(walker)
    }

    /// Distance from the root to the body below it that is farthest away \[m\].
    fn tail(&self, m: &Model, d: &Data) -> f64 {
        let below = m.bodies().filter(|&body| is_below(m, self.root, body.index()));
        below
            .map(|body| distance(d.kin.xpos[body.index()], d.kin.xpos[self.root.index()]))
            .fold(0.0, f64::max)
    }

    /// Direction that the body looks in at the start, in the plane of the ground, of length 1.
    pub fn ahead_at_start(&self) -> [f64; 2] {
        self.ahead
    }

    /// Mass of the body \[kg\].
    pub fn mass(&self, m: &Model) -> f64 {
        m.body_subtreemass[m.body_rootid[self.root.index()] as usize]
    }

    /// The standing pose as initial one; what is not of the body stays as it is.
    pub fn initial_pose(&self, m: &Model, pose: &mut Pose) {
        let top = m.body_rootid[self.root.index()];
        for joint in m.joints().filter(|joint| m.body_rootid[m.jnt_bodyid[joint.index()] as usize] == top) {
            let range = m.joint(joint).qpos_range();
            pose.qpos[range.clone()].copy_from_slice(&self.stand[range]);
        }
    }

    /// Puts the body at a place on the ground \[m\], turned counterclockwise by `yaw` \[rad\] from where the model has it look.
    pub fn put(&self, start: &mut Pose, [x, y]: [f64; 2], yaw: f64) {
        let (s, c) = ops::sincos(yaw / 2.0);
        for carrier in &self.carriers {
            match *carrier {
                Carrier::Free(place) => {
                    start.qpos[place..place + 2].copy_from_slice(&[x, y]);
                    let before = [3, 4, 5, 6].map(|k| self.stand[place + k]);
                    start.qpos[place + 3..place + 7].copy_from_slice(&quat_mul([c, 0.0, 0.0, s], before));
                }
                Carrier::Along { place, axis, zero } => {
                    start.qpos[place] = axis[0] * (x - zero[0]) + axis[1] * (y - zero[1]);
                }
                Carrier::About { place, axis } => start.qpos[place] = axis[2] * yaw,
            }
        }
    }

    /// Whether the body touches `other` body, or what hangs on it.
    pub fn touches(&self, view: &View<'_>, other: BodyId) -> bool {
        let m = view.model;
        let tops = [self.root, other].map(|body| m.body_rootid[body.index()]);
        view.data.contacts().any(|contact| {
            let [a, b] = contact
                .geoms()
                .map(|geom| geom.map(|geom| m.body_rootid[m.geom_bodyid[geom.index()] as usize]));
            [[a, b], [b, a]].contains(&tops.map(Some))
        })
    }

    /// The body that is its root.
    pub fn root(&self) -> BodyId {
        self.root
    }

    /// What the names of its elements, rows and terms begin with.
    pub fn prefix(&self) -> &str {
        &self.prefix
    }

    /// Starts an episode: the standing pose, joints a little off.
    ///
    /// # Errors
    /// The noise is no range.
    pub fn start(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for joint in &self.bends {
            episode.start.qpos[joint.position] += self.noise * episode.rng.uniform(-1.0, 1.0)?;
        }
        follow(&self.couplings, &mut episode.start.qpos);
        if let Some(push) = &mut self.push {
            push.restart();
        }
        Ok(())
    }

    /// Pushes the body, where the settings ask for it.
    ///
    /// # Errors
    /// The push has no range.
    pub fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        match &mut self.push {
            Some(push) => push.act(self.root, self.walk.speed, turn),
            None => Ok(()),
        }
    }

    /// Where the body is and how it moves.
    pub fn posture(&self, m: &Model, d: &Data) -> Posture {
        let root = self.root.index();
        let (place, axes) = (d.kin.xpos[root], d.kin.xmat[root]);
        let lowest = self.feet.iter().map(|foot| d.kin.site_xpos[foot.index()][2]).reduce(f64::min);
        let forward = mul_mat_vec(&axes, self.forward);
        let along = norm(&forward[..2]).max(f64::MIN_POSITIVE);
        let ahead = [forward[0] / along, forward[1] / along];
        let frame: Mat3 = [ahead[0], -ahead[1], 0.0, ahead[1], ahead[0], 0.0, 0.0, 0.0, 1.0];
        let moving = Frame { body: root, pos: place, mat: axes };
        let [x, y, z, u, v, w] = moving.velocity(m, &d.com, &d.vel.cvel);
        let vertical = mul_mat_t_vec(&axes, [0.0, 0.0, 1.0]);
        let left = cross(self.up, self.forward);
        let part = |axis: Vec3| (0..3).map(|i| axis[i] * vertical[i]).sum::<f64>();
        Posture {
            place,
            height: place[2] - lowest.unwrap_or(place[2]),
            ahead,
            up: [part(self.forward), part(left), part(self.up)],
            velocity: mul_mat_t_vec(&frame, [u, v, w]),
            turning: mul_mat_t_vec(&frame, [x, y, z]),
        }
    }

    /// Writes the terms of the reward that every task has: how upright the body is, whether the task is solved, whether the body has
    /// fallen, which ends the episode.
    pub fn judge(&self, solved: bool, rows: &Rows, terms: &mut Rows) -> Verdict {
        let own = rows.of(&self.prefix);
        let (height, up) = (own["height"][0], own["up"][2]);
        let fallen = self.fallen.is_some_and(|fallen| height < fallen.height || up < ops::cos(fallen.tilt));
        terms.set("upright", "", [up]);
        terms.set("bonus", "", [f64::from(solved)]);
        terms.set("fallen", "", [-f64::from(fallen)]);
        Verdict { sparse: f64::from(solved), solved, done: fallen }
    }

    /// Writes the rows that every task observes, and returns the posture.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) -> Posture {
        let (d, state) = (view.data, &view.data.state);
        let posture = self.posture(view.model, d);
        rows.set("height", "m", [posture.height]);
        rows.set("up", "", posture.up);
        rows.set("velocity", "m/s", posture.velocity);
        rows.set("turning", "rad/s", posture.turning);
        rows.set("joint_pos", "rad", self.bends.iter().map(|joint| state.qpos[joint.position]));
        rows.set("joint_vel", "rad/s", self.bends.iter().map(|joint| state.qvel[joint.velocity]));
        let foot = |site: &SiteId| {
            let place = d.kin.site_xpos[site.index()];
            let [ahead, left] = posture.towards(&place);
            [ahead, left, place[2] - posture.place[2]]
        };
        rows.set("feet", "m", self.feet.iter().flat_map(foot));
        rows.set("last_action", "", self.controls.iter().map(|&control| state.ctrl[control]));
        posture
    }

    /// Writes, or reads, what the body remembers from step to step.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        if let Some(push) = &mut self.push {
            push.keep(keeper);
        }
    }
}

/// Controls of the actuators whose names begin with a prefix.
fn controls(m: &Model, prefix: &str) -> Vec<usize> {
    let own = |&actuator: &usize| m.name_of(ObjType::Actuator, actuator).starts_with(prefix);
    (0..m.nactuator).filter(own).map(|actuator| m.actuator_ctrladr[actuator] as usize).collect()
}

/// Joints that move the root over the ground and about the vertical: of the root, and of the bodies above it.
fn carriers(m: &Model, root: BodyId) -> Vec<Carrier> {
    let mut standing = Data::new(m);
    standing.state.qpos.copy_from_slice(&m.qpos0);
    kinematics(m, &standing.state, &mut standing.kin);
    let above = std::iter::successors(Some(root.index()), |&body| Some(m.body_parentid[body] as usize));
    let above: Vec<usize> = above.take_while(|&body| body > 0).collect();
    let carrier = |joint: JointId| {
        let (place, id) = (m.joint(joint).qpos_range().start, joint.index());
        let (kind, axis, body) = (m.jnt_type[id], standing.kin.xaxis[id], m.jnt_bodyid[id] as usize);
        if !above.contains(&body) {
            None
        } else if kind == JointType::Free as i32 {
            Some(Carrier::Free(place))
        } else if kind == JointType::Slide as i32 && axis[2].abs() < LEVEL {
            Some(Carrier::Along { place, axis, zero: m.body_pos[body] })
        } else if kind == JointType::Hinge as i32 && axis[2].abs() > 1.0 - LEVEL {
            Some(Carrier::About { place, axis })
        } else {
            None
        }
    };
    m.joints().filter_map(carrier).collect()
}
