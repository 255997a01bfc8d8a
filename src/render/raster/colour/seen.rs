//! The triangles that are seen, lit at their corners, and the fragments of the picture that they make up.
//!
//! A fragment is one triangle in one pixel. It is shaded once, at the middle of the pixel, for all of the triangle's samples there.

use super::lighting::{Corners, Lamp, Material, Triple, add_lamp, clamped, own_light, unit};
use super::shares::{anchor, shares, shares_along};
use crate::geometry::{Assets, Corners as Rows, Paint};
use crate::raster::draws::{Draw, Draws};
use crate::raster::stage::Stage;
use crate::raster::visibility::Visibility;
use crate::raster::window::coverage::{Extent, Pattern, Triangle};
use crate::raster::window::projection::Columns;
use crate::scene::{Item, Scene};
use std::ops::Range;
use wide::bytemuck::cast;
use wide::{f32x4, f32x8, i32x4, u32x4};

/// One triangle in one pixel.
#[derive(Clone, Copy, Debug)]
pub struct Fragment {
    /// Column \[pixel\].
    pub x: u16,
    /// Row from below \[pixel\].
    pub y: u16,
    /// Group of its samples.
    pub group: u32,
    /// Index into the triangles seen.
    pub triangle: u32,
    /// Bits of its samples in the group.
    pub lanes: u8,
    /// Bits of the shadow lamps that reach it.
    pub lit: u8,
}

/// A triangle ready for shading.
#[derive(Clone, Copy, Debug)]
pub struct SeenTriangle {
    /// Index of its surface among the draws.
    pub draw: u32,
    /// First colours of its corners.
    rows: [u32; 3],
    /// Point of the window from which columns and rows are counted, so that small numbers are multiplied \[pixel\].
    anchor: [f32; 2],
    /// What multiplies column, row and 1 to give the corners' shares before normalisation, counted from `anchor`; a lane for
    /// each corner.
    shares: [f32x4; 3],
    /// Texture coordinates or directions of its corners.
    texture: [f32x4; 3],
    /// Its corners, world frame \[m\].
    corners: [f32x4; 3],
}

impl SeenTriangle {
    /// Shares of the corners in a point of the window \[pixel\]; they add up to 1.
    #[inline]
    pub fn weights(&self, x: f32, y: f32) -> [f32; 3] {
        let (x, y) = (f32x4::splat(x - self.anchor[0]), f32x4::splat(y - self.anchor[1]));
        let [a, b, c] = self.shares;
        let shares = a * x + b * y + c;
        let e = shares.to_array();
        let [p, q, r, _] = (shares * f32x4::splat(1.0 / (e[0] + e[1] + e[2]))).to_array();
        [p, q, r]
    }

    /// The point in the world.
    #[inline]
    pub fn position(&self, weights: [f32; 3]) -> [f32; 3] {
        let [x, y, z, _] = mix(weights, &self.corners).to_array();
        [x, y, z]
    }

    /// What the corners have by their position, world frame, between them.
    #[inline]
    pub fn mean(&self, weights: [f32; 3], of: impl Fn([f32; 3]) -> f32) -> f32 {
        let of_corner = |k: usize| {
            let [x, y, z, _] = self.corners[k].to_array();
            of([x, y, z])
        };
        (0..3).map(|k| weights[k] * of_corner(k)).sum()
    }

    /// Texture coordinates or direction, in the first lanes.
    #[inline]
    pub fn texture(&self, weights: [f32; 3]) -> f32x4 {
        mix(weights, &self.texture)
    }
}

/// Three coordinates or colours in the first lanes.
#[inline]
fn triple([x, y, z]: [f32; 3]) -> f32x4 {
    f32x4::new([x, y, z, 0.0])
}

#[inline]
fn mix(weights: [f32; 3], at: &[f32x4; 3]) -> f32x4 {
    let [p, q, r] = weights.map(f32x4::splat);
    p * at[0] + q * at[1] + r * at[2]
}

