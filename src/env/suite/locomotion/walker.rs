//! A body with feet, by its roles: how an episode of it starts, what all its tasks observe, and when it has fallen.

use super::FRAME_SKIP;
use super::push::Push;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::suite::body::{Bend, joints_below};
use crate::task::{Defaults, Episode, Pose, Setup, Success, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{Mat3, Vec3, cross, mul_mat_t_vec, mul_mat_vec, ops};
use physics::position::frame::Frame;
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

/// A body with feet.
#[derive(Clone)]
pub struct Walker {
    root: BodyId,
    feet: Vec<SiteId>,
    forward: Vec3,
    up: Vec3,
    bends: Vec<Bend>,
    stand: Vec<f64>,
    /// Height of the root over the feet when it stands \[m\].
    pub height: f64,
    ahead: [f64; 2],
    fallen: Fallen,
    /// How fast it walks.
    pub walk: Walk,
    noise: f64,
    push: Option<Push>,
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct Posture {
    /// Position of the root \[m\].
    pub place: Vec3,
    /// Height of the root over its lowest foot \[m\].
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
    const ROWS: [&str; 8] =
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
        let (roles, m) = (setup.roles(path)?, &setup.scene.model);
        let body = roles.cast(m, "", task);
        let mut walker = Walker {
            root: body.root()?,
            feet: body.feet()?,
            forward: body.forward(),
            up: body.up(),
            bends: joints_below(m, body.root()?),
            stand: m.qpos0.to_vec(),
            height: 0.0,
            ahead: [1.0, 0.0],
            fallen: body.fallen()?,
            walk: body.walk()?,
            noise: disturbance.joint_noise,
            push: disturbance.push,
        };
        body.pose("stand", &mut walker.stand)?;
        let mut standing = Data::new(m);
        standing.state.qpos.copy_from_slice(&walker.stand);
        physics::forward(m, &mut standing)?;
        let posture = walker.posture(m, &standing);
        (walker.height, walker.ahead) = (posture.height, posture.ahead);
        Ok(walker)
    }

    /// Direction that the body looks in at the start, in the plane of the ground, of length 1.
    pub fn ahead_at_start(&self) -> [f64; 2] {
        self.ahead
    }

    /// Mass of the body \[kg\].
    pub fn mass(&self, m: &Model) -> f64 {
        m.body_subtreemass[m.body_rootid[self.root.index()] as usize]
    }

    /// The standing pose as initial one.
    pub fn initial_pose(&self, pose: &mut Pose) {
        pose.qpos.copy_from_slice(&self.stand);
    }

    /// Starts an episode: the standing pose, joints a little off.
    ///
    /// # Errors
    /// The noise is no range.
    pub fn start(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for joint in &self.bends {
            episode.start.qpos[joint.position] += self.noise * episode.rng.uniform(-1.0, 1.0)?;
        }
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
        let lowest =
            self.feet.iter().map(|foot| d.kin.site_xpos[foot.index()][2]).fold(f64::INFINITY, f64::min);
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
            height: place[2] - lowest,
            ahead,
            up: [part(self.forward), part(left), part(self.up)],
            velocity: mul_mat_t_vec(&frame, [u, v, w]),
            turning: mul_mat_t_vec(&frame, [x, y, z]),
        }
    }

    /// Writes the terms of the reward that every task has: how upright the body is, whether the task is solved, whether the body has
    /// fallen, which ends the episode.
    pub fn judge(&self, solved: bool, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (height, up) = (rows["height"][0], rows["up"][2]);
        let fallen = height < self.fallen.height || up < ops::cos(self.fallen.tilt);
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
        rows.set("last_action", "", state.ctrl.iter().copied());
        posture
    }

    /// Writes, or reads, what the body remembers from step to step.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        if let Some(push) = &mut self.push {
            push.keep(keeper);
        }
    }
}
