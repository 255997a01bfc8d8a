//! Bringing an object to a target: what is observed and rewarded, however the object and the target were placed.

use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::spec::Spec;
use crate::suite::bonus::bonus;
use crate::task::{Defaults, Verdict, View};
use physics::elements::SiteId;
use physics::math::sub;
use robot::Compat;

/// Beyond this distance \[m\] of hand and object the episode ends.
const FAR: f64 = 1.25;

/// The parts of a delivery, as settings name them.
pub struct Names<'a> {
    /// Joints of the robot, which come first in the model.
    pub robot_ndof: usize,
    /// Site of the hand.
    pub robot_site_name: &'a str,
    /// Site of the object.
    pub object_site_name: &'a str,
    /// Site of the target.
    pub target_site_name: &'a str,
}

/// A hand, an object, and where the object is to go.
#[derive(Clone)]
pub struct Delivery {
    joints: usize,
    hand: SiteId,
    object: SiteId,
    /// The target.
    pub target: SiteId,
}

impl Delivery {
    /// Finds the parts in the model.
    ///
    /// # Errors
    /// Sites are missing; the robot has more joints than the model.
    pub fn new(spec: &Spec, scene: &Scene, names: &Names<'_>) -> Result<Self, EnvError> {
        let free = scene.model.nq.min(scene.model.nv);
        if names.robot_ndof > free {
            return Err(spec.wrong(format!("robot_ndof is {}, and the model has {free}", names.robot_ndof)));
        }
        Ok(Delivery {
            joints: names.robot_ndof,
            hand: scene.site(names.robot_site_name)?,
            object: scene.site(names.object_site_name)?,
            target: scene.site(names.target_site_name)?,
        })
    }

    /// Observation and weights.
    pub fn defaults() -> Defaults {
        Defaults::new(
            &["qp_robot", "qp_object", "qv_robot", "qv_object", "object_err", "target_err"],
            &[("object_dist", -1.0), ("target_dist", -1.0), ("bonus", 4.0), ("penalty", -50.0)],
            40,
        )
    }

    /// The proprioception that both tasks list.
    pub const PROPRIO: [&'static str; 4] = ["qp_robot", "qp_object", "qv_robot", "qv_object"];

    /// Writes the observation.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let (qp_robot, qp_object) = state.qpos.split_at(self.joints);
        let (qv_robot, qv_object) = state.qvel.split_at(self.joints);
        let xpos = |site| *view.data.site(site).xpos();
        rows.set("qp_robot", "rad, m", qp_robot);
        rows.set("qv_robot", "rad/s, m/s", qv_robot);
        rows.set("qp_object", "m, rad", qp_object);
        rows.set("qv_object", "m/s, rad/s", qv_object);
        rows.set("object_err", "m", sub(xpos(self.object), xpos(self.hand)));
        rows.set("target_err", "m", sub(xpos(self.target), xpos(self.object)));
    }

    /// Writes the terms of the reward.
    pub fn reward(compat: Compat, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (reach, rest) = (norm(&rows["object_err"]), norm(&rows["target_err"]));
        terms.set("object_dist", "m", [reach]);
        terms.set("target_dist", "m", [rest]);
        terms.set("bonus", "", [bonus(compat, &[reach < 0.1, rest < 0.1, rest < 0.05])]);
        terms.set("penalty", "", [f64::from(reach > FAR)]);
        Verdict { sparse: -rest, solved: rest < 0.05, done: reach > FAR }
    }
}
