//! Lattices of nodes: the nodes of an interpolated flex fill a box of cells, on whose edges they lie (order 1) or also in
//! the middle between (order 2). Of a shell only the faces of the box count; nodes inside follow from them.

use super::rotation::rotation_of;
use crate::math::{Mat3, Quat, Vec3, add_scaled, cross, quat_conj};
use crate::model::flex::Flex;

/// Nodes of a cell, at most.
pub(crate) const MAX_NODES: usize = 27;

/// The lattice of one flex.
#[derive(Clone, Copy)]
pub(crate) struct Lattice {
    cells: [usize; 3],
    pub order: usize,
    /// Nodes along each axis.
    pub size: [usize; 3],
    pub is_shell: bool,
}

/// Polynomial `i` of an order, which is one at its own node of \[0, 1\] and zero at the others.
pub(super) fn shape(x: f64, i: usize, order: usize) -> f64 {
    match (order, i) {
        (1, 0) => 1.0 - x,
        (1, _) => x,
        (_, 0) => 2.0 * x * x - 3.0 * x + 1.0,
        (_, 1) => 4.0 * (x - x * x),
        _ => 2.0 * x * x - x,
    }
}

/// Derivative of [`shape`].
pub(super) fn slope(x: f64, i: usize, order: usize) -> f64 {
    match (order, i) {
        (1, 0) => -1.0,
        (1, _) => 1.0,
        (_, 0) => 4.0 * x - 3.0,
        (_, 1) => 4.0 * (1.0 - 2.0 * x),
        _ => 4.0 * x - 1.0,
    }
}

/// A point of a lattice: nodes of its cell, and their weights.
pub(crate) struct Place {
    nodes: [usize; MAX_NODES],
    weights: [f64; MAX_NODES],
    count: usize,
}

impl Place {
    pub fn weights(&self) -> impl Iterator<Item = (usize, f64)> {
        self.nodes.into_iter().zip(self.weights).take(self.count)
    }
}

/// A cell of a lattice, or a face of a cell at the surface of a shell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    nodes: [usize; MAX_NODES],
    count: usize,
    order: usize,
    /// Axes of a face: two along it, and the normal.
    face: Option<[usize; 3]>,
}

impl Lattice {
    pub fn new(flex: Flex) -> Self {
        let (interp, cells) = (flex.m.flex_interp[flex.id], flex.m.flex_cellnum[flex.id]);
        let order = interp.unsigned_abs() as usize;
        let cells = cells.map(|n| n.max(1) as usize);
        Lattice { cells, order, size: cells.map(|n| n * order + 1), is_shell: interp < 0 }
    }

    fn node(&self, [i, j, k]: [usize; 3]) -> usize {
        let [_, ny, nz] = self.size;
        i * ny * nz + j * nz + k
    }

    /// Nodes and weights of a point with coordinates in \[0, 1\].
    pub fn locate(&self, point: Vec3) -> Place {
        let mut cell = [0; 3];
        let mut along = [[0.0; 3]; 3];
        for axis in 0..3 {
            let (n, x) = (self.cells[axis], point[axis] * self.cells[axis] as f64);
            let index = (x.floor() as i64).clamp(0, n as i64 - 1);
            cell[axis] = index as usize;
            let local = (x - index as f64).clamp(0.0, 1.0);
            (0..=self.order).for_each(|i| along[axis][i] = shape(local, i, self.order));
        }
        let mut place = Place { nodes: [0; MAX_NODES], weights: [0.0; MAX_NODES], count: 0 };
        for i in 0..=self.order {
            for j in 0..=self.order {
                let outer = along[0][i] * along[1][j];
                for k in 0..=self.order {
                    let at = [i, j, k];
                    place.nodes[place.count] =
                        self.node([0, 1, 2].map(|axis| cell[axis] * self.order + at[axis]));
                    place.weights[place.count] = outer * along[2][k];
                    place.count += 1;
                }
            }
        }
        place
    }

