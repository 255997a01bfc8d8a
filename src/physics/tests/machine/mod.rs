//! A machine built here, for laws that hold whatever the numbers are.

use robohive_physics::constants::set_const::set_const;
use robohive_physics::model::{Arrays, JointType};
use robohive_physics::{Data, Model, integration::integrate};

/// A machine that flies, with every kind of joint.
pub const FLYING: [JointType; 5] =
    [JointType::Free, JointType::Hinge, JointType::Ball, JointType::Slide, JointType::Hinge];
/// A machine without rotations in space.
pub const ANCHORED: [JointType; 4] = [JointType::Hinge, JointType::Slide, JointType::Hinge, JointType::Hinge];

/// A chain of bodies on the given joints, all axes and frames askew.
pub fn chain(joints: &[JointType]) -> Model {
    let dofs = |j: JointType| match j {
        JointType::Free => (7, 6),
        JointType::Ball => (4, 3),
        JointType::Slide | JointType::Hinge => (1, 1),
    };
    let n = joints.len();
    let nv: usize = joints.iter().map(|&j| dofs(j).1).sum();
    let nq = joints.iter().map(|&j| dofs(j).0).sum();
    let full = nv * (nv + 1) / 2;
    let mut m = Arrays {
        nq,
        nv,
        nbody: n + 1,
        njnt: n,
        ntree: 1,
        nM: full,
        nC: full,
        nD: nv * nv,
        ..Arrays::default()
    };
    m.allocate();
    m.body_quat.fill([1.0, 0.0, 0.0, 0.0]);
    m.body_iquat.fill([1.0, 0.0, 0.0, 0.0]);
    m.body_mocapid.fill(-1);
    m.body_dofadr[0] = -1;
    m.body_jntadr[0] = -1;
    let (mut q, mut v) = (0, 0);
    for (j, &kind) in joints.iter().enumerate() {
        let b = j + 1;
        let (width, count) = dofs(kind);
        let s = b as f64;
        m.body_parentid[b] = j as i32;
        (m.body_rootid[b], m.body_weldid[b]) = (1, b as i32);
        (m.body_jntadr[b], m.body_jntnum[b]) = (j as i32, 1);
        (m.body_dofadr[b], m.body_dofnum[b]) = (v as i32, count as i32);
        m.body_pos[b] = if j == 0 { [0.0; 3] } else { [0.3, 0.05 * s, -0.1] };
        m.body_ipos[b] = [0.1, 0.02 * s, 0.03];
        m.body_iquat[b] = [0.8, 0.6 / s, (0.36 - 0.36 / (s * s)).sqrt(), 0.0];
        m.body_mass[b] = 1.0 / s;
        m.body_inertia[b] = [0.02 / s, 0.03 / s, 0.015 / s];
        m.jnt_type[j] = kind.code();
        (m.jnt_qposadr[j], m.jnt_dofadr[j], m.jnt_bodyid[j]) = (q as i32, v as i32, b as i32);
        m.jnt_axis[j] = if kind == JointType::Slide { [0.6, 0.0, 0.8] } else { [0.0, 0.6, 0.8] };
        if matches!(kind, JointType::Free | JointType::Ball) {
            m.jnt_axis[j] = [0.0, 0.0, 1.0];
            m.qpos0[q + width - 4] = 1.0;
        }
        m.jnt_pos[j] = if j == 0 { [0.0; 3] } else { [-0.05, 0.01, 0.02] };
        for dof in v..v + count {
            (m.dof_bodyid[dof], m.dof_jntid[dof]) = (b as i32, j as i32);
            m.dof_parentid[dof] = dof as i32 - 1;
            (m.M_rowadr[dof], m.M_rownnz[dof]) = ((dof * (dof + 1) / 2) as i32, dof as i32 + 1);
            for k in 0..=dof {
                m.M_colind[dof * (dof + 1) / 2 + k] = k as i32;
            }
        }
        (q, v) = (q + width, v + count);
    }
    for i in 0..nv {
        (m.D_rowadr[i], m.D_rownnz[i], m.D_diag[i]) = ((i * nv) as i32, nv as i32, i as i32);
        for k in 0..nv {
            let (row, column) = (i.max(k), i.min(k));
            m.D_colind[i * nv + k] = k as i32;
            m.mapM2D[i * nv + k] = (row * (row + 1) / 2 + column) as i32;
            m.mapD2M[row * (row + 1) / 2 + column] = (row * nv + column) as i32;
        }
    }
    m.qpos_spring = m.qpos0.clone();
    let mut m = Model::unchecked(m);
    set_const(&mut m).unwrap();
    m
}

/// The chain in motion, away from `qpos0`.
pub fn moving(m: &Model) -> Data {
    let mut d = Data::new(m);
    let turn: Vec<f64> = (0..m.nv).map(|i| 0.3 + 0.1 * i as f64 - 0.015 * (i * i) as f64).collect();
    integrate::integrate_pos(m, &mut d.state.qpos, &turn, 1.0);
    for (i, v) in d.state.qvel.iter_mut().enumerate() {
        *v = 1.0 - 0.25 * i as f64;
    }
    d
}
