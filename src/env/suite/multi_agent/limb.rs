//! A robot that stands, as an agent that moves a load: its joints, and what touches the load.

use crate::rows::Rows;
use crate::suite::body::{Bend, is_below, joints_below};
use crate::task::View;
use crate::team::prefix;
use physics::elements::BodyId;
use physics::math::{Vec3, mul_mat_t_vec};
use physics::{Data, Model};

/// An arm, or a hand that is moved.
#[derive(Clone)]
pub struct Limb {
    /// What names of its elements, rows and terms begin with.
    pub prefix: String,
    /// The body whose frame its rows are in, and of which all others of it hang.
    pub root: BodyId,
    /// Its joints.
    pub joints: Vec<Bend>,
    controls: Vec<usize>,
}

impl Limb {
    /// Rows that every limb observes.
    pub const ROWS: [&str; 3] = ["joint_pos", "joint_vel", "last_action"];

    /// The limb of an agent below a body.
    pub fn new(agent: &str, root: BodyId, m: &Model) -> Self {
        let prefix = prefix(agent);
        let own = m.actuator_names().filter(|(_, named)| named.starts_with(&prefix));
        let controls = own.map(|(id, _)| m.actuator_ctrladr[id.index()] as usize).collect();
        Limb { root, joints: joints_below(m, root), controls, prefix }
    }

    /// A vector of the world in its frame.
    pub fn local(&self, d: &Data, vector: Vec3) -> Vec3 {
        mul_mat_t_vec(&d.kin.xmat[self.root.index()], vector)
    }

    /// Writes the rows that every limb observes.
    pub fn observe(&self, d: &Data, rows: &mut Rows) {
        let state = &d.state;
        rows.set("joint_pos", "rad, m", self.joints.iter().map(|joint| state.qpos[joint.position]));
        rows.set("joint_vel", "rad/s, m/s", self.joints.iter().map(|joint| state.qvel[joint.velocity]));
        rows.set("last_action", "", self.controls.iter().map(|&control| state.ctrl[control]));
    }

    /// Its parts that touch a body, as often as they do.
    pub fn touching<'v>(&self, view: &'v View<'_>, load: BodyId) -> impl Iterator<Item = usize> + 'v {
        let (m, root) = (view.model, self.root);
        touching(view.model, view.data, load).filter(move |&body| is_below(m, root, body))
    }

    /// Whether nothing but its parts touches a body.
    pub fn alone(&self, m: &Model, d: &Data, load: BodyId) -> bool {
        touching(m, d, load).all(|body| is_below(m, self.root, body))
    }
}

/// Bodies that touch a body, as often as they do.
fn touching<'v>(m: &'v Model, d: &'v Data, load: BodyId) -> impl Iterator<Item = usize> + 'v {
    let load = load.index();
    d.contacts().filter_map(move |contact| {
        let [a, b] = contact.geoms().map(|geom| Some(m.geom_bodyid[geom?.index()] as usize));
        match (a?, b?) {
            (a, b) if a == load => Some(b),
            (a, b) if b == load => Some(a),
            _ => None,
        }
    })
}