    /// True for a node of a shell that has no mass of its own.
    pub fn is_inside(&self, node: usize) -> bool {
        let at = self.coordinates(node);
        self.is_shell && (0..3).all(|axis| at[axis] > 0 && at[axis] + 1 < self.size[axis])
    }

    /// Indices of a node along the axes.
    pub fn coordinates(&self, node: usize) -> [usize; 3] {
        let [_, ny, nz] = self.size;
        [node / nz / ny, node / nz % ny, node % nz]
    }

    /// Number of cells, or of faces of a shell.
    pub fn patches(&self) -> usize {
        if self.is_shell { self.faces().into_iter().sum() } else { self.cells.into_iter().product() }
    }

    /// Faces of cells on each side of the box.
    fn faces(&self) -> [usize; 6] {
        let [x, y, z] = self.cells;
        [y * z, y * z, x * z, x * z, x * y, x * y]
    }

    /// Cell or face number `index`.
    pub fn patch(&self, index: usize) -> Patch {
        if self.is_shell { self.face(index) } else { self.cell(index) }
    }

    fn cell(&self, index: usize) -> Patch {
        let [_, cy, cz] = self.cells;
        let (corner, order) = ([index / (cy * cz), index / cz % cy, index % cz], self.order);
        let mut patch = Patch { nodes: [0; MAX_NODES], count: 0, order, face: None };
        for i in 0..=order {
            for j in 0..=order {
                for k in 0..=order {
                    let [x, y, z] = corner;
                    patch.push(self.node([x * order + i, y * order + j, z * order + k]));
                }
            }
        }
        patch
    }

    fn face(&self, index: usize) -> Patch {
        let (mut side, mut rest) = (0, index);
        for (s, count) in self.faces().into_iter().enumerate() {
            side = s;
            if rest < count || s == 5 {
                break;
            }
            rest -= count;
        }
        let (normal, order) = (side / 2, self.order);
        let (slow, fast) = ((normal + 1) % 3, (normal + 2) % 3);
        let across = self.cells[fast];
        let mut at = [0; 3];
        at[normal] = if side % 2 == 0 { 0 } else { self.cells[normal] * order };
        let mut patch = Patch { nodes: [0; MAX_NODES], count: 0, order, face: Some([slow, fast, normal]) };
        for i in 0..=order {
            for j in 0..=order {
                at[slow] = rest / across * order + i;
                at[fast] = rest % across * order + j;
                patch.push(self.node(at));
            }
        }
        patch
    }
}

impl Patch {
    fn push(&mut self, node: usize) {
        self.nodes[self.count] = node;
        self.count += 1;
    }

    /// Its nodes.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes[..self.count]
    }

    /// Rotation from its orientation to that at rest; `points` are the positions of its nodes.
    pub fn inverse_rotation(&self, points: &[Vec3]) -> Quat {
        let mat = match self.face {
            Some(axes) => self.face_gradient(points, axes),
            None => self.gradient(points),
        };
        quat_conj(rotation_of(&mat))
    }

    /// Deformation gradient in the middle of a cell.
    fn gradient(&self, points: &[Vec3]) -> Mat3 {
        let order = self.order;
        let (value, rise) = (|i| shape(0.5, i, order), |i| slope(0.5, i, order));
        let mut mat = [0.0; 9];
        let side = order + 1;
        for (n, point) in points.iter().enumerate() {
            let (i, j, k) = (n / side / side, n / side % side, n % side);
            let along =
                [rise(i) * value(j) * value(k), value(i) * rise(j) * value(k), value(i) * value(j) * rise(k)];
            for (entry, sum) in mat.iter_mut().enumerate() {
                *sum += point[entry / 3] * along[entry % 3];
            }
        }
        mat
    }

    /// Deformation gradient in the middle of a face: tangents and normal as columns.
    fn face_gradient(&self, points: &[Vec3], axes: [usize; 3]) -> Mat3 {
        let tangents = self.tangents(points, [0.5, 0.5]);
        let columns = [tangents[0], tangents[1], cross(tangents[0], tangents[1])];
        let mut mat = [0.0; 9];
        for (axis, column) in axes.into_iter().zip(columns) {
            (0..3).for_each(|row| mat[3 * row + axis] = column[row]);
        }
        mat
    }

    /// Derivatives of the shape functions of a face at a point of it, by node.
    pub fn face_slopes(&self, local: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let order = self.order;
        (0..self.count).map(move |n| {
            let (i, j) = (n / (order + 1), n % (order + 1));
            [
                slope(local[0], i, order) * shape(local[1], j, order),
                shape(local[0], i, order) * slope(local[1], j, order),
            ]
        })
    }

    /// Tangents of a face at a point of it.
    pub fn tangents(&self, points: &[Vec3], local: [f64; 2]) -> [Vec3; 2] {
        let mut tangents = [[0.0; 3]; 2];
        for (point, slopes) in points.iter().zip(self.face_slopes(local)) {
            for (tangent, slope) in tangents.iter_mut().zip(slopes) {
                (0..3).for_each(|x| tangent[x] += point[x] * slope);
            }
        }
        tangents
    }
}

