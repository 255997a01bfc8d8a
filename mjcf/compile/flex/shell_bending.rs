//! Bending between the squares of a lattice's surface: for each pair that shares an edge, the two squares, the middle of the
//! edge in either, stiffness, and the difference of the normals at rest.

use super::elasticity::Material;
use super::lattice::{Lattice, Side, basis};
use crate::vector::{cross, normalize};
use physics::math::Vec3;

/// Numbers of a pair.
const PER_PAIR: usize = 10;

/// A square and the middle of one of its edges in it.
#[derive(Clone, Copy)]
struct Half {
    side: usize,
    at: [usize; 2],
    middle: [f64; 2],
}

/// The lattice's surface at rest.
struct Surface<'a> {
    lattice: Lattice,
    sides: [Side; 6],
    node: &'a [Vec3],
}

/// The number of pairs, then the pairs. `node` has the positions of all nodes, along the axes of the lattice.
pub(super) fn bending(lattice: Lattice, node: &[Vec3], material: Material, thickness: f64) -> Vec<f64> {
    let Material { young, poisson } = material;
    let plate = young * thickness * thickness * thickness / (12.0 * (1.0 - poisson * poisson));
    let surface = Surface { lattice, sides: lattice.sides(), node };
    let pairs = surface.pairs();
    let mut numbers = vec![pairs.len() as f64];
    for pair in &pairs {
        numbers.extend(surface.pair(pair, plate));
    }
    numbers
}

impl Surface<'_> {
    fn number(&self, half: &Half) -> usize {
        let side = &self.sides[half.side];
        side.first + half.at[0] * side.count[1] + half.at[1]
    }

    /// Each edge once, from the square with the lower number.
    fn pairs(&self) -> Vec<[Half; 2]> {
        let mut pairs = Vec::new();
        for (side, of) in self.sides.iter().enumerate() {
            for i in 0..of.count[0] {
                for j in 0..of.count[1] {
                    for direction in 0..2 {
                        for ahead in [false, true] {
                            let pair = self.across(side, [i, j], direction, ahead);
                            if self.number(&pair[0]) < self.number(&pair[1]) {
                                pairs.push(pair);
                            }
                        }
                    }
                }
            }
        }
        pairs
    }

    /// Square `at` of a side, and its neighbour along axis `direction` of the side.
    fn across(&self, side: usize, at: [usize; 2], direction: usize, ahead: bool) -> [Half; 2] {
        let of = &self.sides[side];
        let edge = |end: bool| {
            let mut middle = [0.5; 2];
            middle[direction] = if end { 1.0 } else { 0.0 };
            middle
        };
        let own = Half { side, at, middle: edge(ahead) };
        let last = of.count[direction] - 1;
        if at[direction] != if ahead { last } else { 0 } {
            let mut next = at;
            next[direction] = if ahead { at[direction] + 1 } else { at[direction] - 1 };
            return [own, Half { side, at: next, middle: edge(!ahead) }];
        }
        // Over the edge of the lattice: the axis along it stays, the other runs across this side.
        let axis = of.along()[direction];
        let boundary = if of.end { self.lattice.cells[of.across] - 1 } else { 0 };
        let (mut next, mut middle) = ([at[1 - direction]; 2], [0.5; 2]);
        next[1 - direction] = boundary;
        middle[1 - direction] = if of.end { 1.0 } else { 0.0 };
        [own, Half { side: 2 * axis + usize::from(ahead), at: next, middle }]
    }

    fn pair(&self, pair: &[Half; 2], plate: f64) -> [f64; PER_PAIR] {
        let frames = pair.map(|half| self.frame(&half));
        let mut numbers = [0.0; PER_PAIR];
        let normals = frames.map(|[normal, ..]| {
            let mut normal = normal;
            (normalize(&mut normal), normal)
        });
        if normals.iter().any(|(length, _)| *length < 1e-12) {
            return numbers;
        }
        // Lengths along and across the edge, of either square.
        let lengths: [[f64; 2]; 2] = std::array::from_fn(|k| {
            let [_, mut first, mut second] = frames[k];
            let (first, second) = (normalize(&mut first), normalize(&mut second));
            if pair[k].middle[0] == 0.5 { [first, second] } else { [second, first] }
        });
        let [along, across] = [0, 1].map(|k| (lengths[0][k] + lengths[1][k]) / 2.0);
        numbers[0] = self.number(&pair[0]) as f64;
        numbers[1] = self.number(&pair[1]) as f64;
        numbers[2..4].copy_from_slice(&pair[0].middle);
        numbers[4..6].copy_from_slice(&pair[1].middle);
        numbers[6] = plate * along / across.max(1e-12);
        (0..3).for_each(|k| numbers[7 + k] = normals[0].1[k] - normals[1].1[k]);
        numbers
    }

    /// Normal and tangents at the middle of the edge, not of unit length.
    fn frame(&self, half: &Half) -> [Vec3; 3] {
        let order = self.lattice.order;
        let nodes = self.lattice.square(&self.sides[half.side], half.at);
        let (mut first, mut second) = ([0.0; 3], [0.0; 3]);
        for (number, &node) in nodes.iter().enumerate() {
            let a = basis(half.middle[0], number / (order + 1), order);
            let b = basis(half.middle[1], number % (order + 1), order);
            for k in 0..3 {
                first[k] += self.node[node][k] * (a[1] * b[0]);
                second[k] += self.node[node][k] * (a[0] * b[1]);
            }
        }
        [cross(first, second), first, second]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_edge_of_a_box_of_squares_is_there_once() {
        let lattice = Lattice { order: 1, cells: [2, 3, 1] };
        let [nx, ny, nz] = lattice.size();
        let node: Vec<Vec3> =
            (0..nx * ny * nz).map(|p| [p / (ny * nz), p / nz % ny, p % nz].map(|i| i as f64)).collect();
        let material = Material { young: 1.0, poisson: 0.0 };
        let numbers = bending(lattice, &node, material, 1.0);
        // A closed surface of squares has two edges a square.
        let squares = 2 * (2 * 3 + 3 + 2);
        assert_eq!(numbers[0] as usize, 2 * squares);
        assert_eq!(numbers.len(), 1 + PER_PAIR * 2 * squares);
        assert!(numbers[1..].as_chunks::<PER_PAIR>().0.iter().all(|pair| pair[6] == 1.0 / 12.0));
    }
}
