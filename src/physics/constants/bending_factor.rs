//! The constant factor of inertia and bending: `Lᵀ L = M + (dt² + dt d) K` over the degrees of freedom of vertices that
//! move freely, where `K` is the bending stiffness of sheets and `d` their damping. Implicit integration of flexes
//! preconditions with it.
//!
//! Bending couples only the same coordinate of different vertices. So the pattern is the vertices' pattern, three times
//! interleaved. Rows are found from the last to the first.

use super::flex_pattern::{bending_vertices, edges};
use crate::model::bounds::MINVAL;
use crate::model::{Arrays, Model};
use std::collections::{BTreeMap, BTreeSet};

/// Numbers of an edge in `flex_bending`.
const STENCIL: usize = 17;

/// Rows of the factor by vertex.
struct Slots {
    /// First degree of freedom of each slot.
    dof: Vec<usize>,
    /// Slot of each vertex of all flexes.
    of_vertex: BTreeMap<usize, usize>,
}

/// The corners around edge `e` of flex `f` as slots, and its stencil; `None` at the border.
fn stencil<'a>(m: &'a Arrays, slots: &Slots, f: usize, e: usize) -> Option<([Option<usize>; 4], &'a [f64])> {
    let ([a, b], [c, d]) = (m.flex_edge[e], m.flex_edgeflap[e]);
    if d < 0 {
        return None;
    }
    let first = m.flex_vertadr[f] as usize;
    let corners = [a, b, c, d].map(|v| slots.of_vertex.get(&(first + v as usize)).copied());
    let local = e - m.flex_edgeadr[f] as usize;
    let numbers = m.flex_bending.get(m.flex_bendingadr[f] as usize + STENCIL * local..)?;
    Some((corners, numbers.get(..STENCIL)?))
}

impl Slots {
    fn of(m: &Arrays) -> Self {
        let mut slots = Slots { dof: Vec::new(), of_vertex: BTreeMap::new() };
        for (_, v) in bending_vertices(m) {
            slots.of_vertex.insert(v, slots.dof.len());
            slots.dof.push(m.body_dofadr[m.flex_vertbodyid[v] as usize] as usize);
        }
        slots
    }
}

/// Flexes with rows in the factor.
fn bending_flexes(m: &Arrays) -> BTreeSet<usize> {
    bending_vertices(m).into_iter().map(|(f, _)| f).collect()
}

/// The pattern of the factor over slots.
struct Pattern {
    /// Earlier slots that each row has entries in, increasing, itself last.
    columns: Vec<Vec<usize>>,
    /// Later rows with an entry in each column, in the order in which they are subtracted.
    later: Vec<Vec<usize>>,
}

impl Pattern {
    /// Follows the elimination from the last row to the first.
    fn of(m: &Arrays, slots: &Slots) -> Self {
        let n = slots.dof.len();
        let mut above = vec![BTreeSet::new(); n];
        for f in bending_flexes(m) {
            for (corners, _) in edges(m, f).filter_map(|e| stencil(m, slots, f, e)) {
                for a in corners.into_iter().flatten() {
                    above[a].extend(corners.into_iter().flatten().filter(|&b| b > a));
                }
            }
        }
        let (mut parent, mut visited) = (vec![usize::MAX; n], vec![usize::MAX; n]);
        let mut pattern = Pattern { columns: vec![Vec::new(); n], later: vec![Vec::new(); n] };
        for r in (0..n).rev() {
            visited[r] = r;
            for &start in &above[r] {
                let mut row = start;
                while visited[row] != r {
                    visited[row] = r;
                    pattern.later[r].push(row);
                    pattern.columns[row].push(r);
                    if parent[row] == usize::MAX {
                        parent[row] = r;
                    }
                    row = parent[row];
                }
            }
        }
        for (r, columns) in pattern.columns.iter_mut().enumerate() {
            columns.reverse();
            columns.push(r);
        }
        pattern
    }
}

/// Rows of the factor as the model keeps them: three for each slot, one for each axis.
struct Layout {
    dofs: Vec<i32>,
    counts: Vec<i32>,
    starts: Vec<i32>,
    columns: Vec<i32>,
}

