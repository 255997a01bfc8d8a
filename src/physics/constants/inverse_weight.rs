//! Inverse inertia at `qpos0` as bodies, degrees of freedom, tendons and actuators see it (documentation:
//! Computation, "Constraint model", diagonal approximation).
//!
//! A row `r` in joint space has the inverse weight `r · M⁻¹ · r`. `M` couples only what hangs in one tree, so each
//! row is solved within the trees that it touches.

use super::{flex_pattern, flex_reference};
use crate::data::{Com, Data, Inertia, Kinematics};
use crate::inertia;
use crate::math::dense::{dot_slice, norm_slice};
use crate::math::rotational;
use crate::model::bounds::MINVAL;
use crate::model::{JointType, Model};
use crate::position::chain::{chain, com_offset, point_column};
use crate::{actuation::transmission, position::tendon};
use std::ops::Range;

/// Sets `body_invweight0`, `dof_invweight0`, `flexedge_invweight0`, `tendon_invweight0` and `actuator_acc0`.
pub(crate) fn set_inverse_weights(m: &mut Model, d: &Data) {
    let mut rows = Rows { row: vec![0.0; m.nv], solution: vec![0.0; m.nv] };
    let bodies = body_weights(m, &d.kin, &d.com, &d.inertia, &mut rows);
    let dofs = dof_weights(m, &d.inertia, &mut rows);
    let tendons = tendon_weights(m, d, &mut rows);
    let edges = edge_weights(m, d, &mut rows);
    let actuators = actuator_accelerations(m, d, &mut rows);
    let arrays = m.derived_mut();
    arrays.body_invweight0.update(&bodies);
    arrays.dof_invweight0.update(&dofs);
    arrays.flexedge_invweight0.update(&edges);
    arrays.tendon_invweight0.update(&tendons);
    arrays.actuator_acc0.update(&actuators);
}

/// A row and `M⁻¹` times it; both all zero between uses.
struct Rows {
    row: Vec<f64>,
    solution: Vec<f64>,
}

impl Rows {
    /// The value of `measure` for the row with these entries and its solution.
    fn solved(
        &mut self,
        m: &Model,
        inertia: &Inertia,
        entries: impl Iterator<Item = (usize, f64)>,
        measure: impl Fn(&[f64], &[f64]) -> f64,
    ) -> f64 {
        let (mut first, mut last) = (usize::MAX, 0);
        for (dof, value) in entries {
            self.row[dof] = value;
            (first, last) = (first.min(dof), last.max(dof));
        }
        if first == usize::MAX {
            return 0.0;
        }
        let dofs = whole_trees(m, first, last);
        self.solution[dofs.clone()].copy_from_slice(&self.row[dofs.clone()]);
        inertia::solve_within(m, inertia, dofs.clone(), &mut self.solution);
        // Sums run in four lanes: they stay the same bits when the part begins and ends with a group of four.
        let part = dofs.start / 4 * 4..dofs.end.next_multiple_of(4).min(m.nv);
        let measured = measure(&self.row[part.clone()], &self.solution[part]);
        self.row[dofs.clone()].fill(0.0);
        self.solution[dofs].fill(0.0);
        measured
    }

    fn inverse_weight(
        &mut self,
        m: &Model,
        inertia: &Inertia,
        entries: impl Iterator<Item = (usize, f64)>,
    ) -> f64 {
        self.solved(m, inertia, entries, dot_slice)
    }
}

/// The degrees of freedom of all trees from the tree of `first` to the tree of `last`.
fn whole_trees(m: &Model, first: usize, last: usize) -> Range<usize> {
    let [first, last] = [first, last].map(|dof| m.dof_treeid[dof] as usize);
    m.tree_dofadr[first] as usize..(m.tree_dofadr[last] + m.tree_dofnum[last]) as usize
}

