//! Points of a flexcomp that are fixed to the parent body.

use super::points::Points;
use crate::diagnostic::Loc;
use crate::flex::Shape;
use crate::spec::{Dof, Flexcomp, Pin};

/// Marks pinned points, and decides whether all or none are.
pub(super) fn pin(wanted: &Flexcomp, points: &mut Points) -> Result<(), (Loc, String)> {
    let n = points.cloud.point.len() / 3;
    let nodes = if wanted.rigid { 0 } else { nodes(wanted) };
    points.pinned = vec![wanted.rigid; n.max(nodes)];
    let grid = Grid { wanted, dim: points.cloud.dim as usize };
    for pin in &wanted.pins {
        grid.check(pin).map_err(|message| (pin.loc, message))?;
    }
    if wanted.rigid {
        return Ok(());
    }
    for pin in &wanted.pins {
        let marked = numbers(pin, n).and_then(|mut marked| {
            marked.extend(grid.places(pin)?);
            Ok(marked)
        });
        for place in marked.map_err(|message| (pin.loc, message))? {
            let Some(pinned) = points.pinned.get_mut(place) else {
                let message = format!("a pin is at point {place}, and there are {}", points.pinned.len());
                return Err((pin.loc, message));
            };
            *pinned = true;
        }
    }
    if wanted.dof == Dof::Radial {
        points.pinned[0] = true;
    }
    points.rigid = points.pinned[..n].iter().all(|&p| p);
    points.free = !points.pinned[..n].iter().any(|&p| p);
    Ok(())
}

/// Nodes of the lattice.
pub(super) fn nodes(wanted: &Flexcomp) -> usize {
    let order = wanted.dof.order() as usize;
    match order {
        0 => 0,
        _ => cells(wanted).iter().fold(1, |n: usize, &c| n.saturating_mul(c as usize * order + 1)),
    }
}

/// Cells of the lattice along each axis.
pub(super) fn cells(wanted: &Flexcomp) -> [i32; 3] {
    if wanted.cellcount[0] >= 0 { wanted.cellcount } else { wanted.flex.cellcount }
}

/// Points by number, out of `n`.
fn numbers(pin: &Pin, n: usize) -> Result<Vec<usize>, String> {
    let inside = |p: i32| usize::try_from(p).ok().filter(|&p| p < n);
    let known = |p: i32| inside(p).ok_or_else(|| format!("point {p} does not exist: there are {n}"));
    let mut marked: Vec<usize> = pin.id.iter().map(|&p| known(p)).collect::<Result<_, _>>()?;
    for ends in pin.range.as_chunks::<2>().0 {
        marked.extend(known(ends[0])?..=known(ends[1])?);
    }
    Ok(marked)
}

/// Places of the grid, or of the lattice.
struct Grid<'a> {
    wanted: &'a Flexcomp,
    dim: usize,
}

impl Grid<'_> {
    fn check(&self, pin: &Pin) -> Result<(), String> {
        let wanted = self.wanted;
        let multiple = |list: &[i32], of: usize, what: &str| match list.len().is_multiple_of(of) {
            true => Ok(()),
            false => Err(format!("'{what}' has {} numbers, not a multiple of {of}", list.len())),
        };
        multiple(&pin.range, 2, "range")?;
        multiple(&pin.grid, self.dim, "grid")?;
        multiple(&pin.gridrange, 2 * self.dim, "gridrange")?;
        let placed = !(pin.grid.is_empty() && pin.gridrange.is_empty());
        if placed && wanted.shape != Shape::Grid && wanted.dof.order() == 0 {
            return Err(
                "'grid' and 'gridrange' are for grids and interpolated flexes: use 'id' or 'range'".into()
            );
        }
        if placed && self.dim == 1 {
            return Err("pins of lines are given by 'id' and 'range', not by places of a grid".into());
        }
        Ok(())
    }

    fn places(&self, pin: &Pin) -> Result<Vec<usize>, String> {
        let points = self.wanted.count;
        // The lattice of what is no grid has the nodes of one cell.
        let nodes = match self.wanted.shape {
            Shape::Grid => points,
            _ => [self.wanted.dof.order() + 1; 3],
        };
        let mut marked = Vec::new();
        for at in pin.grid.chunks_exact(self.dim) {
            marked.push(self.number(self.inside(at, nodes)?));
        }
        for ends in pin.gridrange.chunks_exact(2 * self.dim) {
            let (from, to) =
                (self.inside(&ends[..self.dim], points)?, self.inside(&ends[self.dim..], points)?);
            for x in from[0]..=to[0] {
                for y in from[1]..=to[1] {
                    marked.extend((from[2]..=to[2]).map(|z| self.number([x, y, z])));
                }
            }
        }
        Ok(marked)
    }

    /// The place at these numbers, the missing ones zero.
    fn inside(&self, at: &[i32], count: [i32; 3]) -> Result<[usize; 3], String> {
        let mut place = [0; 3];
        for (k, &i) in at.iter().enumerate() {
            if !(0..count[k]).contains(&i) {
                return Err(format!("place {i} is outside of the {} along axis {k}", count[k]));
            }
            place[k] = i as usize;
        }
        Ok(place)
    }

    /// Number of a place, by the counts of the grid.
    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        let [_, ny, nz] = self.wanted.count.map(|n| n as usize);
        if self.dim == 2 { x * ny + y } else { (x * ny + y) * nz + z }
    }
}
