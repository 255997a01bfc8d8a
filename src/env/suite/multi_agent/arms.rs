//! Two arms with grippers and a load that both can grip, each arm an agent.

use super::part::{Part, team};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::body::is_below;
use crate::task::{Episode, Pose, Setup, View};
use crate::team::{Stakes, Team, prefix};
use physics::elements::{BodyId, JointId, SiteId};
use physics::math::{Vec3, mul_mat_t_vec, sub};
use physics::{Data, Model};
use std::ops::Range;

/// Name of the body that the arms move.
const LOAD: &str = "load";

/// An arm.
#[derive(Clone)]
struct Arm {
    prefix: String,
    root: BodyId,
    tool: SiteId,
    /// Where it grips the load.
    grip: SiteId,
    /// Its joints: places in `qpos` and in `qvel`.
    joints: Vec<(usize, usize)>,
    controls: Vec<usize>,
}

/// Two arms and their load.
#[derive(Clone)]
pub struct Arms {
    arms: [Arm; 2],
    /// The agents.
    pub team: Team,
    /// The body that they move.
    pub load: BodyId,
    /// Where `qpos` has its free joint.
    pub pose: Range<usize>,
    /// Where it is to go.
    pub target: SiteId,
    home: Vec<f64>,
    noise: f64,
}

/// A vector of the world in the frame of a body.
fn within(d: &Data, body: BodyId, vector: Vec3) -> Vec3 {
    mul_mat_t_vec(&d.kin.xmat[body.index()], vector)
}

impl Arm {
    fn new(name: &str, m: &Model, scene: &Scene, cast: &robot::Cast<'_>) -> Result<Self, EnvError> {
        let (prefix, root) = (prefix(name), cast.root()?);
        let mine = |named: &str| named.starts_with(&prefix);
        let joints = m.joint_names().filter(|(_, named)| mine(named));
        let places = |joint: JointId| (m.joint(joint).qpos_range().start, m.joint(joint).dof_range().start);
        let controls = m.actuator_names().filter(|(_, named)| mine(named));
        Ok(Arm {
            root,
            tool: cast.tool()?,
            grip: scene.site(&format!("{prefix}grip"))?,
            joints: joints.map(|(joint, _)| places(joint)).collect(),
            controls: controls.map(|(id, _)| m.actuator_ctrladr[id.index()] as usize).collect(),
            prefix,
        })
    }
}

impl Arms {
    /// Rows that every task observes of an arm, beside where the other is.
    const ROWS: [&str; 7] =
        ["joint_pos", "joint_vel", "tool", "grip_error", "target_error", "hold", "last_action"];

    /// The arms of a task called `task`, both with the roles of the file `roles`. Joints begin up to `noise` \[rad\] beside their
    /// poses at home.
    ///
    /// # Errors
    /// The model does not fill the roles of an arm, or has no actuator of it; it lacks a body `load` with a free joint, a site for an
    /// arm to grip it, or a site `target`.
    pub fn new(
        (roles, noise): (&str, f64),
        task: &str,
        parts: &[Part<'_>; 2],
        setup: &Setup<'_>,
    ) -> Result<Self, EnvError> {
        let (scene, m) = (&*setup.scene, &setup.scene.model);
        let team = team(parts, &Self::ROWS, Stakes::Shared, scene)?;
        let roles = setup.roles(roles)?;
        let mut home = m.qpos0.to_vec();
        let mut arm = |part: &Part<'_>| {
            let prefix = prefix(part.name);
            let cast = roles.cast(m, &prefix, task);
            cast.pose("home", &mut home)?;
            cast.pose("open", &mut home)?;
            Arm::new(part.name, m, scene, &cast)
        };
        let arms = [arm(&parts[0])?, arm(&parts[1])?];
        let (load, pose) = setup.loose_body(LOAD)?;
        Ok(Arms { arms, team, load, pose, target: scene.site("target")?, home, noise })
    }

    /// Arms at home with open grippers as initial pose.
    pub fn initial_pose(&self, pose: &mut Pose) {
        pose.qpos.copy_from_slice(&self.home);
    }

