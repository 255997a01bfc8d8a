//! The texels of a shadow map that points ask for, and which of them lie behind casters.
//!
//! They are sorted into the cells of a grid whose columns hold as many as each other, and so its rows, since pictures ask for
//! many texels near what they show and for few elsewhere. A triangle is compared with those in the cells that it touches.

use super::rule::CasterRule;
use crate::raster::layer::Reached;
use crate::raster::window::coverage::{Boxed, Edges, Plane, Region, Target};
use crate::raster::window::projection::Projection;
use crate::raster::window::vertices::Vertex;
use std::ops::Range;
use wide::f32x8;

/// A point that a lamp may reach.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Which picture asks. Questions of one picture follow each other.
    pub view: u32,
    /// What the picture calls it.
    pub name: u32,
    /// Where it is, world frame \[m\].
    pub position: [f32; 3],
}

/// The texels that points ask for.
#[derive(Clone, Debug, Default)]
pub struct Texels {
    asked: Vec<Lookup>,
    /// Whether the lamp reaches each point.
    reached: Vec<bool>,
    /// What is asked for, cell by cell.
    pub sorted: Sorted,
    /// Where it is.
    pub grid: Grid,
}

/// A point's texel.
#[derive(Clone, Copy, Debug, Default)]
struct Lookup {
    x: u16,
    y: u16,
    /// Depth of the point.
    depth: f32,
    /// The point that asks.
    asked: u32,
    /// Its cell of the grid.
    cell: u32,
}

/// Lookups by column, followed by seven that ask for nothing, so that eight can be read from each.
#[derive(Clone, Debug, Default)]
pub struct Sorted {
    /// Middle of the texel \[texel\].
    x: Vec<f32>,
    y: Vec<f32>,
    /// Depth of the fragment; -1 in shadow.
    depth: Vec<f32>,
    asked: Vec<u32>,
}

/// Lookups read together.
const LANES: usize = 8;
/// Depth of what lies in shadow: nothing is nearer.
const SHADED: f32 = -1.0;

/// Where the points of at most eight questions are; lanes without one say nothing.
#[inline]
fn positions(questions: &[Question]) -> [f32x8; 3] {
    let at = |k: usize| questions.get(k).map_or([0.0; 3], |question| question.position);
    let points: [[f32; 3]; LANES] = std::array::from_fn(at);
    std::array::from_fn(|axis| f32x8::new(points.map(|point| point[axis])))
}

/// A grid over the box of the texels that are asked for.
#[derive(Clone, Debug)]
pub struct Grid {
    /// The box of the texels.
    pub region: Region,
    /// Largest depth of a point.
    pub deepest: f32,
    /// Cells of every row.
    across: usize,
    /// The grid's columns and rows, indexed by the map's columns and rows from the first of the region on.
    columns: Vec<u16>,
    rows: Vec<u16>,
    /// How many ask for the texels of each column and row of the map.
    counts: [Vec<u32>; 2],
    /// Row by row, and one more.
    cells: Vec<Cell>,
}

/// A cell of the grid.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// Its first texel among the sorted.
    first: u32,
    /// Largest depth of a point in it.
    deepest: f32,
}

/// Lookups that a cell holds in the mean.
const SHARE: usize = 2;
/// Fewest and most cells along a side of the grid.
const CELLS: [usize; 2] = [16, 512];
/// Lookups that are compared without a look at the depth of their cells.
const FEW: usize = 16;

impl Default for Grid {
    fn default() -> Self {
        let region = Region { low: [0; 2], high: [0; 2] };
        Grid {
            region,
            deepest: 0.0,
            across: 0,
            columns: Vec::new(),
            rows: Vec::new(),
            counts: [Vec::new(), Vec::new()],
            cells: Vec::new(),
        }
    }
}

impl Texels {
    /// Asks for the texel of every point in a map of `size` texels a side; those outside the map are lit.
    pub fn ask(&mut self, map: &Projection, size: usize, questions: &[Question]) {
        let Texels { asked, reached, sorted, grid } = self;
        asked.clear();
        reached.clear();
        grid.clear(size);
        let rows = map.0.map(|row| row.map(|x| f32x8::splat(x as f32)));
        let last = f32x8::splat(size as f32 - 1.0);
        for (chunk, first) in questions.chunks(LANES).zip((0..).step_by(LANES)) {
            let [x, y, z] = positions(chunk);
            let [s, t, r, q] = rows.map(|[a, b, c, d]| a * x + b * y + c * z + d);
            let scale = f32x8::ONE / q;
            let (x, y) = ((s * scale).floor(), (t * scale).floor());
            // The outermost texels are never drawn: what falls on or beyond them is lit.
            let inside = q.simd_gt(f32x8::ZERO)
                & x.simd_ge(f32x8::ONE)
                & y.simd_ge(f32x8::ONE)
                & x.simd_lt(last)
                & y.simd_lt(last);
            let inside = inside.to_bitmask();
            let depth = r * scale;
            let depth = depth.simd_lt(f32x8::ZERO).select(f32x8::ZERO, depth);
            let depth = depth.simd_gt(f32x8::ONE).select(f32x8::ONE, depth).to_array();
            let [x, y] = [x, y].map(|texel| texel.fast_trunc_int().to_array());
            for lane in 0..chunk.len() {
                let inside = inside >> lane & 1 != 0;
                reached.push(!inside);
                if inside {
                    let (x, y, depth) = (x[lane] as u16, y[lane] as u16, depth[lane]);
                    grid.count(x, y, depth);
                    asked.push(Lookup { x, y, depth, asked: first + lane as u32, cell: 0 });
                }
            }
        }
        sorted.resize(asked.len());
        if !asked.is_empty() {
            grid.divide(asked.len());
            grid.sort(asked, sorted);
        }
    }

