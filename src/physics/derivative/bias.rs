//! Derivative of Coriolis and centrifugal forces with respect to velocity, in closed form on composite bodies (after
//! Singh, Russo, Wensing 2022, "Efficient analytical derivatives of rigid-body dynamics", <https://doi.org/10.1109/LRA.2022.3143286>).
//!
//! The bias of degree of freedom `i` is `sᵢ · Σ f` over the bodies that it moves, with `f = I a + v ×* I v`. A change of
//! the rate of `j` changes `v` of the bodies that it moves by `sⱼ`, and their `a` by `yⱼ + sⱼ × v`, where `yⱼ` is the
//! drift of the axis: `ṡⱼ` plus the velocity just after the joint `× sⱼ`. So `f` changes by `I yⱼ + C sⱼ` with
//! `C s = v ×* I s - I (v × s) + s ×* I v`. Both `I` and `C` add up over bodies.

use super::inputs::{DerivativeInputs, row};
use crate::math::{
    Mat3, Spatial, Vec3, add, cross, cross_matrix, cross_motion, dot, linear, mul_inertia, mul_mat,
    mul_mat_t_vec, mul_mat_vec, rotational, scale, spatial, spatial_dot,
};
use crate::model::{JointType, Model};
use crate::stages::{Com, State, Velocity};
use crate::velocity::com_vel::add_motion;
use std::ops::Range;

/// Working memory of the derivative of the bias.
#[derive(Clone, Debug, Default)]
pub struct BiasScratch {
    coriolis: Vec<Coriolis>,
    drift: Vec<Spatial>,
    force: Vec<Spatial>,
}

/// The map `C`. Worked out with Jacobi's identity it depends on the rotational half of `s` alone:
/// `C (a, b) = (K a, 2 a × p)` with the linear momentum `p`.
#[derive(Clone, Copy, Debug, Default)]
struct Coriolis {
    k: Mat3,
    momentum: Vec3,
}