/// Triangles that are skipped together where none is seen.
const CHUNK: usize = 16;
/// Most lamps whose shadows are drawn: a fragment has a bit for each.
const MAX_SHADOWED: usize = 8;

/// Calls `see` with the fragments of a triangle where it is not behind what a window shows.
#[inline]
pub fn uncovered(shown: &Visibility, triangle: &Triangle, mut see: impl FnMut(Fragment)) {
    let pattern = shown.pattern;
    triangle.cover(&pattern, |row, column, mask, depth| {
        let index = row * shown.per_row + column;
        let depth: i32x4 = cast(depth.simd_ge(shown.groups[index].depth));
        let lanes = (mask & depth).to_bitmask() as u8;
        let fragment = |x: usize, lanes: u8| {
            let (x, y) = (x as u16, row as u16);
            Fragment { x, y, group: index as u32, triangle: 0, lanes, lit: 0 }
        };
        if pattern != Pattern::FOUR {
            for lane in (0..4).filter(|lane| lanes >> lane & 1 != 0) {
                see(fragment(4 * column + lane, 1 << lane));
            }
        } else if lanes != 0 {
            see(fragment(column, lanes));
        }
    });
}

/// Which light falls on the triangles of a layer.
#[derive(Clone, Debug, Default)]
pub struct Illumination {
    /// Lamps without shadows, all added up.
    pub base: Vec<Lamp>,
    /// Lamps whose colours are kept apart, since shadows take them away pixel by pixel; at most 8.
    pub shadowed: Vec<Lamp>,
    /// Light from everywhere.
    pub ambient: f32,
    /// Factor of the items' own colours.
    pub reflectance: f32,
    /// Where highlights are seen from, world frame \[m\].
    pub eye: [f32; 3],
}

impl Illumination {
    /// The lights of a scene, seen from `eye`. The first eight that cast shadows are kept apart where shadows are wanted.
    pub fn set(&mut self, scene: &Scene, eye: [f32; 3], shadows: bool) {
        self.base.clear();
        self.shadowed.clear();
        for light in &scene.lights {
            let apart = shadows && light.shadow && self.shadowed.len() < MAX_SHADOWED;
            let list = if apart { &mut self.shadowed } else { &mut self.base };
            list.push(Lamp::new(light));
        }
        (self.ambient, self.reflectance, self.eye) = (scene.ambient, 1.0, eye);
    }
}

/// The triangles and fragments that are seen in a window.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The triangles, once they are lit.
    pub triangles: Vec<SeenTriangle>,
    /// The fragments, row by row from below.
    pub fragments: Vec<Fragment>,
    /// Where each fragment lies, world frame \[m\]; only where lamps are kept apart.
    pub positions: Vec<[f32; 3]>,
    /// Lamps kept apart, and one.
    passes: usize,
    /// Colours of lit corners in the first lanes, one for each pass.
    colours: Vec<f32x4>,
    /// Number of each triangle seen.
    numbers: Vec<u32>,
    /// For each triangle of the scene its place among those seen, counted from 1; 0 for none.
    places: Vec<u32>,
    /// Number of the last triangle added, 0 for none, and its index among those seen.
    last: (u32, u32),
    /// Rows of the colours by position, where the position has been lit with one normal.
    stamps: Vec<Stamp>,
    frame: u32,
    /// Corners of the current surface that wait to be lit.
    waiting: Vec<(u32, u32)>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Stamp {
    frame: u32,
    normal: u32,
    row: u32,
}

impl Seen {
    /// Forgets the last picture's triangles, and makes room for the numbers of a scene with `triangles` of them.
    pub fn begin(&mut self, triangles: u32) {
        for &number in &self.numbers {
            self.places[number as usize] = 0;
        }
        self.last = (0, 0);
        self.numbers.clear();
        self.fragments.clear();
        self.colours.clear();
        self.places.resize(triangles as usize, 0);
    }

