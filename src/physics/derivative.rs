//! Derivatives of smooth forces with respect to velocity, and the step that treats them implicitly (MuJoCo
//! documentation, Computation, "Numerical integration", `implicitfast`).

use crate::activation::{activations, is_disabled, next_activation};
use crate::actuation::muscle;
use crate::data::{Actuation, Data, Implicit, Inertia, Kinematics, State, Tendons, Transmission, Velocity};
use crate::inertia::{add_outer_product, factor, row, solve_ld};
use crate::integrate::advance_by;
use crate::math::{Mat3, Vec3, cross, mul_mat, mul_mat_mat_t, mul_mat_t_mat, mul_mat_vec, norm, scale, sub};
use crate::model::bounds::MINVAL;
use crate::model::{BiasType, DynType, GainType, JointType, Model, disable};
use crate::reflected_load::{dof_damping, tendon_damping};
use crate::tendon;

/// Working memory of implicit integration.
#[derive(Clone, Debug, Default)]
pub struct ImplicitScratch {
    qacc: Vec<f64>,
    free: Vec<(usize, [f64; 6])>,
}

/// Advances the state by one step, implicit in the velocity dependence of passive and actuator forces. Forces of a
/// body that flies alone include the gyroscopic ones; of all others the bias force is taken at the start.
pub fn implicit_fast(m: &Model, d: &mut Data) {
    let mut scratch = std::mem::take(&mut d.scratch.implicit);
    let ImplicitScratch { qacc, free } = &mut scratch;
    qacc.clear();
    qacc.extend(d.acc.qfrc_smooth.iter().zip(&d.acc.qfrc_constraint).map(|(s, c)| s + c));
    let Implicit { qH, qHDiagInv, .. } = &mut d.implicit;
    qH.fill(0.0);
    passive_derivative(m, &d.state, &d.ten, &d.vel, qH);
    actuator_derivative(m, &d.state, &d.trn, &d.vel, &d.actuation, qH);
    free.clear();
    for j in (0..m.njnt).filter(|&j| flies_alone(m, j)) {
        free_body(m, &d.state, &d.kin, &d.inertia, j, qH, qacc, free);
    }
    for (entry, inertia) in qH.iter_mut().zip(&d.inertia.M) {
        *entry = inertia - m.opt.timestep * *entry;
    }
    factor(m, qH, qHDiagInv);
    solve_ld(m, qH, qHDiagInv, qacc);
    for (dof, x) in free.iter() {
        qacc[*dof..dof + 6].copy_from_slice(x);
    }
    advance_by(m, d, &scratch.qacc);
    d.scratch.implicit = scratch;
}

/// Adds the derivative of damping forces of joints and tendons, on the pattern of `M`.
fn passive_derivative(m: &Model, state: &State, ten: &Tendons, vel: &Velocity, out: &mut [f64]) {
    if m.opt.disableflags & disable::DAMPER != 0 {
        return;
    }
    for dof in 0..m.nv {
        out[row(m, dof).end - 1] -= dof_damping(m, dof).slope(state.qvel[dof].abs());
    }
    for t in 0..m.ntendon {
        let slope = tendon_damping(m, t).slope(vel.ten_velocity[t].abs());
        if slope != 0.0 {
            let at = tendon::row(m, t);
            add_outer_product(m, &m.ten_J_colind[at.clone()], &ten.ten_J[at], -slope, out);
        }
    }
}

/// Adds the derivative of actuator forces, on the pattern of `M`; a force at its limit does not change.
fn actuator_derivative(
    m: &Model,
    state: &State,
    trn: &Transmission,
    vel: &Velocity,
    actuation: &Actuation,
    out: &mut [f64],
) {
    if m.opt.disableflags & disable::ACTUATION != 0 {
        return;
    }
    for i in (0..m.nactuator).filter(|&i| !is_disabled(m, i) && !is_saturated(m, actuation, i)) {
        let first = m.actuator_outadr[i] as usize;
        let mut slope = match BiasType::from_code(m.actuator_biastype[i]) {
            Some(BiasType::Affine | BiasType::So3) => m.actuator_biasprm[i][2],
            _ => 0.0,
        };
        let gain_slope = match GainType::from_code(m.actuator_gaintype[i]) {
            Some(GainType::Affine) => m.actuator_gainprm[i][2],
            Some(GainType::Muscle) => muscle(m, i, &m.actuator_gainprm[i])
                .gain_slope(trn.actuator_length[first], vel.actuator_velocity[first]),
            _ => 0.0,
        };
        if gain_slope != 0.0 {
            slope += gain_slope * input(m, state, actuation, i);
        }
        if slope == 0.0 {
            continue;
        }
        for o in first..first + m.actuator_outnum[i] as usize {
            let start = trn.moment_rowadr[o] as usize;
            let at = start..start + trn.moment_rownnz[o] as usize;
            add_outer_product(m, &trn.moment_colind[at.clone()], &trn.actuator_moment[at], slope, out);
        }
    }
}

fn is_saturated(m: &Model, actuation: &Actuation, i: usize) -> bool {
    let first = m.actuator_outadr[i] as usize;
    let ([low, high], force) = (m.actuator_forcerange[i], &actuation.actuator_force[first..]);
    m.actuator_forcelimited[i]
        && if m.actuator_gaintype[i] == GainType::So3.code() {
            norm([force[0], force[1], force[2]]) >= high
        } else {
            force[0] <= low || force[0] >= high
        }
}

