//! The lattice of an interpolated flexcomp: a body a node, and which cells are worth one.

use super::masses::{AXES, Maker};
use super::pins;
use super::points::Points;
use crate::flex::cells::{self, Cells};
use crate::spec::{Body, Elastic2d, Flex, Flexcomp};

/// Shares of a cell's mass at its ends and its middle, by Simpson's rule.
const SIMPSON: [f64; 2] = [1.0 / 6.0, 2.0 / 3.0];

/// A lattice of nodes, the last axis fastest.
#[derive(Clone, Copy)]
struct Lattice {
    order: usize,
    cells: [usize; 3],
}

impl Lattice {
    /// Nodes along each axis.
    fn size(&self) -> [usize; 3] {
        self.cells.map(|c| c * self.order + 1)
    }

    fn nodes(self) -> impl Iterator<Item = [usize; 3]> {
        let [nx, ny, nz] = self.size();
        (0..nx).flat_map(move |i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])))
    }

    /// Cells along an axis that share place `i`, first and last.
    fn around(&self, axis: usize, i: usize) -> std::ops::RangeInclusive<usize> {
        let first = if i == 0 { 0 } else { (i - 1) / self.order };
        first..=(i / self.order).min(self.cells[axis] - 1)
    }

    /// Whether all cells around a node are empty.
    fn is_outside(&self, node: [usize; 3], empty: &[bool]) -> bool {
        let [_, cy, cz] = self.cells;
        let [x, y, z] = [0, 1, 2].map(|axis| self.around(axis, node[axis]));
        x.flat_map(|i| y.clone().map(move |j| (i, j)))
            .all(|(i, j)| z.clone().all(|k| empty[(i * cy + j) * cz + k]))
    }

    /// Whether the node is on the surface of the lattice.
    fn is_on_surface(&self, node: [usize; 3]) -> bool {
        let size = self.size();
        (0..3).any(|k| node[k] == 0 || node[k] + 1 == size[k])
    }

    /// Mass of a node before all masses are scaled so that they add up to the flexcomp's mass.
    fn weight(&self, node: [usize; 3]) -> f64 {
        if self.order == 1 {
            return 1.0;
        }
        let size = self.size();
        let shares = |k: usize| SIMPSON[node[k] % self.order];
        let between = |k: usize| node[k] > 0 && node[k] + 1 < size[k] && node[k].is_multiple_of(self.order);
        let mut weight = shares(0) * shares(1) * shares(2);
        for k in 0..3 {
            weight *= if between(k) { 2.0 } else { 1.0 };
        }
        weight
    }
}

/// Adds nodes to the flex and a body for each that moves.
pub(super) fn add_nodes(
    wanted: &Flexcomp,
    points: &Points,
    (maker, parent): (&Maker<'_>, &str),
    flex: &mut Flex,
    bodies: &mut Vec<Body>,
) {
    flex.order = wanted.dof.order();
    flex.cellcount = pins::cells(wanted);
    let lattice = Lattice { order: flex.order as usize, cells: flex.cellcount.map(|c| c as usize) };
    let mut pinned = points.pinned.clone();
    if flex.elastic2d == Elastic2d::None {
        let cells = Cells { count: lattice.cells, bounds: points.bounds };
        flex.empty_cells =
            cells::empty(&cells, points.cloud.dim as usize, &points.cloud.element, &points.cloud.point);
        mark(&mut pinned, lattice, |node| lattice.is_outside(node, &flex.empty_cells));
    } else {
        mark(&mut pinned, lattice, |node| !lattice.is_on_surface(node));
    }
    let [low, high] = points.bounds;
    let (mut moving, mut fixed) = (Vec::new(), Vec::new());
    for (number, node) in lattice.nodes().enumerate() {
        let pos: [f64; 3] = std::array::from_fn(|k| {
            let share = node[k] as f64 / (lattice.cells[k] * lattice.order) as f64;
            low[k] + share * (high[k] - low[k])
        });
        if pinned[number] {
            fixed.push(pos);
            flex.nodebody.push(parent.to_owned());
            continue;
        }
        fixed.push([0.0; 3]);
        let name = format!("{}_{}_{}_{}", flex.name, node[0], node[1], node[2]);
        moving.push(maker.body(name.clone(), pos, lattice.weight(node), &AXES));
        flex.nodebody.push(name);
    }
    scale_masses(&mut moving, wanted.mass);
    bodies.append(&mut moving);
    if !points.free || pinned[..fixed.len()].contains(&true) {
        flex.node = fixed.into_iter().flatten().collect();
    }
}

fn mark(pinned: &mut [bool], lattice: Lattice, fixed: impl Fn([usize; 3]) -> bool) {
    for (pinned, node) in pinned.iter_mut().zip(lattice.nodes()) {
        *pinned |= fixed(node);
    }
}

/// Makes the masses add up to `total`.
fn scale_masses(bodies: &mut [Body], total: f64) {
    let sum = bodies.iter().filter_map(|b| b.inertial.as_ref()).fold(0.0, |sum, i| sum + i.mass);
    if sum > 0.0 {
        let scale = total / sum;
        for inertial in bodies.iter_mut().filter_map(|b| b.inertial.as_mut()) {
            inertial.mass *= scale;
            inertial.inertia = inertial.inertia.map(|x| x * scale);
        }
    }
}

/// What the strain constraints of a flex name: cells, or elements of its surface.
pub(super) fn strained_cells(flex: &Flex) -> Vec<[f64; 3]> {
    let [cx, cy, cz] = flex.cellcount.map(|c| c as usize);
    if flex.order > 0 && flex.elastic2d != Elastic2d::None {
        let faces = 2 * (cy * cz + cx * cz + cx * cy);
        return (0..faces).map(|face| [face as f64, -1.0, -1.0]).collect();
    }
    let lattice = Lattice { order: 1, cells: [cx - 1, cy - 1, cz - 1] };
    let cells = lattice.nodes().enumerate();
    let full = cells.filter(|(number, _)| !flex.empty_cells.get(*number).is_some_and(|&empty| empty));
    full.map(|(_, cell)| cell.map(|c| c as f64)).collect()
}
