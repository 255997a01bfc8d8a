//! The dual problem: forces that minimise `½ fᵀ (A + R) f + fᵀ b` within their cones, with `A = J M⁻¹ Jᵀ`
//! (MuJoCo documentation, Computation, "Dual problem").

use super::dual_pattern::Pattern;
use crate::constraint::{BLOCK, HalfJacobian, TILE, half_jacobian};
use crate::math::dense::{dot_slice, norm_slice};
use crate::math::dot_sparse;
use crate::model::bounds::MINVAL;
use crate::model::{ConstraintState, ConstraintType, Model};
use crate::stages::{Constraints, Contact, Inertia, SolverStat};

/// Changes of cost above this undo the step that made them.
const RISE: f64 = 1e-10;
/// Least diagonal entry without regularisation.
const LEAST_DIAGONAL: f64 = 1e-10;

/// Memory of the dual solvers.
#[derive(Clone, Debug, Default)]
pub(super) struct Dual {
    half: HalfJacobian,
    /// `(A + R) f`.
    product: Vec<f64>,
    /// `A + R`, and the distance of its rows. Full, or where the model is sparse its entries that are not zero by structure,
    /// moved to the beginning of each row.
    ar: Vec<f64>,
    stride: usize,
    /// What stands in the rows where they are compressed.
    pattern: Option<Pattern>,
    /// Starts of row blocks in the order they are visited.
    pub blocks: Vec<usize>,
    /// Forces before the last extrapolation, and after it.
    pub before: Vec<f64>,
    pub extrapolated: Vec<f64>,
}

impl Dual {
    /// Computes `A + R` from `A = Y Yᵀ`, tile by tile, each with its transpose.
    pub fn project(&mut self, m: &Model, inertia: &Inertia, efc: &Constraints) {
        half_jacobian(m, inertia, efc, &mut self.half);
        let stride = efc.nefc.next_multiple_of(BLOCK);
        self.stride = stride;
        self.ar.resize(stride * stride, 0.0);
        for i in (0..efc.nefc).step_by(TILE) {
            for block in 0..=i / BLOCK {
                let (tile, j) = (self.half.product(i, block), block * BLOCK);
                for (r, row) in tile.iter().enumerate() {
                    self.ar[(i + r) * stride + j..][..BLOCK].copy_from_slice(row);
                }
                let transposed: [[f64; TILE]; BLOCK] = std::array::from_fn(|k| tile.map(|row| row[k]));
                for (k, column) in transposed.iter().enumerate() {
                    self.ar[(j + k) * stride + i..][..TILE].copy_from_slice(column);
                }
            }
        }
        for i in 0..efc.nefc {
            self.ar[i * (stride + 1)] += efc.efc_R[i];
        }
        if m.is_sparse() {
            let pattern = self.pattern.get_or_insert_default();
            pattern.find(&self.half, efc);
            for i in 0..efc.nefc {
                let (row, columns) = (&mut self.ar[i * stride..][..stride], pattern.columns(i));
                // Those up to the first gap are where they belong.
                let placed = columns.partition_point(|&j| columns.get(j as usize) == Some(&j));
                (placed..columns.len()).for_each(|k| row[k] = row[columns[k] as usize]);
            }
        } else {
            self.pattern = None;
        }
    }

    /// The entries of row `i` of `A + R` from its diagonal block on, which is full.
    #[inline]
    fn block_row(&self, i: usize, first: usize) -> &[f64] {
        let place = self.pattern.as_ref().map_or(first, |pattern| pattern.place(i, first));
        &self.ar[i * self.stride + place..]
    }

    /// Row `i` of `(A + R) f`.
    #[inline]
    fn row_product(&self, efc: &Constraints, i: usize) -> f64 {
        let row = &self.ar[i * self.stride..];
        match &self.pattern {
            None => dot_slice(&row[..efc.nefc], &efc.efc_force),
            Some(pattern) => {
                let columns = pattern.columns(i);
                dot_sparse(&row[..columns.len()], columns, &efc.efc_force)
            }
        }
    }

    /// Gradient of the cost by the force of row `i`, without regularisation if `bare`.
    #[inline]
    pub fn slope(&self, efc: &Constraints, i: usize, bare: bool) -> f64 {
        let slope = efc.efc_b[i] + self.row_product(efc, i);
        if bare { slope - efc.efc_R[i] * efc.efc_force[i] } else { slope }
    }

    /// Gradient of the cost by the forces of rows `i..i + dim`, without regularisation if `bare`.
    pub fn residual(&self, efc: &Constraints, i: usize, dim: usize, bare: bool) -> [f64; 6] {
        let mut out = [0.0; 6];
        (0..dim).for_each(|j| out[j] = self.slope(efc, i + j, bare));
        out
    }

    /// Diagonal block of rows `i..i + dim`, without regularisation (and safely positive) if `bare`.
    pub fn block(&self, efc: &Constraints, i: usize, dim: usize, bare: bool) -> [f64; 36] {
        let mut out = [0.0; 36];
        for j in 0..dim {
            out[j * dim..(j + 1) * dim].copy_from_slice(&self.block_row(i + j, i)[..dim]);
            if bare {
                out[j * (dim + 1)] = (out[j * (dim + 1)] - efc.efc_R[i + j]).max(LEAST_DIAGONAL);
            }
        }
        out
    }

