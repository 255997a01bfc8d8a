//! Where bodies are: those with a free joint in the pose that an episode starts with, others in the model.

use super::size::geoms_of;
use physics::Model;
use physics::math::{Quat, mul_mat_vec, norm, quat_mul, quat_to_mat};
use physics::model::{GeomType, JointType};

/// Where the pose of a body with a free joint stands among the positions of joints; `None` for other bodies.
pub(super) fn free_joint(m: &Model, body: usize) -> Option<usize> {
    let joint = usize::try_from(m.body_jntadr[body]).ok()?;
    (m.jnt_type[joint] == JointType::Free as i32).then(|| m.jnt_qposadr[joint] as usize)
}

/// A body with a free joint.
pub(super) struct Free {
    pub body: usize,
    pub qpos: usize,
}

impl Free {
    /// How far its colliding geoms reach below its frame at the start of an episode \[m\]; of a mesh, its bounding sphere.
    pub fn depth(&self, m: &Model, start: &[f64]) -> f64 {
        let quat: Quat = std::array::from_fn(|k| start[self.qpos + 3 + k]);
        let touching =
            geoms_of(m, self.body).filter(|&g| m.geom_contype[g] != 0 || m.geom_conaffinity[g] != 0);
        touching.map(|g| reach(m, g, quat)).reduce(f64::max).unwrap_or(0.0)
    }

    /// Lifts the start of an episode.
    pub fn raise(&self, height: f64, start: &mut [f64]) {
        start[self.qpos + 2] += height;
    }
}

/// How far a geom reaches below the frame of its body, whose orientation in the world is given.
fn reach(m: &Model, geom: usize, quat: Quat) -> f64 {
    let below = -mul_mat_vec(&quat_to_mat(quat), m.geom_pos[geom])[2];
    let turn = quat_to_mat(quat_mul(quat, m.geom_quat[geom]));
    let [x, y, z] = [turn[6], turn[7], turn[8]];
    let [a, b, c] = m.geom_size[geom];
    below
        + match GeomType::from_code(m.geom_type[geom]) {
            Some(GeomType::Sphere) => a,
            Some(GeomType::Capsule) => z.abs() * b + a,
            Some(GeomType::Cylinder) => z.abs() * b + a * (1.0 - z * z).max(0.0).sqrt(),
            Some(GeomType::Ellipsoid) => norm([x * a, y * b, z * c]),
            Some(GeomType::Box) => x.abs() * a + y.abs() * b + z.abs() * c,
            _ => m.geom_rbound[geom],
        }
}
