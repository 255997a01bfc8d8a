//! Joint-space inertia `M`, its factor, and products and solutions with them. `M` is kept as its lower triangle in
//! compressed rows whose pattern is the chain of ancestors, diagonal last; its factor `L'DL` has the same pattern
//! (Featherstone 2008, sections 6.2 composite rigid bodies, 6.5 sparse factorisation).
//!
//! ```
//! use robohive_physics::inertia::{mul_inertia_matrix, solve};
//! use robohive_physics::{Data, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let (mut force, velocity) = ([0.0; 6], [1.0, 2.0, 3.0, 0.1, 0.2, 0.3]);
//! mul_inertia_matrix(&model, &data.inertia.M, &velocity, &mut force);
//! assert!((force[2] - 3.0).abs() < 1e-12, "a kilogram");
//! solve(&model, &data.inertia, &mut force);
//! assert!(force.iter().zip(velocity).all(|(x, v)| (x - v).abs() < 1e-12));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::math::{LowerRows, add_scaled_slice, mul_inertia, spatial_dot};
use crate::model::Model;
use crate::model::reflected_load::{Driven, dof_armature};
use crate::position::tendon;
use crate::sleep::{Awake, Subset, object, over};
use crate::stages::{Com, Inertia, Tendons};
use std::ops::Range;

/// Computes `crb` and `M`: rigid bodies, armature of joints, tendons and actuators.
pub fn make_inertia(m: &Model, com: &Com, ten: &Tendons, inertia: &mut Inertia) {
    make_inertia_of(m, Awake::EVERYTHING, com, ten, inertia);
}

/// [`make_inertia`] of what is awake.
pub(crate) fn make_inertia_of(m: &Model, awake: Awake, com: &Com, ten: &Tendons, inertia: &mut Inertia) {
    composite_bodies(m, awake, com, inertia);
    over!(awake.dofs(m), |dofs| inertia_rows(m, com, inertia, dofs));
    for t in 0..m.ntendon {
        let armature = tendon_armature(m, t);
        if armature != 0.0 && !awake.skips(|state| object::tendon(m, state, t)) {
            let at = tendon::row(m, t);
            add_outer_product(m, &m.ten_J_colind[at.clone()], &ten.ten_J[at], armature, &mut inertia.M);
        }
    }
}

/// Rows of `M` without tendons.
#[inline]
fn inertia_rows(m: &Model, com: &Com, inertia: &mut Inertia, dofs: impl Iterator<Item = usize>) {
    for dof in dofs {
        let at = row(m, dof);
        if m.dof_simplenum[dof] != 0 {
            inertia.M[at.start] = m.dof_M0[dof];
            continue;
        }
        let force = mul_inertia(&inertia.crb[m.dof_bodyid[dof] as usize], &com.cdof[dof]);
        for (value, &ancestor) in inertia.M[at.clone()].iter_mut().zip(&m.M_colind[at.clone()]) {
            *value = spatial_dot(&com.cdof[ancestor as usize], &force);
        }
        inertia.M[at.end - 1] += dof_armature(m, dof);
    }
}

/// Composite inertia of each subtree below the world.
fn composite_bodies(m: &Model, awake: Awake, com: &Com, inertia: &mut Inertia) {
    match awake.bodies(m) {
        Subset::All(_) => inertia.crb.copy_from_slice(&com.cinert),
        Subset::Listed(bodies) => {
            bodies.iter().for_each(|&b| inertia.crb[b as usize] = com.cinert[b as usize])
        }
    }
    over!(awake.children(m), |bodies| for b in bodies.rev() {
        let parent = m.body_parentid[b] as usize;
        if parent > 0 {
            let child = inertia.crb[b];
            for (sum, part) in inertia.crb[parent].iter_mut().zip(child) {
                *sum += part;
            }
        }
    });
}

/// Armature along tendon `t`, actuators included.
pub fn tendon_armature(m: &Model, t: usize) -> f64 {
    m.tendon_armature[t] + Driven::Tendon(t).armature(m)
}

/// `matrix += s r'r` with a sparse row `r`, columns ascending, on the pattern of `M`.
///
/// Not inlined, so that the addresses of its arrays are loaded only where tendons have armature.
#[inline(never)]
pub fn add_outer_product(m: &Model, columns: &[i32], values: &[f64], s: f64, matrix: &mut [f64]) {
    for (&dof, &value) in columns.iter().zip(values).filter(|(_, v)| **v != 0.0) {
        let target = row(m, dof as usize);
        let mut source = 0;
        for (entry, &column) in matrix[target.clone()].iter_mut().zip(&m.M_colind[target]) {
            while source < columns.len() && columns[source] < column {
                source += 1;
            }
            if source < columns.len() && columns[source] == column {
                *entry += s * value * values[source];
            }
        }
    }
}

