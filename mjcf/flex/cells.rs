//! Which cells of a lattice hold no part of a deformable body.

use std::collections::VecDeque;

/// Cells of equal size in a box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cells {
    /// Cells along each axis.
    pub count: [usize; 3],
    /// Least and greatest corner of the box.
    pub bounds: [[f64; 3]; 2],
}

impl Cells {
    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.count[1] + y) * self.count[2] + z
    }

    /// Cell along an axis that a coordinate falls into.
    fn along(&self, axis: usize, x: f64) -> usize {
        let (low, extent) = (self.bounds[0][axis], self.bounds[1][axis] - self.bounds[0][axis]);
        if extent <= 0.0 {
            return 0;
        }
        // Below zero and not a number become the first cell.
        let cell = ((x - low) / extent * self.count[axis] as f64) as usize;
        cell.min(self.count[axis] - 1)
    }

    fn each(&self, from: [usize; 3], to: [usize; 3], mut visit: impl FnMut([usize; 3])) {
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                (from[2]..=to[2]).for_each(|z| visit([x, y, z]));
            }
        }
    }

    /// Neighbours across a face.
    fn beside(&self, cell: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
        let count = self.count;
        (0..3).flat_map(move |axis| {
            let below = cell[axis].checked_sub(1);
            let above = Some(cell[axis] + 1).filter(|&c| c < count[axis]);
            [below, above].into_iter().flatten().map(move |c| {
                let mut neighbour = cell;
                neighbour[axis] = c;
                neighbour
            })
        })
    }
}

/// Whether each cell is empty: no box of an element reaches into it, and it is not inside of a surface.
pub(crate) fn empty(cells: &Cells, dim: usize, element: &[i32], point: &[f64]) -> Vec<bool> {
    let touched = touched(cells, dim, element, point);
    if dim != 2 {
        return touched.into_iter().map(|t| !t).collect();
    }
    outside(cells, &touched)
}

fn touched(cells: &Cells, dim: usize, element: &[i32], point: &[f64]) -> Vec<bool> {
    let mut touched = vec![false; cells.count.iter().product()];
    for corners in element.chunks_exact(dim + 1) {
        let (mut low, mut high) = ([1e30_f64; 3], [-1e30_f64; 3]);
        for &corner in corners {
            for (k, &x) in point[3 * corner as usize..].iter().take(3).enumerate() {
                (low[k], high[k]) = (low[k].min(x), high[k].max(x));
            }
        }
        let [from, to] = [low, high].map(|p| std::array::from_fn(|axis| cells.along(axis, p[axis])));
        cells.each(from, to, |cell| touched[cells.number(cell)] = true);
    }
    touched
}

/// Cells that are reached from the sides of the lattice without passing a touched one.
fn outside(cells: &Cells, touched: &[bool]) -> Vec<bool> {
    let mut outside = vec![false; touched.len()];
    let mut pending = VecDeque::new();
    let last = cells.count.map(|n| n - 1);
    cells.each([0; 3], last, |cell| {
        let on_side = (0..3).any(|k| cell[k] == 0 || cell[k] == last[k]);
        let number = cells.number(cell);
        if on_side && !touched[number] {
            outside[number] = true;
            pending.push_back(cell);
        }
    });
    while let Some(cell) = pending.pop_front() {
        for neighbour in cells.beside(cell) {
            let number = cells.number(neighbour);
            if !outside[number] && !touched[number] {
                outside[number] = true;
                pending.push_back(neighbour);
            }
        }
    }
    outside
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: [[f64; 3]; 2] = [[0.0; 3], [1.0; 3]];

    #[test]
    fn cells_behind_a_surface_are_not_empty() {
        // A tetrahedral surface around the middle of 5 cells an axis.
        let point: Vec<f64> = [[0.1, 0.1, 0.1], [0.9, 0.1, 0.1], [0.1, 0.9, 0.1], [0.1, 0.1, 0.9]].concat();
        let cells = Cells { count: [5; 3], bounds: UNIT };
        let element = [0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3];
        let empty = empty(&cells, 2, &element, &point);
        assert!(!empty[0] && empty.iter().all(|&e| !e), "the box of the last triangle fills the lattice");
        let open = super::empty(&cells, 2, &element[..9], &point);
        assert!(open[cells.number([4; 3])] && !open[0]);
    }

    #[test]
    fn boxes_without_extent_have_one_cell() {
        let cells = Cells { count: [3, 1, 1], bounds: [[0.0; 3], [1.0, 0.0, 0.0]] };
        let empty = empty(&cells, 1, &[0, 1], &[0.0, 0.0, 0.0, 0.3, 0.0, 0.0]);
        assert_eq!(empty, [false, true, true]);
    }
}