    /// Starts an episode: joints a little off, the load and the target at these places \[m\].
    ///
    /// # Errors
    /// The noise is no range; a place that is no number.
    pub fn start(&self, episode: &mut Episode<'_>, load: [f64; 2], target: [f64; 3]) -> Result<(), EnvError> {
        for (place, _) in self.arms.iter().flat_map(|arm| &arm.joints) {
            episode.start.qpos[*place] += self.noise * episode.rng.uniform(-1.0, 1.0)?;
        }
        episode.start.qpos[self.pose.start..self.pose.start + 2].copy_from_slice(&load);
        episode.scene.overwrite(|m| m.site_pos[self.target.index()] = target)
    }

    /// Whether an arm holds the load: two parts of it touch the load.
    fn holds(&self, view: &View<'_>, arm: &Arm) -> bool {
        let mut parts = self.touching(view).filter(|&body| is_below(view.model, arm.root, body));
        parts.next().is_some_and(|first| parts.any(|body| body != first))
    }

    /// Whether nothing but the arm of a number touches the load.
    pub fn alone(&self, view: &View<'_>, number: usize) -> bool {
        self.touching(view).all(|body| is_below(view.model, self.arms[number].root, body))
    }

    /// Bodies that touch the load, as often as they do.
    fn touching<'v>(&self, view: &'v View<'_>) -> impl Iterator<Item = usize> + 'v {
        let (m, load) = (view.model, self.load.index());
        view.data.contacts().filter_map(move |contact| {
            let [a, b] = contact.geoms().map(|geom| Some(m.geom_bodyid[geom?.index()] as usize));
            match (a?, b?) {
                (a, b) if a == load => Some(b),
                (a, b) if b == load => Some(a),
                _ => None,
            }
        })
    }

    /// Writes the rows of each arm; `more` adds those of the task, in the frame of a body.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows, more: impl Fn(&dyn Fn(Vec3) -> Vec3, &mut Rows)) {
        let (d, state) = (view.data, &view.data.state);
        let site = |site: SiteId| d.kin.site_xpos[site.index()];
        let load = d.kin.xpos[self.load.index()];
        for (k, arm) in self.arms.iter().enumerate() {
            let local = |vector: Vec3| within(d, arm.root, vector);
            let tool = site(arm.tool);
            rows.within(&arm.prefix, |rows| {
                rows.set("joint_pos", "rad, m", arm.joints.iter().map(|&(place, _)| state.qpos[place]));
                rows.set("joint_vel", "rad/s, m/s", arm.joints.iter().map(|&(_, dof)| state.qvel[dof]));
                rows.set("tool", "m", local(sub(tool, d.kin.xpos[arm.root.index()])));
                rows.set("mate_error", "m", local(sub(site(self.arms[1 - k].tool), tool)));
                rows.set("grip_error", "m", local(sub(site(arm.grip), tool)));
                rows.set("target_error", "m", local(sub(site(self.target), load)));
                rows.set("hold", "", [f64::from(self.holds(view, arm))]);
                rows.set("last_action", "", arm.controls.iter().map(|&control| state.ctrl[control]));
                more(&local, rows);
            });
        }
    }

    /// A row of the arm of a number.
    pub fn row<'a>(&'a self, rows: &'a Rows, number: usize, name: &str) -> &'a [f64] {
        rows.of(&self.arms[number].prefix).row(name)
    }

    /// Writes each arm's own terms: how far its tool is from its grip.
    pub fn judge(&self, rows: &Rows, terms: &mut Rows) {
        for (k, arm) in self.arms.iter().enumerate() {
            let far = physics::math::norm(vector(self.row(rows, k, "grip_error")));
            terms.within(&arm.prefix, |terms| terms.set("reach", "m", [-far]));
        }
    }

    /// Rows that random actions may leave as they are: hands that hold nothing.
    pub fn resting_rows(&self) -> Vec<String> {
        self.arms.iter().map(|arm| format!("{}hold", arm.prefix)).collect()
    }
}

/// The first three numbers of a row.
pub fn vector(row: &[f64]) -> Vec3 {
    [row[0], row[1], row[2]]
}
