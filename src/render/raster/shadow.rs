//! Shadows: which fragments a lamp reaches.
//!
//! MuJoCo draws a depth map of `shadowsize` texels a side from every lamp and looks each fragment up in its nearest texel. Here
//! only the texels that fragments ask for exist: they are sorted into the cells of a grid, and a triangle is compared with
//! those in the cells that it touches. The answers are those of the whole map.
//!
//! Depth here is u = 0 at the near plane and 1 at the far one, so that what is near keeps its bits.

use super::coverage::{Extent, Pattern, Region, Triangle};
use super::draws::Draw;
use super::layer::{Layer, Lens, Reached, Sides};
use super::stage::Stage;
use super::window::Projection;
use crate::profile::Profile;
use crate::scene::{Category, Light, LightKind, Scene};
use physics::math::ops::tan;
use physics::math::{cross, dot};
use std::ops::Range;
use wide::f32x8;

/// Texels left free at every side of the map.
const MARGIN: f64 = 1.0;
/// How casters are drawn into a shadow map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CasterRule {
    /// Only what faces away from the lamp is.
    pub averted: bool,
    /// Added to their depth, in slopes a texel.
    pub slopes: f32,
    /// Added to their depth.
    pub constant: f32,
}

impl CasterRule {
    /// That of a version of MuJoCo. `glPolygonOffset` of -1.5 and -4 in 3.12; pictures of Mesa fit best where its unit is
    /// two steps of the map's 24 bits. MuJoCo 3.1.3 draws what faces away from the lamp, as it is.
    pub fn of(profile: Profile) -> Self {
        match profile {
            Profile::Mujoco312 => CasterRule { averted: false, slopes: 1.5, constant: 8.0 / 16_777_216.0 },
            Profile::Mujoco313 => CasterRule { averted: true, slopes: 0.0, constant: 0.0 },
        }
    }
}

/// Widest full angle of a spot's map [deg].
const WIDEST: f32 = 160.0;
/// Cells along a side of the grid.
const CELLS: i32 = 256;

/// What every shadow of a scene needs beside its lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowSettings {
    /// Texels along a side of the map, at most 8192; none is drawn for 0.
    pub size: usize,
    /// Half the width of the map of a directional light [m].
    pub clip: f32,
    /// Share of a spot's cone that the map covers.
    pub scale: f32,
}

/// A point's question.
#[derive(Clone, Copy, Debug, Default)]
struct Lookup {
    x: u16,
    y: u16,
    /// Depth of the point.
    depth: f32,
    /// The point that asks.
    asked: u32,
}

/// Texels that points ask for, in the cells of a grid.
#[derive(Clone, Debug, Default)]
pub struct Shadows {
    layer: Layer,
    asked: Vec<Lookup>,
    /// Whether the lamp reaches each point.
    reached: Vec<bool>,
    /// The same, cell by cell.
    sorted: Sorted,
    cells: Vec<Cell>,
    grid: Grid,
}

/// Lookups by column, followed by seven that ask for nothing, so that eight can be read from each.
#[derive(Clone, Debug, Default)]
struct Sorted {
    /// Middle of the texel [texel].
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

    /// Puts those among a range that lie behind a triangle in its shadow, and maybe some after it.
    #[inline]
    fn shade(&mut self, range: Range<usize>, triangle: &Triangle, offset: f32) {
        let middle = |x: i32| f32x8::splat(x as f32 + 0.5);
        let ((left, right), (bottom, top)) = (triangle.columns(), triangle.rows());
        let (left, right, bottom, top) = (middle(left), middle(right), middle(bottom), middle(top));
        for start in range.step_by(LANES) {
            let lanes = start..start + LANES;
            let read = |column: &[f32]| column[lanes.clone()].try_into().map_or(f32x8::ZERO, f32x8::new);
            let (x, y, depth) = (read(&self.x), read(&self.y), read(&self.depth));
            let behind = (triangle.depths(x, y) + f32x8::splat(offset)).simd_lt(depth);
            let boxed = x.simd_ge(left) & x.simd_le(right) & y.simd_ge(bottom) & y.simd_le(top);
            let mut behind = (behind & boxed).to_bitmask();
            while behind != 0 {
                let at = start + behind.trailing_zeros() as usize;
                behind &= behind - 1;
                let texel = |x: f32| 256 * (x as i32) + 128;
                if triangle.contains(texel(self.x[at]), texel(self.y[at])) {
                    self.depth[at] = SHADED;
                }
            }
        }
    }
}

/// A cell of the grid.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// Its first texel among the sorted.
    first: u32,
    /// Largest depth of a fragment in it.
    deepest: f32,
}