    /// Collects what a window shows, but for the fragments that `keep(fragment, number)` takes.
    pub fn collect(
        &mut self,
        visibility: &Visibility,
        width: usize,
        triangles: u32,
        mut keep: impl FnMut(Fragment, u32) -> bool,
    ) {
        self.begin(triangles);
        let one_pixel = visibility.pattern == Pattern::FOUR;
        for (y, row) in visibility.groups.chunks_exact(visibility.per_row).enumerate() {
            let first = (y * visibility.per_row) as u32;
            for (column, (group, index)) in row.iter().zip(first..).enumerate() {
                let numbers = group.triangle.to_array();
                let fragment = |x: usize, lanes: u8| {
                    let (x, y) = (x as u16, y as u16);
                    Fragment { x, y, group: index, triangle: 0, lanes, lit: 0 }
                };
                if one_pixel && group.triangle.simd_eq(u32x4::splat(numbers[0])).all() {
                    let whole = fragment(column, 0b1111);
                    if numbers[0] != 0 && !keep(whole, numbers[0]) {
                        self.add(numbers[0], whole);
                    }
                    continue;
                }
                let mut take = |number: u32, fragment: Fragment| {
                    if number != 0 && !keep(fragment, number) {
                        self.add(number, fragment);
                    }
                };
                if one_pixel {
                    same_numbers(numbers, |number, lanes| take(number, fragment(column, lanes)));
                } else {
                    let pixels = numbers.into_iter().enumerate().take(width.saturating_sub(4 * column));
                    pixels.for_each(|(lane, number)| take(number, fragment(4 * column + lane, 1 << lane)));
                }
            }
        }
    }

    /// Adds the fragments of a triangle where it is not behind what a window shows.
    #[inline]
    pub fn cover(&mut self, shown: &Visibility, number: u32, triangle: &Triangle) {
        uncovered(shown, triangle, |fragment| self.add(number, fragment));
    }

    /// Adds a fragment of a triangle.
    #[inline]
    fn add(&mut self, number: u32, fragment: Fragment) {
        // Neighbours mostly show the same triangle.
        if number != self.last.0 {
            // Lines are numbered beyond the triangles and need no light.
            let Some(place) = self.places.get_mut(number as usize) else { return };
            if *place == 0 {
                self.numbers.push(number);
                *place = self.numbers.len() as u32;
            }
            self.last = (number, *place - 1);
        }
        self.fragments.push(Fragment { triangle: self.last.1, ..fragment });
    }

    /// Prepares the triangles collected: shares of their corners in the window, texture coordinates, light.
    pub fn light(&mut self, stage: &Stage<'_>, light: &Illumination) {
        let Stage { assets, scene, draws, layer, lens } = *stage;
        self.passes = 1 + light.shadowed.len();
        self.frame = self.frame.wrapping_add(1);
        self.stamps.resize(draws.vertices, Stamp::default());
        let empty = SeenTriangle {
            draw: 0,
            rows: [0; 3],
            anchor: [0.0; 2],
            shares: [f32x4::ZERO; 3],
            texture: [f32x4::ZERO; 3],
            corners: [f32x4::ZERO; 3],
        };
        self.triangles.resize(self.numbers.len(), empty);
        let (first, last) = self
            .numbers
            .iter()
            .fold((u32::MAX, 0), |(low, high), &number| (low.min(number), high.max(number)));
        for (index, draw) in draws.list.iter().enumerate() {
            let Some(columns) = layer.columns(index) else { continue };
            let end = draws.list.get(index + 1).map_or(draws.triangles, |next| next.first_triangle);
            let mut from = draw.first_triangle.max(first);
            while let Some(number) = self.next_seen(from..end.min(last.saturating_add(1))) {
                let place = self.places[number as usize] as usize - 1;
                self.triangles[place] = self.prepare((assets, draws, lens.extent), index, columns, number);
                from = number + 1;
            }
            self.light_waiting(assets, draw, &scene.items[draw.item], light);
        }
        self.positions.clear();
        if self.passes > 1 {
            let triangles = &self.triangles;
            self.positions.extend(self.fragments.iter().map(|fragment| {
                let triangle = &triangles[fragment.triangle as usize];
                triangle.position(triangle.weights(f32::from(fragment.x) + 0.5, f32::from(fragment.y) + 0.5))
            }));
        }
    }