/// What the gain of actuator `i` multiplies: its control or its activation.
fn input(m: &Model, state: &State, actuation: &Actuation, i: usize) -> f64 {
    match activations(m, i).last() {
        Some(k) if m.actuator_dyntype[i] != DynType::None.code() => {
            if m.actuator_actearly[i] {
                next_activation(m, i, state.act[k], actuation.act_dot[k])
            } else {
                state.act[k]
            }
        }
        _ => state.ctrl[m.actuator_ctrladr[i] as usize],
    }
}

/// True when joint `j` is free and its body is a tree of its own.
fn flies_alone(m: &Model, j: usize) -> bool {
    let (body, dof) = (m.jnt_bodyid[j] as usize, m.jnt_dofadr[j] as usize);
    m.jnt_type[j] == JointType::Free.code()
        && m.body_jntnum[body] == 1
        && m.tree_dofnum[m.dof_treeid[dof] as usize] == 6
        && m.body_subtreemass[body] == m.body_mass[body]
}

/// Solves for the six accelerations of free joint `j` with the full, unsymmetric derivative, and clears its rows of
/// `derivative`, which the symmetric solution of all others then leaves out.
#[allow(clippy::too_many_arguments)]
fn free_body(
    m: &Model,
    state: &State,
    kin: &Kinematics,
    inertia: &Inertia,
    j: usize,
    derivative: &mut [f64],
    force: &[f64],
    solutions: &mut Vec<(usize, [f64; 6])>,
) {
    let (first, h) = (m.jnt_dofadr[j] as usize, m.opt.timestep);
    let mut a = [[0.0; 6]; 6];
    for r in 0..6 {
        for k in row(m, first + r) {
            let c = m.M_colind[k] as usize - first;
            let value = inertia.M[k] - h * derivative[k];
            (a[r][c], a[c][r]) = (value, value);
        }
        derivative[row(m, first + r)].fill(0.0);
    }
    let [linear, rotational] = free_bias_derivative(m, state, kin, j);
    for r in 0..3 {
        for c in 0..3 {
            a[r][3 + c] += h * linear[3 * r + c];
            a[3 + r][3 + c] += h * rotational[3 * r + c];
        }
    }
    let b = std::array::from_fn(|k| force[first + k]);
    if let Some(x) = solve_six(a, b) {
        solutions.push((first, x));
    }
}

/// Derivative of the bias force and torque of a body that flies alone with respect to its angular velocity, in the
/// frames of the free joint: with `s` from the origin of the frame to the centre of mass, `w` the angular velocity
/// and `I` the inertia, both in the world, the bias is the force `f = m w × (w × s)` and the torque
/// `s × f + w × I w`.
fn free_bias_derivative(m: &Model, state: &State, kin: &Kinematics, j: usize) -> [Mat3; 2] {
    let (body, dof) = (m.jnt_bodyid[j] as usize, m.jnt_dofadr[j] as usize);
    let (turn, mass) = (&kin.xmat[body], m.body_mass[body]);
    let w = mul_mat_vec(turn, [state.qvel[dof + 3], state.qvel[dof + 4], state.qvel[dof + 5]]);
    let s = sub(kin.xipos[body], kin.xpos[body]);
    let [x, y, z] = m.body_inertia[body];
    let principal = [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z];
    let spin = mul_mat_mat_t(&mul_mat(&kin.ximat[body], &principal), &kin.ximat[body]);
    // d(w × (w × s)) = -([w × s] + [w][s]) dw, d(w × I w) = ([w] I - [I w]) dw, where [a] b = a × b.
    let offset = add_mat(&skew(cross(w, s)), &mul_mat(&skew(w), &skew(s)), 1.0);
    let force = offset.map(|x| -mass * x);
    let gyroscopic = add_mat(&mul_mat(&skew(w), &spin), &skew(mul_mat_vec(&spin, w)), -1.0);
    let torque = add_mat(&mul_mat(&skew(s), &force), &gyroscopic, 1.0);
    [mul_mat(&force, turn), mul_mat(&mul_mat_t_mat(turn, &torque), turn)]
}

/// Matrix of the vector product with `a` from the left.
fn skew(a: Vec3) -> Mat3 {
    let [x, y, z] = scale(a, -1.0);
    [0.0, z, -y, -z, 0.0, x, y, -x, 0.0]
}

fn add_mat(a: &Mat3, b: &Mat3, s: f64) -> Mat3 {
    std::array::from_fn(|k| a[k] + s * b[k])
}

/// Solves a system of six equations by elimination with row exchange; `None` when it is singular.
fn solve_six(mut a: [[f64; 6]; 6], mut b: [f64; 6]) -> Option<[f64; 6]> {
    for k in 0..6 {
        let mut pivot = k;
        for i in k + 1..6 {
            if a[i][k].abs() > a[pivot][k].abs() {
                pivot = i;
            }
        }
        if a[pivot][k].abs() < MINVAL {
            return None;
        }
        a.swap(k, pivot);
        b.swap(k, pivot);
        let inverse = 1.0 / a[k][k];
        for i in k + 1..6 {
            let factor = a[i][k] * inverse;
            for c in k + 1..6 {
                a[i][c] -= factor * a[k][c];
            }
            b[i] -= factor * b[k];
        }
    }
    for i in (0..6).rev() {
        for c in i + 1..6 {
            b[i] -= a[i][c] * b[c];
        }
        b[i] /= a[i][i];
    }
    Some(b)
}