    /// Whether a texel is asked for.
    pub fn any(&self) -> bool {
        !self.asked.is_empty()
    }

    /// Keeps the questions of the points that the lamp reaches.
    pub fn keep_reached(&mut self, questions: &mut Vec<Question>) {
        for (&depth, &asked) in self.sorted.depth.iter().zip(&self.sorted.asked).take(self.asked.len()) {
            self.reached[asked as usize] |= depth >= 0.0;
        }
        let mut reached = self.reached.iter();
        questions.retain(|_| reached.next() == Some(&true));
    }
}

impl Sorted {
    fn resize(&mut self, count: usize) {
        let length = if count == 0 { 0 } else { count + LANES - 1 };
        self.x.resize(length, 0.0);
        self.y.resize(length, 0.0);
        self.depth.resize(length, SHADED);
        self.asked.resize(length, 0);
        self.depth[count.min(length)..].fill(SHADED);
    }

    fn set(&mut self, at: usize, lookup: &Lookup) {
        (self.x[at], self.y[at]) = (f32::from(lookup.x) + 0.5, f32::from(lookup.y) + 0.5);
        (self.depth[at], self.asked[at]) = (lookup.depth, lookup.asked);
    }

    /// Puts those among a range that lie behind a caster in its shadow, and maybe some after it.
    #[inline]
    fn shade(&mut self, range: Range<usize>, caster: &Caster<'_>) {
        let middle = |x: i32| f32x8::splat(x as f32 + 0.5);
        let Boxed { columns: (left, right), rows: (bottom, top) } = caster.boxed;
        let (left, right, bottom, top) = (middle(left), middle(right), middle(bottom), middle(top));
        let (plane, offset) = (&caster.plane, f32x8::splat(caster.offset));
        // Found once a texel behind the caster is; none where it has no side that casts.
        let mut edges: Option<Option<Edges>> = None;
        let texel = |x: f32| 256 * (x as i32) + 128;
        for start in range.step_by(LANES) {
            let lanes = start..start + LANES;
            let read = |column: &[f32]| column[lanes.clone()].try_into().map_or(f32x8::ZERO, f32x8::new);
            let (x, y, depth) = (read(&self.x), read(&self.y), read(&self.depth));
            let behind = (plane.depths(x, y) + offset).simd_lt(depth);
            let boxed = x.simd_ge(left) & x.simd_le(right) & y.simd_ge(bottom) & y.simd_le(top);
            let mut behind = (behind & boxed).to_bitmask();
            while behind != 0 {
                let at = start + behind.trailing_zeros() as usize;
                behind &= behind - 1;
                let edges = edges.get_or_insert_with(|| caster.target.edges(caster.corners));
                let covered = edges.is_some_and(|edges| edges.contain(texel(self.x[at]), texel(self.y[at])));
                if covered && caster.questions.contains(&self.asked[at]) {
                    self.depth[at] = SHADED;
                }
            }
        }
    }
}

impl Grid {
    /// Forgets what was asked for of the last map; the next one has `size` texels a side.
    fn clear(&mut self, size: usize) {
        self.deepest = 0.0;
        for counts in &mut self.counts {
            counts.clear();
            counts.resize(size, 0);
        }
    }

    /// Counts a texel that is asked for.
    #[inline]
    fn count(&mut self, x: u16, y: u16, depth: f32) {
        self.counts[0][usize::from(x)] += 1;
        self.counts[1][usize::from(y)] += 1;
        self.deepest = self.deepest.max(depth);
    }

    /// Lays the grid over the `asked` texels that have been counted.
    fn divide(&mut self, asked: usize) {
        self.across = (asked / SHARE).isqrt().clamp(CELLS[0], CELLS[1]);
        let sides = [(&mut self.columns, 0), (&mut self.rows, 1)];
        for (table, axis) in sides {
            let counts = &self.counts[axis];
            let low = counts.iter().position(|&count| count > 0).unwrap_or(0);
            let high = counts.iter().rposition(|&count| count > 0).unwrap_or(0);
            (self.region.low[axis], self.region.high[axis]) = (low as i32, high as i32);
            table.clear();
            let mut before = 0;
            table.extend(counts[low..=high].iter().map(|&count| {
                let cell = before * self.across / asked;
                before += count as usize;
                cell as u16
            }));
        }
    }