    /// The first of some triangles that is seen.
    #[inline]
    fn next_seen(&self, numbers: Range<u32>) -> Option<u32> {
        let places = self.places.get(numbers.start as usize..numbers.end as usize)?;
        let unseen = |chunk: &&[u32; CHUNK]| chunk.iter().fold(0, |any, place| any | place) == 0;
        let skipped = CHUNK * places.as_chunks().0.iter().take_while(unseen).count();
        let seen = places[skipped..].iter().position(|&place| place != 0)?;
        Some(numbers.start + (skipped + seen) as u32)
    }

    /// A triangle without its colours, whose corners wait to be lit; or one side of it, as a triangle whose last two corners are
    /// one.
    fn prepare(
        &mut self,
        (assets, draws, extent): (&Assets, &Draws, Extent),
        index: usize,
        columns: &Columns,
        number: u32,
    ) -> SeenTriangle {
        let draw = &draws.list[index];
        let surface = draw.surface(assets);
        let place = number - draw.first_triangle;
        let outlined = draws.numbers_each == 3;
        let (index_in_surface, order) = match (place % 3) as usize {
            side if outlined => ((place / 3) as usize, [side, (side + 1) % 3, (side + 1) % 3]),
            _ => (place as usize, [0, 1, 2]),
        };
        let face = order.map(|k| surface.faces[index_in_surface][k]);
        let corners = surface.corners[index_in_surface];
        let corners =
            Rows { normal: order.map(|k| corners.normal[k]), texcoord: order.map(|k| corners.texcoord[k]) };
        let points = face.map(|i| surface.positions[i as usize]);
        let window = points.map(|p| columns.apply(p));
        let anchor = anchor(window[0], extent);
        let rows = std::array::from_fn(|k| {
            let stamp = &mut self.stamps[draw.first_vertex + face[k] as usize];
            if stamp.frame != self.frame || stamp.normal != corners.normal[k] {
                let row = (self.colours.len() / self.passes + self.waiting.len()) as u32;
                *stamp = Stamp { frame: self.frame, normal: corners.normal[k], row };
                self.waiting.push((face[k], corners.normal[k]));
            }
            stamp.row
        });
        let texture = std::array::from_fn(|k| {
            triple(match draw.paint {
                Paint::Plain => [0.0; 3],
                Paint::Explicit { scale, offset, .. } => {
                    let [u, v] = surface.texcoords[corners.texcoord[k] as usize];
                    [scale[0] * u + offset[0], scale[1] * v + offset[1], 0.0]
                }
                Paint::Planar { scale, .. } => {
                    [scale[0] * points[k][0] - 0.5, scale[1] * points[k][1] - 0.5, 0.0]
                }
                Paint::Cube { scale, .. } => std::array::from_fn(|i| scale[i] * points[k][i]),
            })
        });
        let shares =
            if outlined { shares_along([window[0], window[1]], anchor) } else { shares(window, anchor) };
        SeenTriangle {
            draw: index as u32,
            rows,
            anchor,
            shares: std::array::from_fn(|j| triple(shares.map(|row| row[j]))),
            texture,
            corners: points.map(|p| triple(draw.place(p))),
        }
    }

