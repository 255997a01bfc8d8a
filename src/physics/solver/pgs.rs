//! Projected Gauss-Seidel on the dual problem, rows visited in a shuffled order, with momentum and restarts
//! (MuJoCo documentation, Computation, "Algorithms", "PGS"; Nesterov 1983; O'Donoghue and Candès 2015).

use super::dual::{Dual, cost_change, elliptic, project_ellipsoid, update_states};
use super::friction_force::friction_force;
use crate::math::dense::dot_slice;
use crate::model::Model;
use crate::model::bounds::MINVAL;
use crate::stages::{Constraints, Contact, SolverStat};

/// Minimises the dual cost over the listed rows; returns the number of sweeps.
pub(super) fn pgs(
    m: &Model,
    dual: &mut Dual,
    efc: &mut Constraints,
    contacts: &[Contact],
    rows: &[i32],
    stats: &mut Vec<SolverStat>,
) -> i32 {
    let scale = 1.0 / (m.stat.meaninertia * m.nv.max(1) as f64);
    list_blocks(dual, efc, contacts, rows);
    gather(&mut dual.before, efc, rows);
    update_states(efc, contacts, rows, 0.0);
    let mut generator = Pcg32::new();
    let (mut sweeps, mut momentum) = (0, 0);
    while sweeps < m.opt.iterations {
        extrapolate(dual, efc, contacts, rows, if sweeps > 0 { momentum } else { 0 });
        generator.shuffle(&mut dual.blocks);
        let mut improvement = 0.0;
        for at in 0..dual.blocks.len() {
            let i = rows[dual.blocks[at]] as usize;
            improvement -= match elliptic(efc, contacts, i) {
                Some(contact) => update_cone(dual, efc, contact, i),
                None => update_scalar(dual, efc, i),
            };
        }
        improvement *= scale;
        stats.push(update_states(efc, contacts, rows, improvement));
        let restart = sweeps > 0 && opposes(dual, efc, rows);
        momentum = if restart { 0 } else { momentum + 1 };
        sweeps += 1;
        if improvement < m.opt.tolerance {
            break;
        }
    }
    sweeps
}

/// Starts of single rows and elliptic cones.
fn list_blocks(dual: &mut Dual, efc: &Constraints, contacts: &[Contact], rows: &[i32]) {
    dual.blocks.clear();
    let mut at = 0;
    while at < rows.len() {
        dual.blocks.push(at);
        at += elliptic(efc, contacts, rows[at] as usize).map_or(1, |c| c.dim as usize);
    }
}

fn gather(to: &mut Vec<f64>, efc: &Constraints, rows: &[i32]) {
    to.clear();
    to.extend(rows.iter().map(|&i| efc.efc_force[i as usize]));
}

/// Continues the last change of forces and projects the result; `count` sweeps since the last restart.
fn extrapolate(dual: &mut Dual, efc: &mut Constraints, contacts: &[Contact], rows: &[i32], count: i32) {
    let beta = f64::from(count - 1) / f64::from(count + 2);
    if beta > 0.0 {
        for (before, &i) in dual.before.iter_mut().zip(rows) {
            let force = &mut efc.efc_force[i as usize];
            let old = *force;
            *force += beta * (old - *before);
            *before = old;
        }
        project(efc, contacts, rows);
    } else {
        gather(&mut dual.before, efc, rows);
    }
    gather(&mut dual.extrapolated, efc, rows);
}

/// Puts forces back into their intervals and cones.
fn project(efc: &mut Constraints, contacts: &[Contact], rows: &[i32]) {
    let mut at = 0;
    while at < rows.len() {
        let i = rows[at] as usize;
        at += 1;
        if let Some(contact) = elliptic(efc, contacts, i) {
            let dim = contact.dim as usize;
            let (normal, tangential) = efc.efc_force[i..i + dim].split_at_mut(1);
            if normal[0] < 0.0 {
                normal[0] = 0.0;
                tangential.fill(0.0);
            } else {
                project_ellipsoid(tangential, normal[0], &contact.friction, true);
            }
            at += dim - 1;
        } else {
            efc.efc_force[i] = clamp(efc, i, efc.efc_force[i]);
        }
    }
}

