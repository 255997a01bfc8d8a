//! The arm of a table-top task, by its roles, and the loose things before it.

use super::FRAME_SKIP;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::suite::body::{Bend, is_below, joints_below};
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, column, ops};
use physics::model::JointType;
use physics::position::frame::Frame;
use physics::{Data, Model};

/// How an episode begins for the arm.
#[derive(Clone, Copy)]
pub struct Start<'a> {
    /// File with the roles of the robot.
    pub roles: &'a str,
    /// The pose of the roles in which it starts; `home` if none is named.
    pub pose: Option<&'a str>,
    /// Largest difference of a joint from that pose \[rad\].
    pub noise: f64,
}

/// The arm of a task.
#[derive(Clone)]
pub struct Bench {
    tool: SiteId,
    bends: Vec<Bend>,
    /// Places of hinges that are no fingers'.
    hinges: Vec<usize>,
    /// Places of the fingers' joints, and where they are when closed and open.
    fingers: Vec<(usize, [f64; 2])>,
    home: Vec<f64>,
    /// Of each geom, whether it is the arm's.
    own: Vec<bool>,
    /// Largest difference of a joint from the home pose at the start \[rad\].
    noise: f64,
}

impl Bench {
    const ROWS: [&str; 8] =
        ["joint_pos", "joint_vel", "tool", "tool_axes", "opening", "holds", "held", "last_action"];

    /// Defaults of a task that observes `own` rows beside those of all.
    pub fn defaults(own: &[&str], weights: &[(&str, f64)]) -> Defaults {
        let rows = [&Self::ROWS[..], own].concat();
        let ending = [("held", 1.0), ("bonus", 100.0), ("penalty", -20.0)];
        let defaults = Defaults::new(&rows, &[weights, &ending].concat(), FRAME_SKIP);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["joint_pos", "joint_vel"])
    }

    /// Rows that random actions may leave as they are: those of all tasks, and `own` ones.
    pub fn resting(own: &[&str]) -> Vec<String> {
        ["holds", "held"].iter().chain(own).map(ToString::to_string).collect()
    }

    /// Finds the arm in the model, for the task called `task`.
    ///
    /// # Errors
    /// The roles cannot be read, or the model does not fill them.
    pub fn new(task: &str, start: Start<'_>, setup: &Setup<'_>) -> Result<Self, EnvError> {
        let roles = setup.roles(start.roles)?;
        let m = &setup.scene.model;
        let body = roles.cast(m, "", task);
        let root = body.root()?;
        let (mut home, mut closed) = (m.qpos0.to_vec(), m.qpos0.to_vec());
        body.pose(start.pose.unwrap_or("home"), &mut home)?;
        body.pose("closed", &mut closed)?;
        body.pose("open", &mut home)?;
        let fingers = roles.poses.get("open").into_iter().flat_map(|pose| pose.joints.keys());
        let places =
            fingers.filter_map(|name| m.joint(name)).map(|joint| m.jnt_qposadr[joint.index()] as usize);
        let fingers: Vec<(usize, [f64; 2])> =
            places.map(|place| (place, [closed[place], home[place]])).collect();
        let hinge = |joint: &usize| m.jnt_type[*joint] == JointType::Hinge as i32;
        let below = (0..m.njnt).filter(|&joint| is_below(m, root, m.jnt_bodyid[joint] as usize));
        let hinges = below.filter(hinge).map(|joint| m.jnt_qposadr[joint] as usize);
        Ok(Bench {
            hinges: hinges.filter(|place| !fingers.iter().any(|(finger, _)| finger == place)).collect(),
            tool: body.tool()?,
            bends: joints_below(m, root),
            fingers,
            home,
            own: (0..m.ngeom).map(|geom| is_below(m, root, m.geom_bodyid[geom] as usize)).collect(),
            noise: start.noise,
        })
    }

    /// The home pose as initial one.
    pub fn initial_pose(&self, pose: &mut Pose) {
        pose.qpos.copy_from_slice(&self.home);
    }

    /// Starts an episode: the home pose, joints of the arm a little off.
    ///
    /// # Errors
    /// The noise is no range.
    pub fn start(&self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for place in &self.hinges {
            episode.start.qpos[*place] += self.noise * episode.rng.uniform(-1.0, 1.0)?;
        }
        Ok(())
    }

    /// How far the gripper is open, 0 to 1.
    pub fn opening(&self, data: &Data) -> f64 {
        let each = self.fingers.iter();
        let sum: f64 =
            each.map(|(place, [closed, open])| (data.state.qpos[*place] - closed) / (open - closed)).sum();
        sum / self.fingers.len().max(1) as f64
    }

    /// Where the tool is \[m\].
    pub fn tool(&self, data: &Data) -> Vec3 {
        *data.site(self.tool).xpos()
    }

    /// Whether the arm touches something that is not the arm.
    pub fn touches(&self, data: &Data) -> bool {
        let owned = |geom: i32| usize::try_from(geom).is_ok_and(|geom| self.own[geom]);
        data.con.contact.iter().any(|contact| {
            let [first, second] = contact.geom.map(owned);
            contact.dist < 0.0 && first != second
        })
    }

    /// Writes the rows that every task observes.
    pub fn observe(&self, view: &View<'_>, hold: &Hold, holds: bool, rows: &mut Rows) {
        let (data, state) = (view.data, &view.data.state);
        let axes = data.site(self.tool).xmat();
        rows.set("joint_pos", "rad, m", self.bends.iter().map(|joint| state.qpos[joint.position]));
        rows.set("joint_vel", "rad/s, m/s", self.bends.iter().map(|joint| state.qvel[joint.velocity]));
        rows.set("tool", "m", self.tool(data));
        rows.set("tool_axes", "", [2, 1].into_iter().flat_map(|axis| column(axes, axis)));
        rows.set("opening", "", [self.opening(data)]);
        rows.set("holds", "", [f64::from(holds)]);
        rows.set("held", "s", [hold.seconds(holds, view.dt)]);
        rows.set("last_action", "", state.ctrl.iter().copied());
    }
}

/// A thing on a free joint.
#[derive(Clone, Copy, Debug)]
pub struct Loose {
    /// Its body.
    pub body: BodyId,
    place: usize,
}

impl Loose {
    /// The body of this name.
    ///
    /// # Errors
    /// There is none, or it has no free joint.
    pub fn new(name: &str, setup: &Setup<'_>) -> Result<Self, EnvError> {
        let (body, pose) = setup.loose_body(name)?;
        Ok(Loose { body, place: pose.start })
    }

    /// Puts it at a place of the table \[m\], turned about the vertical \[rad\]. Its height and what else turns it stay those of the model.
    pub fn put(&self, episode: &mut Episode<'_>, [x, y]: [f64; 2], yaw: f64) {
        let own: [f64; 4] = std::array::from_fn(|k| episode.scene.model.qpos0[self.place + 3 + k]);
        let (sine, cosine) = ops::sincos(yaw / 2.0);
        let turn = physics::math::quat_mul([cosine, 0.0, 0.0, sine], own);
        let pose = &mut episode.start.qpos[self.place..self.place + 7];
        pose[..2].copy_from_slice(&[x, y]);
        pose[3..].copy_from_slice(&turn);
    }

    /// Speed of its origin \[m/s\].
    pub fn speed(&self, m: &Model, d: &Data) -> f64 {
        let body = self.body.index();
        let frame = Frame { body, pos: d.kin.xpos[body], mat: d.kin.xmat[body] };
        physics::math::norm(physics::math::linear(&frame.velocity(m, &d.com, &d.vel.cvel)))
    }
}