impl Layout {
    fn new(pattern: &Pattern, slots: &Slots) -> Self {
        let mut layout =
            Layout { dofs: Vec::new(), counts: Vec::new(), starts: Vec::new(), columns: Vec::new() };
        for (&dof, row) in slots.dof.iter().zip(&pattern.columns) {
            for axis in 0..3 {
                layout.dofs.push((dof + axis) as i32);
                layout.starts.push(layout.columns.len() as i32);
                layout.counts.push(row.len() as i32);
                layout.columns.extend(row.iter().map(|&c| (3 * c + axis) as i32));
            }
        }
        layout
    }
}

/// True when the rows of the factor in `m`, whose sizes are right, are those that follow from its sheets.
pub(crate) fn is_laid_out(m: &Arrays) -> bool {
    let slots = Slots::of(m);
    let Layout { dofs, counts, starts, columns } = Layout::new(&Pattern::of(m, &slots), &slots);
    *m.efm0_dofid == dofs
        && *m.efm0_L_rownnz == counts
        && *m.efm0_L_rowadr == starts
        && *m.efm0_L_colind == columns
}

/// Sets `nefm0dof` and `nefm0L`.
pub fn set_sizes(m: &mut Arrays) {
    let slots = Slots::of(m);
    let pattern = Pattern::of(m, &slots);
    m.nefm0dof = 3 * slots.dof.len();
    m.nefm0L = 3 * pattern.columns.iter().map(Vec::len).sum::<usize>();
}

/// Computes the factor; false when the matrix has none, as with negative stiffness.
pub(crate) fn set(m: &mut Model) -> bool {
    if m.nefm0dof == 0 {
        return true;
    }
    let slots = Slots::of(m);
    let pattern = Pattern::of(m, &slots);
    let (lower, layout) = (stiffness(m, &slots), Layout::new(&pattern, &slots));
    let mut values = vec![0.0; layout.columns.len()];
    let mut complete = true;
    let mut dense = vec![0.0; slots.dof.len()];
    for axis in 0..3 {
        for r in (0..slots.dof.len()).rev() {
            let own = |row: usize| layout.starts[3 * row + axis] as usize;
            lower[r].iter().for_each(|(&c, &x)| dense[c] = x);
            let dof = slots.dof[r] + axis;
            let inertia = m.body_mass[m.dof_bodyid[dof] as usize] + m.dof_armature[dof];
            dense[r] = inertia + lower[r].get(&r).copied().unwrap_or(0.0);
            for &row in &pattern.later[r] {
                let entries = &values[own(row)..own(row) + pattern.columns[row].len()];
                let at = pattern.columns[row].binary_search(&r).unwrap_or(0);
                for (&c, &x) in pattern.columns[row][..=at].iter().zip(entries) {
                    dense[c] -= entries[at] * x;
                }
            }
            complete &= dense[r] >= MINVAL;
            let diagonal = dense[r].max(MINVAL).sqrt();
            let inverse = 1.0 / diagonal;
            let (last, before) = pattern.columns[r].split_last().unwrap_or((&r, &[]));
            for (k, &c) in before.iter().enumerate() {
                values[own(r) + k] = dense[c] * inverse;
            }
            values[own(r) + before.len()] = diagonal;
            before.iter().chain([last]).for_each(|&c| dense[c] = 0.0);
        }
    }
    let arrays = m.derived_mut();
    arrays.efm0_dofid.update(&layout.dofs);
    arrays.efm0_L_rownnz.update(&layout.counts);
    arrays.efm0_L_rowadr.update(&layout.starts);
    arrays.efm0_L_colind.update(&layout.columns);
    arrays.efm0_L.update(&values);
    m.forget_bending_factor();
    complete
}

/// Lower triangle of the bending stiffness by slot, as much as a time step takes of it.
fn stiffness(m: &Arrays, slots: &Slots) -> Vec<BTreeMap<usize, f64>> {
    let mut rows = vec![BTreeMap::new(); slots.dof.len()];
    let dt = m.opt.timestep;
    for f in bending_flexes(m) {
        let scale = dt * dt + dt * m.flex_damping[f];
        if scale == 0.0 {
            continue;
        }
        for (corners, numbers) in edges(m, f).filter_map(|e| stencil(m, slots, f, e)) {
            for (i, a) in corners.into_iter().enumerate() {
                for (j, b) in corners.into_iter().enumerate() {
                    let share = scale * numbers[4 * i + j];
                    if let (Some(a), Some(b), true) = (a, b, share != 0.0)
                        && b <= a
                    {
                        *rows[a].entry(b).or_insert(0.0) += share;
                    }
                }
            }
        }
    }
    rows
}
