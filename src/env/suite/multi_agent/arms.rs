//! Two arms with grippers and a load that both can grip, each arm an agent.

use super::limb::Limb;
use super::part::{Part, team};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Episode, Pose, Setup, View};
use crate::team::{Stakes, Team, prefix};
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, sub};
use std::ops::Range;

/// Name of the body that the arms move.
const LOAD: &str = "load";

/// An arm.
#[derive(Clone)]
struct Arm {
    limb: Limb,
    tool: SiteId,
    /// Where it grips the load.
    grip: SiteId,
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
            let grip = scene.site(&format!("{prefix}grip"))?;
            Ok::<_, EnvError>(Arm { limb: Limb::new(part.name, cast.root()?, m), tool: cast.tool()?, grip })
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
        for joint in self.arms.iter().flat_map(|arm| &arm.limb.joints) {
            episode.start.qpos[joint.position] += self.noise * episode.rng.uniform(-1.0, 1.0)?;
        }
        episode.start.qpos[self.pose.start..self.pose.start + 2].copy_from_slice(&load);
        episode.scene.overwrite(|m| m.site_pos[self.target.index()] = target)
    }

    /// Whether an arm holds the load: two parts of it touch the load.
    fn holds(&self, view: &View<'_>, arm: &Arm) -> bool {
        let mut parts = arm.limb.touching(view, self.load);
        parts.next().is_some_and(|first| parts.any(|body| body != first))
    }

    /// Whether nothing but the arm of a number touches the load.
    pub fn alone(&self, view: &View<'_>, number: usize) -> bool {
        self.arms[number].limb.alone(view.model, view.data, self.load)
    }

    /// Writes the rows of each arm; `more` adds those of the task, in the frame of a body.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows, more: impl Fn(&dyn Fn(Vec3) -> Vec3, &mut Rows)) {
        let d = view.data;
        let site = |site: SiteId| d.kin.site_xpos[site.index()];
        let load = d.kin.xpos[self.load.index()];
        for (k, arm) in self.arms.iter().enumerate() {
            let local = |vector: Vec3| arm.limb.local(d, vector);
            let tool = site(arm.tool);
            rows.within(&arm.limb.prefix, |rows| {
                arm.limb.observe(d, rows);
                rows.set("tool", "m", local(sub(tool, d.kin.xpos[arm.limb.root.index()])));
                rows.set("mate_error", "m", local(sub(site(self.arms[1 - k].tool), tool)));
                rows.set("grip_error", "m", local(sub(site(arm.grip), tool)));
                rows.set("target_error", "m", local(sub(site(self.target), load)));
                rows.set("hold", "", [f64::from(self.holds(view, arm))]);
                more(&local, rows);
            });
        }
    }

    /// A row of the arm of a number.
    pub fn row<'a>(&'a self, rows: &'a Rows, number: usize, name: &str) -> &'a [f64] {
        rows.of(&self.arms[number].limb.prefix).row(name)
    }

    /// Writes each arm's own terms: how far its tool is from its grip.
    pub fn judge(&self, rows: &Rows, terms: &mut Rows) {
        for (k, arm) in self.arms.iter().enumerate() {
            let far = physics::math::norm(vector(self.row(rows, k, "grip_error")));
            terms.within(&arm.limb.prefix, |terms| terms.set("reach", "m", [-far]));
        }
    }

    /// Rows that random actions may leave as they are: hands that hold nothing.
    pub fn resting_rows(&self) -> Vec<String> {
        self.arms.iter().map(|arm| format!("{}hold", arm.limb.prefix)).collect()
    }
}

/// The first three numbers of a row.
pub fn vector(row: &[f64]) -> Vec3 {
    [row[0], row[1], row[2]]
}