/// Nearest admissible force of a row outside cones.
fn clamp(efc: &Constraints, i: usize, force: f64) -> f64 {
    let loss = efc.efc_frictionloss[i];
    if i < efc.ne {
        force
    } else if i < efc.ne + efc.nf {
        if force < -loss {
            -loss
        } else if force > loss {
            loss
        } else {
            force
        }
    } else if force < 0.0 {
        0.0
    } else {
        force
    }
}

/// Momentum points uphill: the sweep undid part of the extrapolation.
fn opposes(dual: &Dual, efc: &Constraints, rows: &[i32]) -> bool {
    let product = rows
        .iter()
        .zip(dual.extrapolated.iter().zip(&dual.before))
        .fold(0.0, |sum, (&i, (x, before))| sum + (efc.efc_force[i as usize] - x) * (x - before));
    product < 0.0
}

/// Best force of one row; returns the change of cost.
fn update_scalar(dual: &Dual, efc: &mut Constraints, i: usize) -> f64 {
    let (residual, inverse) = (dual.residual(efc, i, 1, false), dual.inverse_diagonal(efc, i, false));
    let old = efc.efc_force[i];
    efc.efc_force[i] = clamp(efc, i, old - residual[0] * inverse);
    cost_change(&[1.0 / inverse], &mut efc.efc_force[i..=i], &[old], &residual)
}

/// Moves the force of an elliptic contact along its ray, then its tangential part; returns the change of cost.
fn update_cone(dual: &Dual, efc: &mut Constraints, contact: &Contact, i: usize) -> f64 {
    let (dim, n) = (contact.dim as usize, contact.dim as usize - 1);
    let residual = dual.residual(efc, i, dim, false);
    let a = dual.block(efc, i, dim, false);
    let inverse = dual.inverse_diagonal(efc, i, false);
    let mut old = [0.0; 6];
    old[..dim].copy_from_slice(&efc.efc_force[i..i + dim]);
    let force = &mut efc.efc_force[i..i + dim];
    if force[0] < MINVAL {
        force[0] = (force[0] - residual[0] * inverse).max(0.0);
        force[1..].fill(0.0);
    } else {
        move_along_ray(force, &a[..dim * dim], &residual[..dim]);
    }
    let (mut b, mut tangential) = ([0.0; 5], [0.0; 25]);
    for j in 0..n {
        tangential[j * n..(j + 1) * n].copy_from_slice(&a[(j + 1) * dim + 1..(j + 2) * dim]);
        b[j] = residual[j + 1] - dot_slice(&tangential[j * n..(j + 1) * n], &old[1..dim]);
        b[j] += a[(j + 1) * dim] * (force[0] - old[0]);
    }
    if force[0] < MINVAL {
        force[1..].fill(0.0);
    } else {
        friction_force(force, &tangential, &b, &contact.friction);
    }
    cost_change(&a, force, &old[..dim], &residual)
}

/// Scales a contact force to the best length, normal part not negative.
fn move_along_ray(force: &mut [f64], a: &[f64], residual: &[f64]) {
    let dim = force.len();
    let mut product = [0.0; 6];
    for j in 0..dim {
        product[j] = dot_slice(&a[j * dim..(j + 1) * dim], force);
    }
    let curvature = dot_slice(force, &product[..dim]);
    if curvature >= MINVAL {
        let best = -dot_slice(force, residual) / curvature;
        let x = if force[0] + best * force[0] < 0.0 { -1.0 } else { best };
        force.iter_mut().for_each(|f| *f += x * *f);
    }
}

/// The generator PCG32 (O'Neill 2014) with a fixed seed.
struct Pcg32 {
    state: u64,
}

impl Pcg32 {
    fn new() -> Self {
        let mut generator = Pcg32 { state: 0 };
        generator.next();
        generator
    }

    fn next(&mut self) -> u32 {
        let old = self.state;
        self.state = old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let mixed = (((old >> 18) ^ old) >> 27) as u32;
        mixed.rotate_right((old >> 59) as u32)
    }

    /// Fisher-Yates shuffle.
    fn shuffle(&mut self, items: &mut [usize]) {
        for i in (1..items.len()).rev() {
            items.swap(i, (self.next() % (i as u32 + 1)) as usize);
        }
    }
}