impl Coriolis {
    /// Of one body: `K = wJ + (wJ)ᵀ + 2 (l·h) 1 - h lᵀ - l hᵀ - [L]×`, where `J` is the rotational inertia, `h` mass
    /// times offset, `w` and `l` the velocity, `L` the angular momentum, and `wJ` means `[w]× J`.
    fn of_body(inertia: &[f64; 10], v: &Spatial) -> Self {
        let [xx, yy, zz, xy, xz, yz, h @ .., _] = *inertia;
        let (w, l, momentum) = (rotational(v), linear(v), mul_inertia(inertia, v));
        let turned = mul_mat(&cross_matrix(w), &[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        let spin = cross_matrix(rotational(&momentum));
        let trace = 2.0 * dot(l, h);
        let k = std::array::from_fn(|e| {
            let (r, c) = (e / 3, e % 3);
            let symmetric = turned[e] + turned[3 * c + r] - h[r] * l[c] - l[r] * h[c];
            symmetric + if r == c { trace } else { 0.0 } - spin[e]
        });
        Coriolis { k, momentum: linear(&momentum) }
    }

    fn add(&mut self, other: &Coriolis) {
        self.k.iter_mut().zip(other.k).for_each(|(a, b)| *a += b);
        self.momentum = add(self.momentum, other.momentum);
    }

    /// `C s`.
    fn mul(&self, s: &Spatial) -> Spatial {
        let a = rotational(s);
        spatial(mul_mat_vec(&self.k, a), scale(cross(a, self.momentum), 2.0))
    }

    /// Rotational half of `Cᵀ s`; the other is zero.
    fn mul_transposed(&self, s: &Spatial) -> Vec3 {
        add(mul_mat_t_vec(&self.k, rotational(s)), scale(cross(self.momentum, linear(s)), 2.0))
    }
}

/// Subtracts `d qfrc_bias / d qvel`, without what armature of tendons adds to the bias.
pub(super) fn subtract_bias(
    m: &Model,
    inputs: &DerivativeInputs,
    scratch: &mut BiasScratch,
    out: &mut [f64],
) {
    let (com, vel, crb) = (inputs.com, inputs.vel, &inputs.inertia.crb);
    let BiasScratch { coriolis, drift, force } = scratch;
    composite_coriolis(m, com, vel, coriolis);
    drift.resize(m.nv, [0.0; 6]);
    force.resize(m.nv, [0.0; 6]);
    (1..m.nbody).for_each(|b| axis_drift(m, inputs.state, com, vel, b, drift));
    for dof in 0..m.nv {
        let b = m.dof_bodyid[dof] as usize;
        force[dof] = force_slope(&crb[b], &coriolis[b], &com.cdof[dof], &drift[dof]);
    }
    for i in 0..m.nv {
        let (b, s, at) = (m.dof_bodyid[i] as usize, &com.cdof[i], row(m, i));
        let (from_drift, from_motion) = (mul_inertia(&crb[b], s), coriolis[b].mul_transposed(s));
        let (upwards, downwards) = out[at.clone()].split_at_mut(m.D_diag[i] as usize + 1);
        let (ancestors, descendants) = m.D_colind[at].split_at(upwards.len());
        for (entry, &j) in upwards.iter_mut().zip(ancestors) {
            let j = j as usize;
            *entry -= spatial_dot(&from_drift, &drift[j]) + dot(from_motion, rotational(&com.cdof[j]));
        }
        for (entry, &j) in downwards.iter_mut().zip(descendants) {
            *entry -= spatial_dot(s, &force[j as usize]);
        }
    }
}

/// `I y + C s`.
fn force_slope(inertia: &[f64; 10], coriolis: &Coriolis, s: &Spatial, drift: &Spatial) -> Spatial {
    let (from_drift, from_motion) = (mul_inertia(inertia, drift), coriolis.mul(s));
    std::array::from_fn(|i| from_drift[i] + from_motion[i])
}

/// `C` of each body with its subtree.
fn composite_coriolis(m: &Model, com: &Com, vel: &Velocity, out: &mut Vec<Coriolis>) {
    out.clear();
    out.extend(com.cinert.iter().zip(&vel.cvel).map(|(inertia, v)| Coriolis::of_body(inertia, v)));
    for b in (1..m.nbody).rev() {
        let child = out[b];
        out[m.body_parentid[b] as usize].add(&child);
    }
}

/// Drift of the axes of body `b`.
fn axis_drift(m: &Model, state: &State, com: &Com, vel: &Velocity, b: usize, out: &mut [Spatial]) {
    let mut v = vel.cvel[m.body_parentid[b] as usize];
    for j in m.body_jntadr[b]..m.body_jntadr[b] + m.body_jntnum[b] {
        for group in groups(m, j as usize) {
            add_motion(&com.cdof, &state.qvel, group.clone(), &mut v);
            group.for_each(|dof| out[dof] = drift_of(com, vel, &v, dof));
        }
    }
}

/// Drift of axis `dof` with the velocity `v` just after its group.
fn drift_of(com: &Com, vel: &Velocity, v: &Spatial, dof: usize) -> Spatial {
    let carried = cross_motion(v, &com.cdof[dof]);
    std::array::from_fn(|i| vel.cdof_dot[dof][i] + carried[i])
}

/// Degrees of freedom of joint `j` whose axes do not turn each other; the second group may be empty.
fn groups(m: &Model, j: usize) -> [Range<usize>; 2] {
    let dof = m.jnt_dofadr[j] as usize;
    match JointType::from_code(m.jnt_type[j]) {
        Some(JointType::Free) => [dof..dof + 3, dof + 3..dof + 6],
        Some(JointType::Ball) => [dof..dof + 3, dof..dof],
        Some(JointType::Slide | JointType::Hinge) | None => [dof..dof + 1, dof..dof],
    }
}