/// A grid over the box of the texels that are asked for.
#[derive(Clone, Copy, Debug, Default)]
struct Grid {
    /// First column and row [texel].
    low: [i32; 2],
    /// Last column and row [texel].
    high: [i32; 2],
    /// Texels along a side of a cell.
    cell: i32,
    /// Largest depth of a fragment.
    deepest: f32,
}

impl Grid {
    fn cell_of(&self, x: i32, y: i32) -> usize {
        ((y - self.low[1]) / self.cell * CELLS + (x - self.low[0]) / self.cell) as usize
    }

    /// Whether a point asks for a texel that something covers and lies deeper than its nearest part.
    fn has_deeper(&self, cells: &[Cell], reached: &Reached) -> bool {
        let Region { low, high } = reached.region;
        let (first, last) = (self.cell_of(low[0], low[1]), self.cell_of(high[0], high[1]));
        let across = last % CELLS as usize - first % CELLS as usize;
        let mut lines = (first..=last).step_by(CELLS as usize);
        lines.any(|line| cells[line..=line + across].iter().any(|cell| cell.deepest > reached.depths.0))
    }
}

/// Maps of the world to a lamp's map: `casters` for triangles, in texels of the inner map; `lookups` for fragments, in texels
/// of the whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maps {
    /// From the world to the texels that casters are drawn to.
    pub casters: Projection,
    /// From the world to the texels that are looked up.
    pub lookups: Projection,
}

/// A point that a lamp may reach, world frame [m], and what its asker calls it.
pub type Question = (u32, [f32; 3]);

impl Shadows {
    /// Keeps those of `questions` that `light` reaches past the draws that `casters` picks.
    pub fn cast(
        &mut self,
        stage: &Stage<'_>,
        light: &Light,
        settings: &ShadowSettings,
        casters: impl Fn(&Draw) -> bool,
        questions: &mut Vec<Question>,
    ) {
        if questions.is_empty() {
            return;
        }
        let maps = maps(light, stage.scene, settings);
        self.ask(&maps.lookups, settings, questions);
        if !self.asked.is_empty() {
            self.sort();
            self.draw_casters(stage, maps.casters, settings.size as i32, casters);
        }
        for (&depth, &asked) in self.sorted.depth.iter().zip(&self.sorted.asked) {
            self.reached[asked as usize] |= depth >= 0.0;
        }
        let mut reached = self.reached.iter();
        questions.retain(|_| reached.next() == Some(&true));
    }

    /// Asks for the texel of every point; those outside the map are lit.
    fn ask(&mut self, map: &Projection, settings: &ShadowSettings, questions: &[Question]) {
        self.asked.clear();
        self.reached.clear();
        self.sorted.resize(0);
        let rows = map.0.map(|row| row.map(|x| x as f32));
        let last = settings.size as f32 - 1.0;
        for (index, (_, p)) in questions.iter().enumerate() {
            let [s, t, r, q] = rows.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
            let scale = 1.0 / q;
            let (x, y) = ((s * scale).floor(), (t * scale).floor());
            // The outermost texels are never drawn: what falls on or beyond them is lit.
            let inside = q > 0.0 && x >= 1.0 && y >= 1.0 && x < last && y < last;
            self.reached.push(!inside);
            if inside {
                let depth = (r * scale).clamp(0.0, 1.0);
                self.asked.push(Lookup { x: x as u16, y: y as u16, depth, asked: index as u32 });
            }
        }
    }

    /// Sorts the texels into cells.
    fn sort(&mut self) {
        let fold = |get: fn(&Lookup) -> u16, pick: fn(u16, u16) -> u16, from: u16| {
            i32::from(self.asked.iter().map(get).fold(from, pick))
        };
        let low = [fold(|l| l.x, u16::min, u16::MAX), fold(|l| l.y, u16::min, u16::MAX)];
        let high = [fold(|l| l.x, u16::max, 0), fold(|l| l.y, u16::max, 0)];
        let side = (high[0] - low[0]).max(high[1] - low[1]) + 1;
        let deepest = self.asked.iter().map(|lookup| lookup.depth).fold(0.0, f32::max);
        self.grid = Grid { low, high, cell: (side + CELLS - 1) / CELLS, deepest };
        self.cells.clear();
        self.cells.resize((CELLS * CELLS + 1) as usize, Cell::default());
        let place = |lookup: &Lookup| self.grid.cell_of(lookup.x.into(), lookup.y.into());
        for lookup in &self.asked {
            let cell = place(lookup);
            self.cells[cell + 1].first += 1;
            self.cells[cell].deepest = self.cells[cell].deepest.max(lookup.depth);
        }
        for i in 1..self.cells.len() {
            self.cells[i].first += self.cells[i - 1].first;
        }
        self.sorted.resize(self.asked.len());
        for lookup in &self.asked {
            let at = &mut self.cells[place(lookup)].first;
            self.sorted.set(*at as usize, lookup);
            *at += 1;
        }
        // Every cell's first has moved to its end, which is the next one's first.
        for i in (1..self.cells.len()).rev() {
            self.cells[i].first = self.cells[i - 1].first;
        }
        self.cells[0].first = 0;
    }

