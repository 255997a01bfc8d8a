//! Removal of slip after the main solver: Gauss-Seidel sweeps over friction forces without regularisation, normal
//! forces fixed (MuJoCo documentation, Computation, "Noslip solver").

use super::dual::{Dual, cost_change, elliptic, update_states};
use super::friction_force::friction_force;
use crate::math::dense::dot_slice;
use crate::model::bounds::MINVAL;
use crate::model::{ConstraintType, Model};
use crate::stages::{Constraints, Contact, SolverStat};

/// Improves the friction forces of the listed rows; returns the number of sweeps.
pub(super) fn noslip(
    m: &Model,
    dual: &Dual,
    efc: &mut Constraints,
    contacts: &[Contact],
    rows: &[i32],
    stats: &mut Vec<SolverStat>,
) -> i32 {
    let scale = 1.0 / (m.stat.meaninertia * m.nv.max(1) as f64);
    update_states(efc, contacts, rows, 0.0);
    let mut sweeps = 0;
    while sweeps < m.opt.noslip_iterations {
        let mut improvement = 0.0;
        if sweeps == 0 {
            for &i in rows {
                let force = efc.efc_force[i as usize];
                improvement += 0.5 * force * force * efc.efc_R[i as usize];
            }
        }
        let mut at = 0;
        while at < rows.len() {
            let i = rows[at] as usize;
            at += 1;
            if i < efc.ne {
                continue;
            }
            if i < efc.ne + efc.nf {
                improvement -= friction_loss(dual, efc, i);
            } else if efc.efc_type[i] == ConstraintType::ContactPyramidal.code() {
                let edges = 2 * (contacts[efc.efc_id[i] as usize].dim as usize - 1);
                for j in (i..i + edges).step_by(2) {
                    improvement -= opposite_edges(dual, efc, j);
                }
                at += edges - 1;
            } else if let Some(contact) = elliptic(efc, contacts, i) {
                improvement -= tangential(dual, efc, contact, i);
                at += contact.dim as usize - 1;
            }
        }
        improvement *= scale;
        stats.push(update_states(efc, contacts, rows, improvement));
        sweeps += 1;
        if improvement < m.opt.noslip_tolerance {
            break;
        }
    }
    sweeps
}

/// Best force within the friction loss; returns the change of cost.
#[inline]
fn friction_loss(dual: &Dual, efc: &mut Constraints, i: usize) -> f64 {
    let (slope, inverse) = (dual.slope(efc, i, true), dual.inverse_diagonal(efc, i, true));
    let (old, loss) = (efc.efc_force[i], efc.efc_frictionloss[i]);
    let free = old - slope * inverse;
    let force = if free < -loss {
        -loss
    } else if free > loss {
        loss
    } else {
        free
    };
    set_force(&mut efc.efc_force, i, force);
    let delta = force - old;
    0.5 * delta * delta / inverse + delta * slope
}

/// Best difference between the forces of two opposite pyramid edges, their sum fixed; returns the change of cost.
#[inline]
fn opposite_edges(dual: &Dual, efc: &mut Constraints, j: usize) -> f64 {
    let old = [efc.efc_force[j], efc.efc_force[j + 1]];
    if old == [0.0; 2] {
        return 0.0;
    }
    let residual = [dual.slope(efc, j, true), dual.slope(efc, j + 1, true)];
    let a = dual.pair(efc, j);
    let b = [residual[0] - dot_slice(&a[..2], &old), residual[1] - dot_slice(&a[2..4], &old)];
    let middle = 0.5 * (old[0] + old[1]);
    let (curvature, slope) = (a[0] + a[3] - a[1] - a[2], middle * (a[0] - a[3]) + b[0] - b[1]);
    let y = if curvature < MINVAL { 0.0 } else { -slope / curvature };
    let mut force = if y < -middle {
        [0.0, 2.0 * middle]
    } else if y > middle {
        [2.0 * middle, 0.0]
    } else {
        [middle + y, middle - y]
    };
    let change = cost_change(&a, &mut force, &old, &residual);
    set_force(&mut efc.efc_force, j, force[0]);
    set_force(&mut efc.efc_force, j + 1, force[1]);
    change
}

/// Sets one force by storing the four around it at once: the next product loads them so, and a load that meets a
/// shorter store waits for memory.
#[inline]
fn set_force(forces: &mut [f64], i: usize, force: f64) {
    const ALL: u64 = u64::MAX;
    const KEEP: [[u64; 4]; 4] =
        [[0, ALL, ALL, ALL], [ALL, 0, ALL, ALL], [ALL, ALL, 0, ALL], [ALL, ALL, ALL, 0]];
    match forces.as_chunks_mut::<4>().0.get_mut(i / 4) {
        Some(four) => {
            let (keep, bits) = (&KEEP[i % 4], force.to_bits());
            *four = std::array::from_fn(|k| f64::from_bits(four[k].to_bits() & keep[k] | bits & !keep[k]));
        }
        None => forces[i] = force,
    }
}

/// Best tangential forces of an elliptic contact; returns the change of cost.
fn tangential(dual: &Dual, efc: &mut Constraints, contact: &Contact, i: usize) -> f64 {
    let n = contact.dim as usize - 1;
    let residual = dual.residual(efc, i + 1, n, true);
    let a = dual.block(efc, i + 1, n, true);
    let (mut old, mut b) = ([0.0; 5], [0.0; 5]);
    old[..n].copy_from_slice(&efc.efc_force[i + 1..i + 1 + n]);
    for j in 0..n {
        b[j] = residual[j] - dot_slice(&a[j * n..(j + 1) * n], &old[..n]);
    }
    if efc.efc_force[i] < MINVAL {
        efc.efc_force[i + 1..i + 1 + n].fill(0.0);
    } else {
        friction_force(&mut efc.efc_force[i..i + 1 + n], &a, &b, &contact.friction);
    }
    cost_change(&a, &mut efc.efc_force[i + 1..i + 1 + n], &old[..n], &residual)
}
