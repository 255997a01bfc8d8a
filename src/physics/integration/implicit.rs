//! Accelerations of the integrators that are implicit in velocity: `(M - h D) a = f` with `D` the derivative of smooth
//! forces (MuJoCo documentation, Computation, "Numerical integration").
//!
//! `implicit` keeps `D` whole and factors an unsymmetric matrix. `implicitfast` leaves Coriolis forces out, keeps the
//! lower triangle and factors it like `M`; free bodies, whose gyroscopic force matters most, get a 6x6 system each.

use crate::derivative::{
    BiasSlope, DerivativeInputs, DerivativeScratch, FreeBodySlope, is_free_body, row, smooth_force_slope,
};
use crate::inertia;
use crate::math::dense::{dot_slice, solve_lu};
use crate::math::{FullRows, add_scaled_slice, dot_sparse};
use crate::model::{Integrator, JointType, Model};
use crate::stages::{Implicit, Inertia};

/// Computes `qDeriv` and the factor that the model's integrator needs: `qLU`, or `qH` with `qHDiagInv`.
pub fn factor(m: &Model, inputs: &DerivativeInputs, out: &mut Implicit, scratch: &mut ImplicitScratch) {
    if is_fast(m) {
        smooth_force_slope(m, inputs, BiasSlope::LeftOut, &mut scratch.derivative, &mut out.qDeriv);
        symmetric_system(m, inputs.inertia, out);
        for (j, _) in free_bodies(m) {
            let first = m.jnt_dofadr[j] as usize;
            for dof in first..first + 6 {
                let at = inertia::row(m, dof);
                out.qH[at.clone()].copy_from_slice(&inputs.inertia.M[at]);
            }
        }
        inertia::factor(m, &mut out.qH, &mut out.qHDiagInv);
    } else {
        smooth_force_slope(m, inputs, BiasSlope::Included, &mut scratch.derivative, &mut out.qDeriv);
        full_system(m, inputs.inertia, out);
        pattern(m).factor_lu(&mut out.qLU, &mut scratch.remaining);
    }
}

/// Working memory of `factor`.
#[derive(Clone, Debug, Default)]
pub struct ImplicitScratch {
    derivative: DerivativeScratch,
    remaining: Vec<usize>,
}

/// Replaces force `x` by the acceleration that `factor` prepared.
pub fn solve(m: &Model, inputs: &DerivativeInputs, factors: &Implicit, force: &[f64], x: &mut [f64]) {
    x.copy_from_slice(force);
    if !is_fast(m) {
        pattern(m).solve_lu(&factors.qLU, x);
        return;
    }
    inertia::solve_ld(m, &factors.qH, &factors.qHDiagInv, x);
    for (j, body) in free_bodies(m) {
        let first = m.jnt_dofadr[j] as usize;
        let system = free_body_system(m, inputs, &factors.qDeriv, body, first);
        let force: [f64; 6] = std::array::from_fn(|i| force[first + i]);
        if let Some(solution) = solve_lu(system, force) {
            x[first..first + 6].copy_from_slice(&solution);
        }
    }
}

/// Computes `qDeriv` and writes to `out` the force `(M - h D) a` that the model's integrator turns into `a`.
pub fn mul(
    m: &Model,
    inputs: &DerivativeInputs,
    factors: &mut Implicit,
    scratch: &mut ImplicitScratch,
    a: &[f64],
    out: &mut [f64],
) {
    if !is_fast(m) {
        smooth_force_slope(m, inputs, BiasSlope::Included, &mut scratch.derivative, &mut factors.qDeriv);
        full_system(m, inputs.inertia, factors);
        for (dof, x) in out.iter_mut().enumerate() {
            let at = row(m, dof);
            *x = dot_sparse(&factors.qLU[at.clone()], &m.D_colind[at], a);
        }
        return;
    }
    smooth_force_slope(m, inputs, BiasSlope::LeftOut, &mut scratch.derivative, &mut factors.qDeriv);
    symmetric_system(m, inputs.inertia, factors);
    inertia::mul_inertia_matrix(m, &factors.qH, a, out);
    for (j, body) in free_bodies(m) {
        let first = m.jnt_dofadr[j] as usize;
        let system = free_body_system(m, inputs, &factors.qDeriv, body, first);
        for (i, row) in system.iter().enumerate() {
            out[first + i] = dot_slice(row, &a[first..]);
        }
    }
}

fn is_fast(m: &Model) -> bool {
    m.opt.integrator == Integrator::Implicitfast
}

/// The pattern of `D`.
fn pattern(m: &Model) -> FullRows<'_> {
    FullRows { rownnz: &m.D_rownnz, rowadr: &m.D_rowadr, diagonal: &m.D_diag, colind: &m.D_colind }
}

/// `qLU = M - h D`.
fn full_system(m: &Model, inertia: &Inertia, out: &mut Implicit) {
    for (value, &from) in out.qLU.iter_mut().zip(&m.mapM2D) {
        *value = usize::try_from(from).map_or(0.0, |k| inertia.M[k]);
    }
    add_scaled_slice(&mut out.qLU, &out.qDeriv, -m.opt.timestep);
}

/// `qH`, the lower triangle of `M - h D`.
fn symmetric_system(m: &Model, inertia: &Inertia, out: &mut Implicit) {
    for ((value, &mass), &from) in out.qH.iter_mut().zip(&inertia.M).zip(&m.mapD2M) {
        *value = mass - m.opt.timestep * out.qDeriv[from as usize];
    }
}

/// Free bodies with their joints.
fn free_bodies(m: &Model) -> impl Iterator<Item = (usize, usize)> + '_ {
    (0..m.njnt)
        .filter(|&j| m.jnt_type[j] == JointType::Free.code())
        .map(|j| (j, m.jnt_bodyid[j] as usize))
        .filter(|&(_, body)| is_free_body(m, body))
}

/// `M - h D` of a free body, Coriolis forces included.
fn free_body_system(
    m: &Model,
    inputs: &DerivativeInputs,
    slope: &[f64],
    body: usize,
    first: usize,
) -> [[f64; 6]; 6] {
    let mass = &inputs.inertia.M;
    let h = m.opt.timestep;
    let mut system = [[0.0; 6]; 6];
    for r in 0..6 {
        for k in inertia::row(m, first + r) {
            let c = m.M_colind[k] as usize - first;
            system[r][c] = mass[k];
            system[c][r] = mass[k];
        }
    }
    for r in 0..6 {
        for k in row(m, first + r) {
            system[r][m.D_colind[k] as usize - first] -= h * slope[k];
        }
    }
    FreeBodySlope::of(m, inputs, body).add_to(&mut system, h, m.body_mass[body]);
    system
}
