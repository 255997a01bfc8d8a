//! Parts of a body that tasks find by its roles.

use crate::assets::own_file;
use crate::error::EnvError;
use crate::task::Setup;
use physics::Model;
use physics::elements::BodyId;
use physics::model::JointType;
use robot::Roles;

/// A hinge or slide below the root.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// Where `qpos` has it.
    pub position: usize,
    /// Where `qvel` has it.
    pub velocity: usize,
}

/// Reads the roles that a setting names.
///
/// # Errors
/// The file cannot be read, or is none of roles.
pub fn read_roles(path: &str, setup: &Setup<'_>) -> Result<Roles, EnvError> {
    let bytes = own_file(path).map_or_else(|| setup.assets.read(path), Ok);
    let bytes = bytes.map_err(|hint| setup.wrong(format!("roles: {path}: {hint}")))?;
    Ok(Roles::from_toml(&String::from_utf8_lossy(&bytes), path)?)
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