/// Entries of row `dof` of `M`, diagonal last.
pub fn row(m: &Model, dof: usize) -> Range<usize> {
    let start = m.M_rowadr[dof] as usize;
    start..start + m.M_rownnz[dof] as usize
}

/// Factors `M` into `qLD` and `qLDiagInv`.
pub fn factor_inertia(m: &Model, inertia: &mut Inertia) {
    factor_inertia_of(m, Awake::EVERYTHING, inertia);
}

/// [`factor_inertia`] of what is awake.
pub(crate) fn factor_inertia_of(m: &Model, awake: Awake, inertia: &mut Inertia) {
    let Inertia { M, qLD, qLDiagInv, .. } = inertia;
    match awake.dofs(m) {
        Subset::All(_) => qLD.copy_from_slice(M),
        Subset::Listed(dofs) => {
            for at in dofs.iter().map(|&dof| row(m, dof as usize)) {
                qLD[at.clone()].copy_from_slice(&M[at]);
            }
        }
    }
    over!(awake.dofs(m), |dofs| factor_rows(m, qLD, qLDiagInv, dofs));
}

/// Replaces a positive definite matrix on the pattern of `M` by its factor `L'DL`: unit lower triangle `L`, with
/// `D` on the diagonal; `diag_inv` takes the reciprocals of `D`. Rows are eliminated from the leaves to the root.
pub fn factor(m: &Model, matrix: &mut [f64], diag_inv: &mut [f64]) {
    factor_rows(m, matrix, diag_inv, 0..m.nv);
}

/// The same of the trees that have these degrees of freedom.
#[inline]
pub(crate) fn factor_rows(
    m: &Model,
    matrix: &mut [f64],
    diag_inv: &mut [f64],
    dofs: impl DoubleEndedIterator<Item = usize>,
) {
    for k in dofs.rev() {
        let at = row(m, k);
        let columns = &m.M_colind[at.clone()];
        let (above, from_k) = matrix.split_at_mut(at.start);
        let (off_diagonal, diagonal) = from_k[..at.len()].split_at_mut(at.len() - 1);
        let inv = 1.0 / diagonal[0];
        diag_inv[k] = inv;
        for p in (0..off_diagonal.len()).rev() {
            let target = m.M_rowadr[columns[p] as usize] as usize;
            let s = -off_diagonal[p] * inv;
            // Row `i` of the pattern is the head of row `k` up to column `i`.
            add_scaled_slice(&mut above[target..=target + p], &off_diagonal[..=p], s);
        }
        off_diagonal.iter_mut().for_each(|x| *x *= inv);
    }
}

/// The pattern of `M`.
fn pattern(m: &Model) -> LowerRows<'_> {
    LowerRows { rownnz: &m.M_rownnz, rowadr: &m.M_rowadr, colind: &m.M_colind }
}

/// `x <- (L'DL)^-1 x`.
pub fn solve_ld(m: &Model, ld: &[f64], diag_inv: &[f64], x: &mut [f64]) {
    pattern(m).solve_ldl(ld, diag_inv, x);
}

/// The same of the trees that have these degrees of freedom.
pub(crate) fn solve_of(m: &Model, dofs: &[i32], ld: &[f64], diag_inv: &[f64], x: &mut [f64]) {
    for run in dofs.chunk_by(|a, b| a + 1 == *b) {
        let first = run[0] as usize;
        pattern(m).solve_ldl_rows(ld, diag_inv, first..first + run.len(), x);
    }
}

/// `x <- M^-1 x`.
pub fn solve(m: &Model, inertia: &Inertia, x: &mut [f64]) {
    solve_ld(m, &inertia.qLD, &inertia.qLDiagInv, x);
}

/// `x <- M^-1 x` for the degrees of freedom of whole trees; the rest of `x` is neither read nor written.
pub(crate) fn solve_within(m: &Model, inertia: &Inertia, dofs: Range<usize>, x: &mut [f64]) {
    pattern(m).solve_ldl_rows(&inertia.qLD, &inertia.qLDiagInv, dofs, x);
}

/// `out = M v` for a symmetric matrix on the pattern of `M`.
pub fn mul_inertia_matrix(m: &Model, matrix: &[f64], v: &[f64], out: &mut [f64]) {
    pattern(m).mul_symmetric(matrix, v, out);
}

/// `M` as a dense symmetric matrix, row-major, `nv * nv`.
pub fn full_inertia(m: &Model, matrix: &[f64]) -> Vec<f64> {
    let mut dense = vec![0.0; m.nv * m.nv];
    for i in 0..m.nv {
        for k in row(m, i) {
            let j = m.M_colind[k] as usize;
            dense[i * m.nv + j] = matrix[k];
            dense[j * m.nv + i] = matrix[k];
        }
    }
    dense
}
