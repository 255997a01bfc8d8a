//! Limit rows of joints and tendons: active when the distance to the limit is below the margin.

use super::friction_loss::tendon_row;
use super::rows::{RowKind, is_empty, push};
use super::scratch::ConstraintScratch;
use crate::math::{normalize, quat_normalize, quat_to_velocity, scale};
use crate::model::{ConstraintType, Disable, JointType, Model};
use crate::sleep::Awake;
use crate::stages::{Constraints, State, Tendons};

/// Appends one row for each joint or tendon limit within its margin, lower limits before upper ones.
pub(super) fn limits(
    m: &Model,
    state: &State,
    ten: &Tendons,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    if m.opt.disableflags.contains(Disable::LIMIT) {
        return;
    }
    let awake = Awake::of(m, state);
    let sleeps = |joint: usize| awake.sleeps(m.jnt_bodyid[joint] as usize);
    for joint in (0..m.njnt).filter(|&j| m.jnt_limited[j] && !sleeps(j)) {
        match JointType::from_code(m.jnt_type[joint]) {
            Some(JointType::Slide | JointType::Hinge) => scalar_limit(m, state, joint, efc),
            Some(JointType::Ball) => ball_limit(m, state, joint, efc),
            Some(JointType::Free) | None => {}
        }
    }
    for tendon in (0..m.ntendon).filter(|&t| m.tendon_limited[t]) {
        tendon_limit(m, ten, tendon, efc, &mut scratch.values);
    }
}

/// Distances to the lower and upper limit with the sign of the Jacobian.
fn sides(range: [f64; 2], value: f64) -> [(f64, f64); 2] {
    [(value - range[0], 1.0), (range[1] - value, -1.0)]
}

fn scalar_limit(m: &Model, state: &State, joint: usize, efc: &mut Constraints) {
    let margin = m.jnt_margin[joint];
    let row = RowKind { kind: ConstraintType::LimitJoint, id: joint, margin, frictionloss: 0.0 };
    for (distance, sign) in sides(m.jnt_range[joint], state.qpos[m.jnt_qposadr[joint] as usize]) {
        if distance < margin {
            push(efc, row, distance, &[m.jnt_dofadr[joint]], &[sign]);
        }
    }
}

/// A ball joint is limited in its angle of rotation.
fn ball_limit(m: &Model, state: &State, joint: usize, efc: &mut Constraints) {
    let (margin, at, dof) = (m.jnt_margin[joint], m.jnt_qposadr[joint] as usize, m.jnt_dofadr[joint]);
    let quat = quat_normalize(std::array::from_fn(|k| state.qpos[at + k]));
    let (axis, angle) = normalize(quat_to_velocity(quat, 1.0));
    let distance = m.jnt_range[joint][0].max(m.jnt_range[joint][1]) - angle;
    if distance < margin {
        let row = RowKind { kind: ConstraintType::LimitJoint, id: joint, margin, frictionloss: 0.0 };
        push(efc, row, distance, &[dof, dof + 1, dof + 2], &scale(axis, -1.0));
    }
}

/// Not inlined, so that the addresses of its arrays are loaded only where tendons are limited.
#[inline(never)]
fn tendon_limit(m: &Model, ten: &Tendons, tendon: usize, efc: &mut Constraints, signed: &mut Vec<f64>) {
    let margin = m.tendon_margin[tendon];
    let row = RowKind { kind: ConstraintType::LimitTendon, id: tendon, margin, frictionloss: 0.0 };
    for (distance, sign) in sides(m.tendon_range[tendon], ten.ten_length[tendon]) {
        if distance >= margin {
            continue;
        }
        let first = efc.nefc as i32;
        let (columns, values) = tendon_row(m, ten, tendon);
        signed.clear();
        signed.extend(values.iter().map(|v| sign * v));
        if !is_empty(m, signed) {
            push(efc, row, distance, columns, signed);
        }
        if efc.tendon_efcadr[tendon] == -1 {
            efc.tendon_efcadr[tendon] = first;
        }
    }
}
