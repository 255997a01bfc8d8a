//! Jacobians of points and orientations: how velocities of degrees of freedom move the world (MuJoCo documentation,
//! API reference, `mj_jac` and its relatives).
//!
//! Matrices are `3 * nv`, row-major. Constraints and tendons do not build them: they walk chains of degrees of freedom
//! and take columns.
//!
//! ```
//! use robohive_physics::{Data, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body name='rod' pos='0 0 1'><joint axis='0 1 0'/><geom name='bob' size='.1' pos='1 0 0'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let bob = model.geom("bob").ok_or("no bob")?;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let [linear, angular] = data.jacobian(&model, bob).velocity(&[2.0]);
//! assert_eq!((linear, angular), ([0.0, 0.0, -2.0], [0.0, 2.0, 0.0]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::math::{Vec3, add, cross, cross_motion, linear, mul_mat_t_vec, mul_mat_vec, rotational, sub};
use crate::model::{JointType, Model};
use crate::position::chain::{apply_wrench, chain, com_offset, point_column};
use crate::stages::{Com, Kinematics, Velocity};

/// Jacobian of a point moving with a body, and of the body's orientation.
#[derive(Clone, Debug, Default)]
pub struct Jacobian {
    /// Translation, `3 * nv`.
    pub pos: Vec<f64>,
    /// Rotation, `3 * nv`.
    pub rot: Vec<f64>,
}

impl Jacobian {
    fn clear(&mut self, nv: usize) {
        for rows in [&mut self.pos, &mut self.rot] {
            rows.clear();
            rows.resize(3 * nv, 0.0);
        }
    }

    fn set(&mut self, dof: usize, pos: Vec3, rot: Vec3) {
        let nv = self.pos.len() / 3;
        for i in 0..3 {
            self.pos[i * nv + dof] = pos[i];
            self.rot[i * nv + dof] = rot[i];
        }
    }

    /// Jacobian of `point`, in world coordinates, moving with body `b`.
    pub fn point(&mut self, m: &Model, com: &Com, b: usize, point: Vec3) {
        self.clear(m.nv);
        let offset = com_offset(m, com, b, point);
        for dof in chain(m, b) {
            self.set(dof, point_column(com, dof, offset), rotational(&com.cdof[dof]));
        }
    }

    /// Jacobian of the frame of body `b`.
    pub fn body(&mut self, m: &Model, kin: &Kinematics, com: &Com, b: usize) {
        self.point(m, com, b, kin.xpos[b]);
    }

    /// Jacobian of the centre of mass of body `b`.
    pub fn body_com(&mut self, m: &Model, kin: &Kinematics, com: &Com, b: usize) {
        self.point(m, com, b, kin.xipos[b]);
    }

    /// Jacobian of geom `g`.
    pub fn geom(&mut self, m: &Model, kin: &Kinematics, com: &Com, g: usize) {
        self.point(m, com, m.geom_bodyid[g] as usize, kin.geom_xpos[g]);
    }

    /// Jacobian of site `s`.
    pub fn site(&mut self, m: &Model, kin: &Kinematics, com: &Com, s: usize) {
        self.point(m, com, m.site_bodyid[s] as usize, kin.site_xpos[s]);
    }

    /// Time derivative of the Jacobian of `point`, in world coordinates, moving with body `b`.
    pub fn point_rate(&mut self, m: &Model, com: &Com, vel: &Velocity, b: usize, point: Vec3) {
        self.clear(m.nv);
        let offset = com_offset(m, com, b, point);
        for dof in chain(m, b) {
            let rate = axis_rate(m, com, vel, dof);
            self.set(dof, point_column_rate(m, com, vel, b, dof, offset), rotational(&rate));
        }
    }
}

/// Jacobian of the centre of mass of the subtree of body `b`, into `out` (`3 * nv`).
pub fn subtree_com_jacobian(m: &Model, kin: &Kinematics, com: &Com, b: usize, out: &mut Vec<f64>) {
    out.clear();
    out.resize(3 * m.nv, 0.0);
    for part in subtree(m, b) {
        let offset = com_offset(m, com, part, kin.xipos[part]);
        for dof in chain(m, part) {
            let column = point_column(com, dof, offset);
            (0..3).for_each(|i| out[i * m.nv + dof] += m.body_mass[part] * column[i]);
        }
    }
    let inverse = 1.0 / m.body_subtreemass[b];
    out.iter_mut().for_each(|x| *x *= inverse);
}

/// Matrix that maps `qvel` to the angular momentum of the subtree of body `b` about its centre of mass.
pub fn angular_momentum_matrix(m: &Model, kin: &Kinematics, com: &Com, b: usize, out: &mut Vec<f64>) {
    out.clear();
    out.resize(3 * m.nv, 0.0);
    for part in subtree(m, b) {
        let offset = com_offset(m, com, part, kin.xipos[part]);
        let arm = sub(kin.xipos[part], com.subtree_com[b]);
        let moments = m.body_inertia[part];
        for dof in chain(m, part) {
            let spin = mul_mat_t_vec(&kin.ximat[part], rotational(&com.cdof[dof]));
            let own = [spin[0] * moments[0], spin[1] * moments[1], spin[2] * moments[2]];
            let orbital = cross(arm, point_column(com, dof, offset));
            let own = mul_mat_vec(&kin.ximat[part], own);
            (0..3).for_each(|i| out[i * m.nv + dof] += own[i] + m.body_mass[part] * orbital[i]);
        }
    }
}

/// Body `b` and its descendants, which follow it.
fn subtree(m: &Model, b: usize) -> impl Iterator<Item = usize> {
    let parents = &m.body_parentid;
    (b..m.nbody).take_while(move |&k| k == b || parents[k] as usize >= b)
}

/// Rate of motion axis `dof`; axes of ball and free rotations turn with their own body.
pub fn axis_rate(m: &Model, com: &Com, vel: &Velocity, dof: usize) -> crate::math::Spatial {
    let j = m.dof_jntid[dof] as usize;
    let rotation = match JointType::from_code(m.jnt_type[j]) {
        Some(JointType::Ball) => true,
        Some(JointType::Free) => dof >= m.jnt_dofadr[j] as usize + 3,
        Some(JointType::Slide | JointType::Hinge) | None => false,
    };
    if rotation {
        cross_motion(&vel.cvel[m.dof_bodyid[dof] as usize], &com.cdof[dof])
    } else {
        vel.cdof_dot[dof]
    }
}

/// Rate of `chain::point_column` for a point of body `b` at `offset` from the reference point.
pub fn point_column_rate(m: &Model, com: &Com, vel: &Velocity, b: usize, dof: usize, offset: Vec3) -> Vec3 {
    let rate = axis_rate(m, com, vel, dof);
    let motion = &vel.cvel[b];
    let velocity = sub(linear(motion), cross(offset, rotational(motion)));
    let carried = add(linear(&rate), cross(rotational(&rate), offset));
    add(carried, cross(rotational(&com.cdof[dof]), velocity))
}

/// Adds to `qfrc` the joint-space equivalent of user wrenches `xfrc_applied` (force first, at centres of mass).
pub fn apply_user_wrenches(
    m: &Model,
    kin: &Kinematics,
    com: &Com,
    xfrc_applied: &[[f64; 6]],
    qfrc: &mut [f64],
) {
    for b in 1..m.nbody {
        let [fx, fy, fz, tx, ty, tz] = xfrc_applied[b];
        if xfrc_applied[b] != [0.0; 6] {
            apply_wrench(m, com, b, kin.xipos[b], [fx, fy, fz], [tx, ty, tz], qfrc);
        }
    }
}