    /// Diagonal block of rows `j` and `j + 1`, without regularisation.
    #[inline]
    pub fn pair(&self, efc: &Constraints, j: usize) -> [f64; 4] {
        let (upper, lower) = (self.block_row(j, j), self.block_row(j + 1, j));
        let bare = |x: f64, i: usize| (x - efc.efc_R[i]).max(LEAST_DIAGONAL);
        [bare(upper[0], j), upper[1], lower[0], bare(lower[1], j + 1)]
    }

    /// Reciprocal of a diagonal entry, without regularisation if `bare`.
    pub fn inverse_diagonal(&self, efc: &Constraints, i: usize, bare: bool) -> f64 {
        let diagonal = self.block_row(i, i)[0];
        1.0 / if bare { (diagonal - efc.efc_R[i]).max(MINVAL) } else { diagonal }
    }

    /// `fᵀ (A + R) f / 2 + fᵀ b` of all rows.
    pub fn cost(&mut self, efc: &Constraints) -> f64 {
        let force = &efc.efc_force;
        let mut product = std::mem::take(&mut self.product);
        product.clear();
        product.extend((0..efc.nefc).map(|i| self.row_product(efc, i)));
        self.product = product;
        dot_slice(force, &efc.efc_b) + 0.5 * dot_slice(force, &self.product)
    }
}

/// Elliptic contact that begins at row `i`.
#[inline]
pub(super) fn elliptic<'a>(efc: &Constraints, contacts: &'a [Contact], i: usize) -> Option<&'a Contact> {
    (efc.efc_type[i] == ConstraintType::ContactElliptic.code()).then(|| &contacts[efc.efc_id[i] as usize])
}

/// Change of cost from `old` to `force` with quadratic term `a`; forces that raise it are put back.
pub(super) fn cost_change(a: &[f64], force: &mut [f64], old: &[f64], residual: &[f64]) -> f64 {
    let dim = force.len();
    let mut delta = [0.0; 6];
    for j in 0..dim {
        delta[j] = force[j] - old[j];
    }
    let delta = &delta[..dim];
    let change = if dim == 1 {
        0.5 * delta[0] * delta[0] * a[0] + delta[0] * residual[0]
    } else {
        let product = (0..dim).fold(0.0, |s, j| s + delta[j] * dot_slice(&a[j * dim..(j + 1) * dim], delta));
        0.5 * product + dot_slice(delta, &residual[..dim])
    };
    if change > RISE {
        force.copy_from_slice(&old[..dim]);
        return 0.0;
    }
    change
}

/// Scales tangential forces onto the friction ellipsoid of a normal force; into it when `inside` is enough.
pub(super) fn project_ellipsoid(tangential: &mut [f64], normal: f64, mu: &[f64], inside: bool) {
    let s = tangential.iter().zip(mu).fold(0.0, |s, (f, mu)| s + f * f / (mu * mu));
    let limit = normal * normal;
    if !inside || s > limit {
        let scale = (limit / s.max(MINVAL)).sqrt();
        tangential.iter_mut().for_each(|f| *f *= scale);
    }
}

/// Sets `efc_state` of the listed rows from their forces; returns the statistics of the sweep that made them.
pub(super) fn update_states(
    efc: &mut Constraints,
    contacts: &[Contact],
    rows: &[i32],
    improvement: f64,
) -> SolverStat {
    let mut stat = SolverStat { improvement, ..SolverStat::default() };
    let mut note = |old: &mut i32, state: ConstraintState| {
        stat.nactive += i32::from(state != ConstraintState::Satisfied);
        stat.nchange += i32::from(*old != state.code());
        *old = state.code();
    };
    let mut at = 0;
    while at < rows.len() {
        let i = rows[at] as usize;
        at += 1;
        if let Some(contact) = elliptic(efc, contacts, i) {
            let (state, dim) = (cone_state(efc, contact, i), contact.dim as usize);
            efc.efc_state[i..i + dim].iter_mut().for_each(|old| note(old, state));
            at += dim - 1;
        } else {
            let state = scalar_state(efc, i);
            note(&mut efc.efc_state[i], state);
        }
    }
    stat
}

#[inline]
fn scalar_state(efc: &Constraints, i: usize) -> ConstraintState {
    let (force, loss) = (efc.efc_force[i], efc.efc_frictionloss[i]);
    if i < efc.ne {
        ConstraintState::Quadratic
    } else if i < efc.ne + efc.nf {
        if force <= -loss {
            ConstraintState::Linearpos
        } else if force >= loss {
            ConstraintState::Linearneg
        } else {
            ConstraintState::Quadratic
        }
    } else if force <= 0.0 {
        ConstraintState::Satisfied
    } else {
        ConstraintState::Quadratic
    }
}

fn cone_state(efc: &Constraints, contact: &Contact, i: usize) -> ConstraintState {
    let (dim, mu) = (contact.dim as usize, contact.mu);
    let mut tangential = [0.0; 5];
    for j in 1..dim {
        tangential[j - 1] = efc.efc_force[i + j] / contact.friction[j - 1];
    }
    let (n, t) = (efc.efc_force[i] / mu, norm_slice(&tangential[..dim - 1]));
    if mu * n >= t {
        ConstraintState::Satisfied
    } else if n + mu * t <= 0.0 {
        ConstraintState::Quadratic
    } else {
        ConstraintState::Cone
    }
}