    /// Lights the corners of one surface that wait, eight at a time.
    fn light_waiting(&mut self, assets: &Assets, draw: &Draw, item: &Item, light: &Illumination) {
        let surface = draw.surface(assets);
        let material = Material::of(item, light.reflectance, draw.alpha(item));
        for block in self.waiting.chunks(8) {
            let (mut local, mut normal) = ([[0.0; 8]; 3], [[0.0; 8]; 3]);
            for (lane, &(p, n)) in block.iter().enumerate() {
                let (position, direction) = (surface.positions[p as usize], surface.normals[n as usize]);
                for k in 0..3 {
                    (local[k][lane], normal[k][lane]) = (position[k], direction[k]);
                }
            }
            let (local, normal) = (local.map(f32x8::new), normal.map(f32x8::new));
            let world = |row: [f64; 4]| {
                let [a, b, c, d] = row.map(|x| f32x8::splat(x as f32));
                a * local[0] + b * local[1] + c * local[2] + d
            };
            let turned = |row: [f32; 3]| {
                let [a, b, c] = row.map(f32x8::splat);
                a * normal[0] + b * normal[1] + c * normal[2]
            };
            let corners =
                Corners { position: draw.world.map(world), normal: unit(draw.normals.map(turned)).0 };
            let first = self.colours.len();
            self.colours.resize(first + block.len() * self.passes, f32x4::ZERO);
            let mut keep = |pass: usize, colour: Triple| {
                let lanes = clamped(colour).map(|c| c.to_array());
                let of_pass = self.colours[first + pass..].iter_mut().step_by(self.passes);
                of_pass.enumerate().for_each(|(i, colour)| *colour = triple(lanes.map(|c| c[i])));
            };
            let mut base = own_light(&material, light.ambient);
            light.base.iter().for_each(|lamp| add_lamp(&mut base, &corners, &material, lamp, light.eye));
            keep(0, base);
            for (pass, lamp) in (1..).zip(&light.shadowed) {
                let mut apart = [f32x8::ZERO; 3];
                add_lamp(&mut apart, &corners, &material, lamp, light.eye);
                keep(pass, apart);
            }
        }
        self.waiting.clear();
    }

    /// Passes that corners are lit in.
    pub fn passes(&self) -> usize {
        self.passes
    }

    /// Number of a fragment's triangle.
    pub fn number(&self, fragment: &Fragment) -> u32 {
        self.numbers[fragment.triangle as usize]
    }

    /// The colour of a triangle under one pass, before its texture, in the first lanes.
    #[inline]
    pub fn colour(&self, triangle: &SeenTriangle, weights: [f32; 3], pass: usize) -> f32x4 {
        let corners = triangle.rows.map(|row| self.colours[row as usize * self.passes + pass]);
        mix(weights, &corners)
    }

    /// Whether a pass gives a triangle any light at all.
    #[inline]
    pub fn is_lit(&self, triangle: &SeenTriangle, pass: usize) -> bool {
        let corners = triangle.rows.map(|row| self.colours[row as usize * self.passes + pass]);
        corners.iter().any(|colour| colour.simd_ne(f32x4::ZERO).any())
    }
}

/// Calls `take(number, lanes)` for each number among four, with the bits of the lanes that have it.
#[inline]
fn same_numbers(numbers: [u32; 4], mut take: impl FnMut(u32, u8)) {
    let mut left = 0b1111_u8;
    while left != 0 {
        let number = numbers[left.trailing_zeros() as usize];
        let same = (0..4).fold(0, |bits, k| bits | u8::from(numbers[k] == number) << k);
        left &= !same;
        take(number, same);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_perspective() {
        // Corners at distances 1, 2 and 4 from the eye: halfway in the window between the first two, the nearer one counts 2 / 3.
        let corners = [[10.0, 10.0, 0.0, 1.0], [60.0, 20.0, 0.0, 2.0], [40.0, 200.0, 0.0, 4.0]];
        let triangle = SeenTriangle {
            draw: 0,
            rows: [0; 3],
            anchor: [15.5, 10.5],
            shares: std::array::from_fn(|j| triple(shares(corners, [15.5, 10.5]).map(|row| row[j]))),
            texture: [f32x4::ZERO; 3],
            corners: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(triple),
        };
        let [near, far, other] = triangle.position(triangle.weights(20.0, 10.0));
        assert!((near - 2.0 / 3.0).abs() < 1e-6 && (far - 1.0 / 3.0).abs() < 1e-6 && other.abs() < 1e-6);
    }
}
