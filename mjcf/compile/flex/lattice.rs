//! Finite elements of an interpolated flex: the cells of its lattice, or the squares of the lattice's surface.

use crate::vector::{apply, dot, normalize, sub};
use physics::math::{Mat3, Vec3};

/// A lattice of nodes, the last axis fastest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    /// Nodes of a cell along an axis less one: 1 or 2.
    pub order: usize,
    /// Cells along each axis.
    pub cells: [usize; 3],
}

/// One finite element.
#[derive(Clone, Debug)]
pub(super) struct FiniteElement {
    /// Nodes, the last axis fastest.
    pub nodes: Vec<usize>,
    /// Axis across a square of the surface; `None` for cells.
    pub across: Option<usize>,
}

/// The squares of one side of the lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    /// Axis across.
    pub across: usize,
    /// Whether it is the one at the end of that axis.
    pub end: bool,
    /// Squares along the slower and the faster axis in the side.
    pub count: [usize; 2],
    /// Number of the first square.
    pub first: usize,
}

impl Side {
    /// The slower and the faster axis in the side.
    pub fn along(&self) -> [usize; 2] {
        [(self.across + 1) % 3, (self.across + 2) % 3]
    }
}

impl Lattice {
    /// Nodes along each axis.
    pub fn size(&self) -> [usize; 3] {
        self.cells.map(|c| c * self.order + 1)
    }

    fn node(&self, [x, y, z]: [usize; 3]) -> usize {
        let [_, ny, nz] = self.size();
        (x * ny + y) * nz + z
    }

    /// The sides: at the beginning and the end of each axis.
    pub fn sides(&self) -> [Side; 6] {
        let [cx, cy, cz] = self.cells;
        let counts = [[cy, cz], [cz, cx], [cx, cy]];
        let mut first = 0;
        std::array::from_fn(|f| {
            let (across, count) = (f / 2, counts[f / 2]);
            let side = Side { across, end: f % 2 == 1, count, first };
            first += count[0] * count[1];
            side
        })
    }

    /// Nodes of square `at` of a side.
    pub fn square(&self, side: &Side, at: [usize; 2]) -> Vec<usize> {
        let [slow, fast] = side.along();
        let mut nodes = Vec::with_capacity((self.order + 1).pow(2));
        for i in 0..=self.order {
            for j in 0..=self.order {
                let mut place = [0; 3];
                place[side.across] = if side.end { self.cells[side.across] * self.order } else { 0 };
                (place[slow], place[fast]) = (at[0] * self.order + i, at[1] * self.order + j);
                nodes.push(self.node(place));
            }
        }
        nodes
    }

    /// Nodes of a cell.
    pub fn cell(&self, cell: [usize; 3]) -> Vec<usize> {
        let mut nodes = Vec::with_capacity((self.order + 1).pow(3));
        for i in 0..=self.order {
            for j in 0..=self.order {
                for k in 0..=self.order {
                    nodes.push(self.node([0, 1, 2].map(|axis| cell[axis] * self.order + [i, j, k][axis])));
                }
            }
        }
        nodes
    }

    /// All cells, the last axis fastest.
    pub fn each_cell(self) -> impl Iterator<Item = [usize; 3]> {
        let [cx, cy, cz] = self.cells;
        (0..cx).flat_map(move |i| (0..cy).flat_map(move |j| (0..cz).map(move |k| [i, j, k])))
    }

    /// The finite elements of the volume (`None` where a cell is empty) or of the surface.
    pub fn elements(&self, surface: bool, empty: &[bool]) -> Vec<Option<FiniteElement>> {
        if !surface {
            let of = |(number, cell)| match empty.get(number) {
                Some(true) => None,
                _ => Some(FiniteElement { nodes: self.cell(cell), across: None }),
            };
            return self.each_cell().enumerate().map(of).collect();
        }
        let squares = self.sides().into_iter().flat_map(|side| {
            (0..side.count[0]).flat_map(move |i| (0..side.count[1]).map(move |j| (side, [i, j])))
        });
        squares
            .map(|(side, at)| {
                Some(FiniteElement { nodes: self.square(&side, at), across: Some(side.across) })
            })
            .collect()
    }

    /// The rotation that turns the lattice into the axes it was made along, from the first cell that is not empty.
    ///
    /// # Errors
    /// The cells are not boxes.
    pub(super) fn rotation(&self, empty: &[bool], node: &[Vec3]) -> Result<Mat3, String> {
        let full = self.each_cell().enumerate().find(|(number, _)| empty.get(*number) != Some(&true));
        let corner = full.map_or([0; 3], |(_, cell)| cell.map(|c| c * self.order));
        let mut rotation = [0.0; 9];
        for axis in 0..3 {
            let mut next = corner;
            next[axis] += self.order;
            let mut edge = sub(node[self.node(next)], node[self.node(corner)]);
            normalize(&mut edge);
            rotation[3 * axis..3 * axis + 3].copy_from_slice(&edge);
        }
        let row = |k: usize| [rotation[3 * k], rotation[3 * k + 1], rotation[3 * k + 2]];
        for a in 0..3 {
            for b in a..3 {
                let expected = if a == b { 1.0 } else { 0.0 };
                let off = (dot(row(a), row(b)) - expected).abs();
                if off.is_nan() || off > 1e-8 {
                    return Err(
                        "the nodes are not the corners of equal boxes: put them on a regular lattice".into(),
                    );
                }
            }
        }
        Ok(rotation)
    }
}

/// Points in the axes of a lattice.
pub(super) fn turned(rotation: &Mat3, points: &[Vec3]) -> Vec<Vec3> {
    points.iter().map(|&p| apply(rotation, p)).collect()
}

/// Basis function `i` of an axis and its slope at `s`.
pub(super) fn basis(s: f64, i: usize, order: usize) -> [f64; 2] {
    match (order, i) {
        (1, 0) => [1.0 - s, -1.0],
        (1, _) => [s, 1.0],
        (_, 0) => [2.0 * s * s - 3.0 * s + 1.0, 4.0 * s - 3.0],
        (_, 1) => [4.0 * (s - s * s), 4.0 * (1.0 - 2.0 * s)],
        _ => [2.0 * s * s - s, 4.0 * s - 1.0],
    }
}

/// Points and weights of the integration along an axis of an element. Those of three points are as MuJoCo has them, two of
/// them outside of the element.
pub(super) fn quadrature(order: usize) -> Vec<[f64; 2]> {
    match order {
        1 => vec![[-0.5 / 3.0_f64.sqrt() + 0.5, 0.5], [0.5 / 3.0_f64.sqrt() + 0.5, 0.5]],
        _ => {
            let (reach, outer) = (0.5 / 0.6_f64.sqrt(), 5.0 / 9.0 * 0.5);
            vec![[0.5, 8.0 / 9.0 * 0.5], [-reach + 0.5, outer], [reach + 0.5, outer]]
        }
    }
}
