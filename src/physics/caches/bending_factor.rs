//! Solutions with the constant factor of inertia and bending (`constants::bending_factor`), for the three coordinates of a
//! vertex together: bending couples the same coordinate of different vertices alone, so they share a pattern.

use crate::arrays::Arrays;
use crate::math::Vec3;
use std::ops::Range;

/// The factor `Lᵀ L` by vertices.
#[derive(Clone, Debug)]
pub(crate) struct BendingFactor {
    /// First degree of freedom of each vertex.
    dof: Vec<u32>,
    /// First entry of each vertex, and one past the last.
    start: Vec<usize>,
    /// First degree of freedom of the earlier vertices that entries are of.
    columns: Vec<u32>,
    diagonal: Vec<Vec3>,
    values: Values,
}

/// Entries of `L`.
#[derive(Clone, Debug)]
enum Values {
    /// The same for all three coordinates, as where bodies have one mass in every direction.
    Alike(Vec<f64>),
    Different(Vec<Vec3>),
}

impl BendingFactor {
    /// Takes the factor of a model.
    pub fn new(m: &Arrays) -> Self {
        let vertices = m.nefm0dof / 3;
        let row = |r: usize| {
            let start = m.efm0_L_rowadr[r] as usize;
            start..start + m.efm0_L_rownnz[r] as usize - 1
        };
        let (mut start, mut columns, mut diagonal) = (vec![0], Vec::new(), Vec::new());
        let mut values: Vec<Vec3> = Vec::new();
        for v in 0..vertices {
            let rows: [Range<usize>; 3] = [0, 1, 2].map(|axis| row(3 * v + axis));
            let ends = rows.each_ref().map(|row| m.efm0_L[row.end]);
            diagonal.push(ends);
            for k in 0..rows[0].len() {
                columns.push(m.efm0_dofid[m.efm0_L_colind[rows[0].start + k] as usize] as u32);
                values.push(rows.each_ref().map(|row| m.efm0_L[row.start + k]));
            }
            start.push(columns.len());
        }
        let alike = values.iter().all(|[x, y, z]| x == y && y == z);
        let values = if alike {
            Values::Alike(values.iter().map(|value| value[0]).collect())
        } else {
            Values::Different(values)
        };
        let dof = m.efm0_dofid.iter().step_by(3).map(|&dof| dof as u32).collect();
        BendingFactor { dof, start, columns, diagonal, values }
    }

    /// First degree of freedom of each vertex.
    pub fn dofs(&self) -> impl Iterator<Item = usize> {
        self.dof.iter().map(|&dof| dof as usize)
    }

    /// Solves `Lᵀ L x = x` in place.
    pub fn solve(&self, x: &mut [f64]) {
        match &self.values {
            Values::Alike(values) => self.solve_with(values, |&value| [value; 3], x),
            Values::Different(values) => self.solve_with(values, |&value| value, x),
        }
    }

    #[inline]
    fn solve_with<T>(&self, values: &[T], value: impl Fn(&T) -> Vec3, x: &mut [f64]) {
        let row = |v: usize| {
            let entries = self.start[v]..self.start[v + 1];
            (&self.columns[entries.clone()], &values[entries], self.dof[v] as usize, self.diagonal[v])
        };
        let triple = |first: u32| first as usize..first as usize + 3;
        for v in (0..self.dof.len()).rev() {
            let (columns, values, own, diagonal) = row(v);
            let solved: Vec3 = std::array::from_fn(|k| x[own + k] / diagonal[k]);
            x[own..own + 3].copy_from_slice(&solved);
            if solved == [0.0; 3] {
                continue;
            }
            for (&column, entry) in columns.iter().zip(values) {
                let (x, entry) = (&mut x[triple(column)], value(entry));
                (0..3).for_each(|k| x[k] -= entry[k] * solved[k]);
            }
        }
        for v in 0..self.dof.len() {
            let (columns, values, own, diagonal) = row(v);
            let ((columns, columns_left), (values, values_left)) =
                (columns.as_chunks::<4>(), values.as_chunks::<4>());
            // The order of additions of a product with a compressed row: four lanes, then the entries that remain.
            let mut lanes = [[0.0; 3]; 4];
            for (columns, values) in columns.iter().zip(values) {
                for (lane, (&column, entry)) in lanes.iter_mut().zip(columns.iter().zip(values)) {
                    let (x, entry) = (&x[triple(column)], value(entry));
                    (0..3).for_each(|k| lane[k] += entry[k] * x[k]);
                }
            }
            let [a, b, c, d] = lanes;
            let mut sum: Vec3 = std::array::from_fn(|k| (a[k] + c[k]) + (b[k] + d[k]));
            for (&column, entry) in columns_left.iter().zip(values_left) {
                let (x, entry) = (&x[triple(column)], value(entry));
                (0..3).for_each(|k| sum[k] += entry[k] * x[k]);
            }
            for k in 0..3 {
                x[own + k] = (x[own + k] - sum[k]) / diagonal[k];
            }
        }
    }
}
