//! Parts of a body that tasks find by its roles.

use physics::Model;
use physics::elements::BodyId;
use physics::model::JointType;

/// A hinge or slide below the root.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// Where `qpos` has it.
    pub position: usize,
    /// Where `qvel` has it.
    pub velocity: usize,
}

/// Whether a body is below the root, or the root itself.
pub fn is_below(m: &Model, root: BodyId, mut body: usize) -> bool {
    while body > root.index() {
        body = m.body_parentid[body] as usize;
    }
    body == root.index()
}

/// Hinges and slides below the root.
pub fn joints_below(m: &Model, root: BodyId) -> Vec<Bend> {
    let scalar = [JointType::Hinge, JointType::Slide].map(|kind| kind as i32);
    let below = |joint: &usize| is_below(m, root, m.jnt_bodyid[*joint] as usize);
    let of = |joint: usize| Bend {
        position: m.jnt_qposadr[joint] as usize,
        velocity: m.jnt_dofadr[joint] as usize,
    };
    (0..m.njnt).filter(|&joint| scalar.contains(&m.jnt_type[joint])).filter(below).map(of).collect()
}
