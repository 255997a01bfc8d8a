//! Strain of the cells of an interpolated flex: how far a cell is deformed along each of the modes that an equality
//! constraint holds, seen in a frame that turns with the cell.

use super::lattice::{Lattice, MAX_NODES, Patch};
use super::vertices;
use crate::math::{Quat, Vec3, quat_conj, quat_rotate, sub};
use crate::model::Model;
use crate::model::flex::Flex;
use crate::position::chain::{chain, com_offset, point_column};
use crate::stages::{Com, Kinematics};

/// Working memory, reused from cell to cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct StrainScratch {
    /// Displacements of the nodes.
    shift: Vec<f64>,
    /// Degrees of freedom that move the cell.
    dofs: Vec<i32>,
    /// Place in `dofs`, and velocity, of what moves each node, one node after the other.
    columns: Vec<(usize, Vec3)>,
    /// One past the last column of each node.
    ends: Vec<usize>,
    /// A row.
    values: Vec<f64>,
}

/// One constrained cell, or face of a shell.
pub(crate) struct StrainedCell<'a> {
    flex: Flex<'a>,
    patch: Patch,
    /// Vectors of the modes, one after the other.
    vectors: &'a [f64],
}

impl<'a> StrainedCell<'a> {
    /// The cell of equality constraint `eq`; `None` for a flex that has no lattice.
    pub fn new(m: &'a Model, eq: usize) -> Option<Self> {
        let flex = Flex { m, id: usize::try_from(m.eq_obj1id[eq]).ok()? };
        if !flex.is_interpolated() || flex.nodes().is_empty() {
            return None;
        }
        let (lattice, data) = (Lattice::new(flex), &m.eq_data[eq]);
        let [_, cy, cz] = m.flex_cellnum[flex.id].map(|n| n as usize);
        let [i, j, k] = [0, 1, 2].map(|axis| data[axis] as usize);
        let index = if lattice.is_shell { i } else { i * cy * cz + j * cz + k };
        let patch = lattice.patch(index);
        let size = 3 * patch.nodes().len();
        let first = usize::try_from(m.flex_stiffnessadr[flex.id]).ok()? + index * size * size;
        let numbers = m.flex_stiffness.get(first..first + size * size)?;
        Some(StrainedCell { flex, patch, vectors: numbers.get(1..1 + numbers[0] as usize * size)? })
    }

    /// Mean inverse weight of the bodies of its nodes.
    pub fn inverse_weight(&self) -> f64 {
        let m = self.flex.m;
        let weight = |&n: &usize| m.body_invweight0[self.flex.node_bodies()[n] as usize][0];
        let sum = self.patch.nodes().iter().map(weight).fold(0.0, |a, b| a + b);
        sum / self.patch.nodes().len() as f64
    }

    /// Calls `row(violation, dofs, jacobian)` for each mode.
    pub fn rows(
        &self,
        kin: &Kinematics,
        com: &Com,
        memory: &mut StrainScratch,
        mut row: impl FnMut(f64, &[i32], &[f64]),
    ) {
        let m = self.flex.m;
        let centred = m.flex_centered[self.flex.id];
        let nodes = self.flex.nodes();
        let mut points = [[0.0; 3]; MAX_NODES];
        for (point, &n) in points.iter_mut().zip(self.patch.nodes()) {
            let (body, local) = (self.flex.node_bodies()[n] as usize, m.flex_node[nodes.start + n]);
            *point = vertices::placed(kin, body, local, centred);
        }
        let points = &points[..self.patch.nodes().len()];
        let back = self.patch.inverse_rotation(points);
        memory.shift.clear();
        for (&n, &point) in self.patch.nodes().iter().zip(points) {
            memory.shift.extend(sub(quat_rotate(back, point), m.flex_node0[nodes.start + n]));
        }
        self.find_columns(com, points, memory);
        memory.values.resize(memory.dofs.len(), 0.0);
        for vector in self.vectors.chunks_exact(memory.shift.len()) {
            let mut violation = 0.0;
            vector.iter().zip(&memory.shift).for_each(|(v, s)| violation += v * s);
            project(vector, quat_conj(back), memory);
            row(violation, &memory.dofs, &memory.values);
        }
    }

    /// Finds the degrees of freedom that move the cell, and for each node those that move it.
    fn find_columns(&self, com: &Com, points: &[Vec3], memory: &mut StrainScratch) {
        let m = self.flex.m;
        let StrainScratch { dofs, columns, ends, .. } = memory;
        let body = |n: usize| self.flex.node_bodies()[n] as usize;
        dofs.clear();
        self.patch.nodes().iter().for_each(|&n| dofs.extend(chain(m, body(n)).map(|dof| dof as i32)));
        dofs.sort_unstable();
        dofs.dedup();
        columns.clear();
        ends.clear();
        for (&n, &point) in self.patch.nodes().iter().zip(points) {
            let offset = com_offset(m, com, body(n), point);
            columns.extend(chain(m, body(n)).map(|dof| {
                let at = dofs.binary_search(&(dof as i32)).unwrap_or(0);
                (at, point_column(com, dof, offset))
            }));
            ends.push(columns.len());
        }
    }
}

/// Jacobian of the deformation along a mode, whose vector is turned into the world.
fn project(vector: &[f64], forth: Quat, memory: &mut StrainScratch) {
    let StrainScratch { columns, ends, values, .. } = memory;
    values.fill(0.0);
    let mut first = 0;
    for (part, &end) in vector.as_chunks::<3>().0.iter().zip(ends.iter()) {
        let direction = quat_rotate(forth, *part);
        for (x, &share) in direction.iter().enumerate().filter(|(_, share)| **share != 0.0) {
            columns[first..end].iter().for_each(|&(at, column)| values[at] += share * column[x]);
        }
        first = end;
    }
}