/// A node on the surface of a box that helps to place one inside, and factors of its weight.
struct Support {
    node: [usize; 3],
    factors: [f64; 3],
}

/// Nodes that a node inside follows by transfinite interpolation: on the faces, in pairs, then on the edges, which count
/// against, then the corners.
fn supports(size: [usize; 3], at: [usize; 3]) -> ([Support; 6], [Support; 12], [Support; 8]) {
    let last = size.map(|n| n - 1);
    let share = |axis: usize, side: usize| {
        let s = at[axis] as f64 / last[axis] as f64;
        if side == 0 { 1.0 - s } else { s }
    };
    let end = |axis: usize, side: usize| if side == 0 { 0 } else { last[axis] };
    let faces = std::array::from_fn(|k| {
        let (axis, side) = (k / 2, k % 2);
        let mut node = at;
        node[axis] = end(axis, side);
        Support { node, factors: [share(axis, side), 1.0, 1.0] }
    });
    let edges = std::array::from_fn(|k| {
        let (along, sides) = (k / 4, [k / 2 % 2, k % 2]);
        let [a, b] = [[1, 2], [0, 2], [0, 1]][along];
        let mut node = at;
        node[a] = end(a, sides[0]);
        node[b] = end(b, sides[1]);
        Support { node, factors: [share(a, sides[0]), share(b, sides[1]), 1.0] }
    });
    let corners = std::array::from_fn(|k| {
        let sides = [k / 4, k / 2 % 2, k % 2];
        Support {
            node: [0, 1, 2].map(|axis| end(axis, sides[axis])),
            factors: [0, 1, 2].map(|axis| share(axis, sides[axis])),
        }
    });
    (faces, edges, corners)
}

fn index([_, ny, nz]: [usize; 3], [i, j, k]: [usize; 3]) -> usize {
    i * ny * nz + j * nz + k
}

/// Places the nodes inside a box from those on its surface.
pub(super) fn track_interior(size: [usize; 3], points: &mut [Vec3]) {
    if size.iter().any(|&n| n < 3) {
        return;
    }
    for i in 1..size[0] - 1 {
        for j in 1..size[1] - 1 {
            for k in 1..size[2] - 1 {
                let (faces, edges, corners) = supports(size, [i, j, k]);
                let value = |support: &Support| points[index(size, support.node)];
                let weight = |support: &Support| support.factors[0] * support.factors[1] * support.factors[2];
                let mut sum = [0.0; 3];
                for [low, high] in faces.as_chunks::<2>().0 {
                    let (a, b) = (value(low), value(high));
                    (0..3).for_each(|x| sum[x] += weight(low) * a[x] + weight(high) * b[x]);
                }
                for support in &edges {
                    sum = add_scaled(sum, value(support), -weight(support));
                }
                for support in &corners {
                    sum = add_scaled(sum, value(support), weight(support));
                }
                points[index(size, [i, j, k])] = sum;
            }
        }
    }
}