    /// Sorts what is asked for into the cells.
    fn sort(&mut self, asked: &mut [Lookup], sorted: &mut Sorted) {
        let mut cells = std::mem::take(&mut self.cells);
        cells.clear();
        cells.resize(self.across * self.across + 1, Cell::default());
        let place = |lookup: &Lookup| self.row(lookup.y.into()) * self.across + self.column(lookup.x.into());
        for lookup in &mut *asked {
            let cell = place(lookup);
            lookup.cell = cell as u32;
            cells[cell + 1].first += 1;
            cells[cell].deepest = cells[cell].deepest.max(lookup.depth);
        }
        for i in 1..cells.len() {
            cells[i].first += cells[i - 1].first;
        }
        for lookup in asked {
            let at = &mut cells[lookup.cell as usize].first;
            sorted.set(*at as usize, lookup);
            *at += 1;
        }
        // Every cell's first has moved to its end, which is the next one's first.
        for i in (1..cells.len()).rev() {
            cells[i].first = cells[i - 1].first;
        }
        cells[0].first = 0;
        self.cells = cells;
    }

    #[inline]
    fn column(&self, x: i32) -> usize {
        self.columns[(x - self.region.low[0]) as usize].into()
    }

    #[inline]
    fn row(&self, y: i32) -> usize {
        self.rows[(y - self.region.low[1]) as usize].into()
    }

    /// The first cell of each grid row between `rows`, and how many cells of it lie between `columns`.
    #[inline]
    fn lines(&self, columns: (i32, i32), rows: (i32, i32)) -> (impl Iterator<Item = usize> + use<>, usize) {
        let (first, last) = (self.column(columns.0), self.column(columns.1));
        let across = self.across;
        let lines = self.row(rows.0)..=self.row(rows.1);
        (lines.map(move |row| row * across + first), last - first)
    }

    /// Whether a point asks for a texel that something covers and lies deeper than its nearest part.
    pub fn has_deeper(&self, reached: &Reached) -> bool {
        let Region { low, high } = reached.region;
        let (mut lines, more) = self.lines((low[0], high[0]), (low[1], high[1]));
        lines.any(|line| self.cells[line..=line + more].iter().any(|cell| cell.deepest > reached.depths.0))
    }

    /// Puts the texels that lie behind a triangle in its shadow, where the questions are among those given.
    #[inline]
    pub fn shade(
        &self,
        corners: &[Vertex; 3],
        target: &Target,
        rule: CasterRule,
        (questions, sorted): (&Range<u32>, &mut Sorted),
    ) {
        let Some(boxed) = target.boxed(corners) else { return };
        let (mut lines, more) = self.lines(boxed.columns, boxed.rows);
        let within =
            |line: usize| self.cells[line].first as usize..self.cells[line + more + 1].first as usize;
        let Some(first) = lines.find(|&line| !within(line).is_empty()) else { return };
        let caster = Caster::new(corners, boxed, rule, (target, questions));
        for line in std::iter::once(first).chain(lines) {
            let within = within(line);
            if within.len() <= FEW {
                sorted.shade(within, &caster);
            } else {
                self.shade_deeper(line..line + more + 1, &caster, sorted);
            }
        }
    }

    /// The same for those cells of a line that have texels behind the caster's nearest point.
    fn shade_deeper(&self, cells: Range<usize>, caster: &Caster<'_>, sorted: &mut Sorted) {
        let mut cell = cells.start;
        while cell < cells.end {
            let start = cell;
            while cell < cells.end && self.cells[cell].deepest > caster.least {
                cell += 1;
            }
            if cell > start {
                sorted.shade(self.cells[start].first as usize..self.cells[cell].first as usize, caster);
            } else {
                cell += 1;
            }
        }
    }
}

/// A triangle that casts a shadow.
struct Caster<'a> {
    corners: &'a [Vertex; 3],
    plane: Plane,
    /// What is added to its depth.
    offset: f32,
    /// The least depth of its plane within its box: nothing nearer than it can be in its shadow.
    least: f32,
    boxed: Boxed,
    target: &'a Target,
    /// Who sees it.
    questions: &'a Range<u32>,
}

impl<'a> Caster<'a> {
    #[inline]
    fn new(
        corners: &'a [Vertex; 3],
        boxed: Boxed,
        rule: CasterRule,
        (target, questions): (&'a Target, &'a Range<u32>),
    ) -> Self {
        let plane = Plane::of(corners);
        let slope = plane.slope();
        let offset = rule.slopes * slope[0].abs().max(slope[1].abs()) + rule.constant;
        let low = |range: (i32, i32), slope: f32| if slope > 0.0 { range.0 } else { range.1 + 1 };
        let nearest = [low(boxed.columns, slope[0]), low(boxed.rows, slope[1])].map(|x| x as f32);
        let least = plane.depth(nearest[0], nearest[1]) + offset;
        Caster { corners, plane, offset, least, boxed, target, questions }
    }
}