    /// Marks the texels behind a caster with a negative depth.
    fn draw_casters(
        &mut self,
        stage: &Stage<'_>,
        projection: Projection,
        size: i32,
        casters: impl Fn(&Draw) -> bool,
    ) {
        let Stage { assets, scene, draws, .. } = *stage;
        let extent = Extent { width: size, height: size };
        let Shadows { layer, sorted, cells, grid, .. } = self;
        let rule = CasterRule::of(assets.profile());
        let sides = if rule.averted { Sides::Averted } else { Sides::Both };
        let region = Region { low: grid.low, high: grid.high };
        let lens = Lens { projection, extent, region, deepest: grid.deepest, mirror: None, sides };
        layer.update(assets, draws, &lens, |draw| {
            scene.items[draw.item].category != Category::Decor && casters(draw)
        });
        for (index, draw) in draws.list.iter().enumerate() {
            let hides = |reached: &Reached| grid.has_deeper(cells, reached);
            layer.triangles_where(assets, (index, draw), &lens, &Pattern::CENTER, hides, |_, triangle| {
                shade(triangle, rule, (grid, cells), sorted);
            });
        }
    }
}

/// Marks the texels of the grid that lie behind a triangle.
#[inline]
fn shade(triangle: &Triangle, rule: CasterRule, (grid, cells): (&Grid, &[Cell]), sorted: &mut Sorted) {
    let (columns, rows) = (triangle.columns(), triangle.rows());
    let slope = triangle.slope();
    let offset = rule.slopes * slope[0].abs().max(slope[1].abs()) + rule.constant;
    // The least depth of the triangle's plane within the box: nothing nearer than it can be in its shadow.
    let low = |range: (i32, i32), slope: f32| if slope > 0.0 { range.0 } else { range.1 + 1 };
    let least = triangle.depth(low(columns, slope[0]) as f32, low(rows, slope[1]) as f32) + offset;
    let (first, last) = (grid.cell_of(columns.0, rows.0), grid.cell_of(columns.1, rows.1));
    let across = last % CELLS as usize - first % CELLS as usize;
    for line in (first..=last).step_by(CELLS as usize) {
        let mut cell = line;
        while cell <= line + across {
            let start = cell;
            while cell <= line + across && cells[cell].deepest > least {
                cell += 1;
            }
            if cell > start {
                sorted.shade(cells[start].first as usize..cells[cell].first as usize, triangle, offset);
            } else {
                cell += 1;
            }
        }
    }
}

/// The maps of a lamp, with its depth as `u`.
pub fn maps(light: &Light, scene: &Scene, settings: &ShadowSettings) -> Maps {
    let frustum = &scene.view.frustum;
    let (near, far) = (frustum.near, frustum.far);
    let forward = unit(light.dir.map(f64::from));
    // The side of the map: the gaze times -x, or times y where that is too short.
    let side = cross(forward, [-1.0, 0.0, 0.0]);
    let up = if dot(side, side) < 0.01 { cross(forward, [0.0, 1.0, 0.0]) } else { side };
    let right = unit(cross(forward, up));
    let up = cross(right, forward);
    let pos = light.pos.map(f64::from);
    let from_lamp = |axis: [f64; 3]| [axis[0], axis[1], axis[2], -dot(axis, pos)];
    let (x, y, depth) = (from_lamp(right), from_lamp(up), from_lamp(forward));
    let (w, half, slope) = match light.kind {
        LightKind::Directional => ([0.0, 0.0, 0.0, 1.0], f64::from(settings.clip), 1.0 / (far - near)),
        LightKind::Spot { cutoff, .. } => {
            let angle = (2.0 * cutoff * settings.scale).min(WIDEST);
            (depth, tan(0.5 * f64::from(angle).to_radians()), far / (far - near))
        }
    };
    let u = std::array::from_fn(|k| slope * (depth[k] - if k == 3 { near } else { 0.0 }));
    let texels = settings.size as f64;
    let axis =
        |row: [f64; 4], inner: f64| std::array::from_fn(|k| 0.5 * (inner * row[k] / half + texels * w[k]));
    let map = |inner: f64| Projection([axis(x, inner), axis(y, inner), u, w]);
    Maps { casters: map(texels - 2.0 * MARGIN), lookups: map(texels) }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}