/// Calls `add(node, weight)` for the nodes on the surface that share the weight of a node inside.
pub(super) fn share_interior(lattice: &Lattice, node: usize, weight: f64, mut add: impl FnMut(usize, f64)) {
    let (faces, edges, corners) = supports(lattice.size, lattice.coordinates(node));
    let mut give = |support: &Support, sign: f64| {
        let [a, b, c] = support.factors;
        add(lattice.node(support.node), sign * weight * a * b * c);
    };
    faces.iter().for_each(|support| give(support, 1.0));
    edges.iter().for_each(|support| give(support, -1.0));
    corners.iter().for_each(|support| give(support, 1.0));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::distance;
    use crate::model::{Arrays, Model};

    fn model(interp: i32, cells: [i32; 3]) -> Model {
        let mut m = Arrays { nflex: 1, ..Arrays::default() };
        m.allocate();
        (m.flex_interp[0], m.flex_cellnum[0]) = (interp, cells);
        Model::unchecked(m)
    }

    /// Nodes of a lattice in the unit box.
    fn nodes(lattice: &Lattice) -> Vec<Vec3> {
        let count = lattice.size.into_iter().product();
        let place = |n| {
            let at = lattice.coordinates(n);
            [0, 1, 2].map(|axis| at[axis] as f64 / (lattice.size[axis] - 1) as f64)
        };
        (0..count).map(place).collect()
    }

    #[test]
    fn interpolation_gives_back_every_point() {
        for order in [1, 2] {
            let m = model(order, [2, 1, 3]);
            let lattice = Lattice::new(Flex { m: &m, id: 0 });
            let nodes = nodes(&lattice);
            for point in [[0.0; 3], [1.0; 3], [0.3, 0.7, 0.9], [0.5, 1.0, 0.34]] {
                let sum = lattice
                    .locate(point)
                    .weights()
                    .fold([0.0; 3], |sum, (node, weight)| add_scaled(sum, nodes[node], weight));
                assert!(distance(sum, point) < 1e-15, "{sum:?}");
            }
        }
    }

    #[test]
    fn nodes_inside_a_shell_follow_its_surface() {
        let m = model(-1, [3, 3, 4]);
        let lattice = Lattice::new(Flex { m: &m, id: 0 });
        let expected = nodes(&lattice);
        let mut points = expected.clone();
        for (n, point) in points.iter_mut().enumerate().filter(|(n, _)| lattice.is_inside(*n)) {
            *point = [7.0; 3];
            let mut sum = [0.0; 3];
            let mut total = 0.0;
            share_interior(&lattice, n, 2.0, |node, weight| {
                assert!(!lattice.is_inside(node));
                sum = add_scaled(sum, expected[node], weight);
                total += weight;
            });
            assert!((total - 2.0).abs() < 1e-14);
            assert!(distance(sum, expected[n].map(|x| 2.0 * x)) < 1e-14);
        }
        track_interior(lattice.size, &mut points);
        for (found, expected) in points.iter().zip(expected) {
            assert!(distance(*found, expected) < 1e-15);
        }
    }

    #[test]
    fn cells_turn_with_their_nodes() {
        let turn = crate::math::quat_from_axis_angle([0.6, 0.0, 0.8], 0.7);
        for (interp, cells) in [(1, [2, 1, 3]), (2, [1, 1, 2]), (-1, [2, 2, 2]), (-2, [1, 2, 1])] {
            let m = model(interp, cells);
            let lattice = Lattice::new(Flex { m: &m, id: 0 });
            let nodes = nodes(&lattice);
            for patch in (0..lattice.patches()).map(|k| lattice.patch(k)) {
                let turned: Vec<Vec3> =
                    patch.nodes().iter().map(|&n| crate::math::quat_rotate(turn, nodes[n])).collect();
                let back = patch.inverse_rotation(&turned);
                for (&n, &point) in patch.nodes().iter().zip(&turned) {
                    assert!(distance(crate::math::quat_rotate(back, point), nodes[n]) < 1e-8);
                }
            }
        }
    }
}
