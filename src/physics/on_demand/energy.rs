//! Mechanical energy (documentation: Computation, "Energy").

use crate::flex::springs;
use crate::inertia::mul_inertia_matrix;
use crate::math::Polynomial;
use crate::math::dense::dot_slice;
use crate::math::{dot, norm};
use crate::model::{Disable, JointType, Model};
use crate::sleep::{Awake, object};
use crate::stages::{Configuration, Inertia, State};
use crate::velocity::passive::{shift, tendon_stretch, turn};

/// Potential energy: weight of all bodies, springs of joints, tendons and lines of flexes \[J\].
pub fn potential(m: &Model, at: &Configuration) -> f64 {
    let Configuration { state, kin, ten, .. } = *at;
    let enabled = |flag: Disable| !m.opt.disableflags.contains(flag);
    let mut energy = 0.0;
    if enabled(Disable::GRAVITY) {
        (1..m.nbody).for_each(|b| energy -= m.body_mass[b] * dot(m.opt.gravity, kin.xipos[b]));
    }
    if enabled(Disable::SPRING) {
        let awake = Awake::of(m, state);
        let joints = (0..m.njnt).filter(|&j| awake.moves(m.jnt_bodyid[j] as usize));
        joints.for_each(|j| energy += joint_spring(m, state, j));
        for t in (0..m.ntendon).filter(|&t| awake.has_awake(|state| object::tendon(m, state, t))) {
            let law = Polynomial { linear: m.tendon_stiffness[t], poly: m.tendon_stiffnesspoly[t] };
            energy += law.potential(tendon_stretch(m, ten, t));
        }
        springs::add_energy(m, at.flex, &mut energy);
    }
    energy
}

fn joint_spring(m: &Model, state: &State, j: usize) -> f64 {
    let law = Polynomial { linear: m.jnt_stiffness[j], poly: m.jnt_stiffnesspoly[j] };
    let q = m.jnt_qposadr[j] as usize;
    if law.is_zero() {
        return 0.0;
    }
    match JointType::from_code(m.jnt_type[j]) {
        Some(JointType::Free) => {
            law.potential(norm(shift(m, state, q))) + law.potential(norm(turn(m, state, q + 3)))
        }
        Some(JointType::Ball) => law.potential(norm(turn(m, state, q))),
        Some(JointType::Slide | JointType::Hinge) | None => law.potential(state.qpos[q] - m.qpos_spring[q]),
    }
}

/// Kinetic energy \[J\]; `momentum` is working memory.
pub fn kinetic(m: &Model, state: &State, inertia: &Inertia, momentum: &mut Vec<f64>) -> f64 {
    momentum.resize(m.nv, 0.0);
    mul_inertia_matrix(m, &inertia.M, &state.qvel, momentum);
    0.5 * dot_slice(momentum, &state.qvel)
}