/// Mean inverse inertia of each body's centre of mass, translational and rotational.
fn body_weights(m: &Model, kin: &Kinematics, com: &Com, inertia: &Inertia, rows: &mut Rows) -> Vec<[f64; 2]> {
    let mut weights = vec![[0.0; 2]; m.nbody];
    for b in 1..m.nbody {
        if m.body_dofnum[m.body_weldid[b] as usize] == 0 {
            continue;
        }
        if m.body_simple[b] == 2 {
            weights[b] = [1.0 / m.body_mass[b].max(MINVAL), 0.0];
            continue;
        }
        let offset = com_offset(m, com, b, kin.xipos[b]);
        let translation = |dof: usize| point_column(com, dof, offset);
        let rotation = |dof: usize| rotational(&com.cdof[dof]);
        let mut axis = |column: &dyn Fn(usize) -> [f64; 3], k: usize| {
            rows.inverse_weight(m, inertia, chain(m, b).map(|dof| (dof, column(dof)[k])))
        };
        let mut mean =
            |column: &dyn Fn(usize) -> [f64; 3]| (axis(column, 0) + axis(column, 1) + axis(column, 2)) / 3.0;
        weights[b] = [mean(&translation), mean(&rotation)];
    }
    weights
}

fn dof_weights(m: &Model, inertia: &Inertia, rows: &mut Rows) -> Vec<f64> {
    let mut weights = vec![0.0; m.nv];
    for j in 0..m.njnt {
        let (body, first) = (m.jnt_bodyid[j] as usize, m.jnt_dofadr[j] as usize);
        if m.body_simple[body] == 2 {
            weights[first] = 1.0 / m.body_mass[body].max(MINVAL);
            continue;
        }
        let mut weight = |dof: usize| rows.inverse_weight(m, inertia, std::iter::once((dof, 1.0)));
        let mut mean = |dof: usize| (weight(dof) + weight(dof + 1) + weight(dof + 2)) / 3.0;
        match JointType::from_code(m.jnt_type[j]) {
            Some(JointType::Free) => {
                let (linear, angular) = (mean(first), mean(first + 3));
                weights[first..first + 3].fill(linear);
                weights[first + 3..first + 6].fill(angular);
            }
            Some(JointType::Ball) => {
                let angular = mean(first);
                weights[first..first + 3].fill(angular);
            }
            _ => weights[first] = weight(first),
        }
    }
    weights
}

/// Inverse weights of edges of flexes; those within one body have none.
fn edge_weights(m: &Model, d: &Data, rows: &mut Rows) -> Vec<f64> {
    let mut weights = vec![0.0; m.nflexedge];
    for (f, e) in flex_reference::measured(m).filter(|&(_, e)| !m.flexedge_rigid[e]) {
        let bodies = flex_pattern::ends(m, f, e).map(|v| m.flex_vertbodyid[v] as usize);
        weights[e] = if bodies.iter().all(|&b| m.body_simple[b] == 2) {
            (1.0 / m.body_mass[bodies[0]] + 1.0 / m.body_mass[bodies[1]]) / 2.0
        } else {
            let row = flex_reference::length_row(m, &d.kin, &d.com, f, e);
            rows.inverse_weight(m, &d.inertia, row.into_iter())
        };
    }
    weights
}

fn tendon_weights(m: &Model, d: &Data, rows: &mut Rows) -> Vec<f64> {
    let entries = |i| tendon::row(m, i).map(|k| (m.ten_J_colind[k] as usize, d.ten.ten_J[k]));
    (0..m.ntendon).map(|i| rows.inverse_weight(m, &d.inertia, entries(i))).collect()
}

/// Acceleration that a unit of force gives each actuator output.
fn actuator_accelerations(m: &Model, d: &Data, rows: &mut Rows) -> Vec<f64> {
    let norm = |out| rows.solved(m, &d.inertia, transmission::moment(&d.trn, out), |_, x| norm_slice(x));
    (0..m.nout).map(norm).collect()
}
