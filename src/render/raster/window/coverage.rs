//! Which samples a triangle covers, and its depth there.
//!
//! Edge functions are exact integers on a grid of 1/256 pixel; an edge that passes through a sample gives it to the
//! triangle on its right or above, the top-left rule in a memory whose first row is the lowest. Samples lie on a grid of
//! 1/8 pixel, so that a tile of 16 by 16 pixels needs 32 bits an edge function: `floor(e / 32)` has the sign of `e`, and
//! moves by whole steps from sample to sample.

use super::vertices::{Vertex, box_on_grid};
use wide::{f32x4, f32x8, i32x4};

/// Columns and rows of a tile \[pixel\].
const TILE: i32 = 16;

/// Where the samples lie. Four samples make a group: the four of one pixel, or one sample each of four pixels in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// Pixels of a group.
    columns: i32,
    /// Columns of a group's samples \[1/8 pixel\].
    x: [i32; 4],
    /// Rows of a group's samples \[1/8 pixel\].
    y: [i32; 4],
}

impl Pattern {
    /// One sample in the middle of every pixel.
    pub const CENTER: Pattern = Pattern { columns: 4, x: [4, 12, 20, 28], y: [4; 4] };
    /// Four samples a pixel at OpenGL's standard places.
    pub const FOUR: Pattern = Pattern { columns: 1, x: [3, 7, 1, 5], y: [1, 3, 5, 7] };

    /// Groups in a row of `width` pixels.
    pub fn groups(&self, width: usize) -> usize {
        width.div_ceil(self.columns as usize)
    }

    /// Pixels of a group.
    pub fn pixels_in_group(&self) -> i32 {
        self.columns
    }

    /// The pixel of a group that one of its samples lies in.
    pub fn pixel_of(&self, lane: usize) -> i32 {
        self.x[lane] / 8
    }

    /// First and last place of a sample along the columns or rows of its pixel \[1/8 pixel\].
    fn places(offsets: [i32; 4]) -> (i32, i32) {
        offsets.iter().fold((8, 0), |(first, last), &x| (first.min(x % 8), last.max(x % 8)))
    }
}

/// Window that is drawn into, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Extent {
    /// Number of columns.
    pub width: i32,
    /// Number of rows.
    pub height: i32,
}

impl Extent {
    /// All of the window.
    pub fn region(self) -> Region {
        Region { low: [0, 0], high: [self.width - 1, self.height - 1] }
    }
}

/// Part of a window, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// First column and row.
    pub low: [i32; 2],
    /// Last column and row.
    pub high: [i32; 2],
}

/// Which side of triangles is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// The side from which the corners run counter-clockwise.
    Front,
    /// The side from which they run clockwise.
    Back,
    /// Both.
    Both,
}

/// The samples that triangles are drawn into, with what finds the pixels of a triangle's box.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Which side is seen.
    facing: Facing,
    /// Columns and rows in the first two lanes: the offsets that make the pixels of a box cover its samples \[1/256 pixel\], and
    /// the number of pixels.
    before: i32x4,
    after: i32x4,
    first: i32x4,
    last: i32x4,
}

impl Target {
    /// The samples of a region.
    pub fn new(pattern: Pattern, facing: Facing, region: &Region) -> Self {
        let (x, y) = (Pattern::places(pattern.x), Pattern::places(pattern.y));
        let lanes = |[x, y]: [i32; 2]| i32x4::new([x, y, 0, 0]);
        Target {
            facing,
            before: lanes([x.1, y.1].map(|place| 255 - 32 * place)),
            after: lanes([x.0, y.0].map(|place| -32 * place)),
            first: lanes(region.low),
            last: lanes(region.high),
        }
    }
}

/// A triangle whose coverage can be asked for.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    edges: Edges,
    plane: Plane,
    boxed: Boxed,
}

/// First and last columns and rows with samples of a triangle's box \[pixel\].
#[derive(Clone, Copy, Debug)]
pub struct Boxed {
    /// Columns.
    pub columns: (i32, i32),
    /// Rows.
    pub rows: (i32, i32),
}

/// Edge functions `a x + b y + c` of a triangle, at least 0 inside.
#[derive(Clone, Copy, Debug)]
pub struct Edges([Edge; 3]);

/// Depth of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// First corner \[pixel\].
    origin: [f32; 2],
    /// Depth at the first corner.
    z: f32,
    /// Change of depth along a row and a column \[1/pixel\].
    slope: [f32; 2],
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    a: i32,
    b: i32,
    c: i64,
}

impl Target {
    /// The box of a triangle; none where it has no sample in the region.
    #[inline]
    pub fn boxed(&self, v: &[Vertex; 3]) -> Option<Boxed> {
        let [low, high] = box_on_grid(v);
        let first: i32x4 = (low + self.before) >> 8_i32;
        let first = first.max(self.first).to_array();
        let last: i32x4 = (high + self.after) >> 8_i32;
        let last = last.min(self.last).to_array();
        let some = first[0] <= last[0] && first[1] <= last[1];
        some.then_some(Boxed { columns: (first[0], last[0]), rows: (first[1], last[1]) })
    }

    /// The edges of a triangle; none where it has no area or is seen from the wrong side.
    #[inline]
    pub fn edges(&self, v: &[Vertex; 3]) -> Option<Edges> {
        let place = |v: &Vertex| {
            let [x, y, ..] = v.on_grid().to_array();
            [x, y]
        };
        let (p, q, r) = (place(&v[0]), place(&v[1]), place(&v[2]));
        let area =
            i64::from(q[0] - p[0]) * i64::from(r[1] - p[1]) - i64::from(r[0] - p[0]) * i64::from(q[1] - p[1]);
        let turned = match (self.facing, area) {
            (_, 0) => return None,
            (Facing::Front | Facing::Both, 1..) => false,
            (Facing::Back | Facing::Both, ..0) => true,
            _ => return None,
        };
        let (q, r) = if turned { (r, q) } else { (q, r) };
        Some(Edges([edge(q, r), edge(r, p), edge(p, q)]))
    }
}

impl Edges {
    /// Whether a point lies inside, in 1/256 pixel.
    #[inline]
    pub fn contain(&self, x: i32, y: i32) -> bool {
        self.0.iter().all(|e| i64::from(e.a) * i64::from(x) + i64::from(e.b) * i64::from(y) + e.c >= 0)
    }
}

impl Plane {
    /// The plane through the corners themselves, not rounded to the grid that decides coverage.
    #[inline]
    pub fn of(v: &[Vertex; 3]) -> Self {
        let (origin, second, third) = (v[0].at(), v[1].at(), v[2].at());
        let side = |at: [f32; 2], z: f32| [at[0] - origin[0], at[1] - origin[1], z - v[0].z()];
        let ([dx, dy, dz], [ex, ey, ez]) = (side(second, v[1].z()), side(third, v[2].z()));
        let scale = 1.0 / (dx * ey - dy * ex);
        let slope = [(dz * ey - ez * dy) * scale, (ez * dx - dz * ex) * scale];
        Plane { origin, z: v[0].z(), slope }
    }

    /// Change of depth along a row and a column \[1/pixel\].
    pub fn slope(&self) -> [f32; 2] {
        self.slope
    }

    /// Depth at a point of the window \[pixel\].
    pub fn depth(&self, x: f32, y: f32) -> f32 {
        self.z + (self.slope[0] * (x - self.origin[0]) + self.slope[1] * (y - self.origin[1]))
    }

    /// Depth at eight points of the window \[pixel\].
    #[inline]
    pub fn depths(&self, x: f32x8, y: f32x8) -> f32x8 {
        let [across, up] = self.slope.map(f32x8::splat);
        let [left, bottom] = self.origin.map(f32x8::splat);
        f32x8::splat(self.z) + (across * (x - left) + up * (y - bottom))
    }
}

impl Triangle {
    /// The part of a triangle that lies in the target; none where it covers no sample for its facing or size.
    #[inline]
    pub fn new(v: &[Vertex; 3], target: &Target) -> Option<Self> {
        let boxed = target.boxed(v)?;
        let edges = target.edges(v)?;
        Some(Triangle { edges, plane: Plane::of(v), boxed })
    }

    /// Calls `draw(row, group, mask, depth)` for every group with covered samples; lanes of the mask are all ones where a sample
    /// is covered.
    #[inline]
    pub fn cover(&self, pattern: &Pattern, mut draw: impl FnMut(usize, usize, i32x4, f32x4)) {
        let group = pattern.columns;
        let Boxed { columns, rows } = self.boxed;
        let first = columns.0 / group * group;
        for bottom in (rows.0..=rows.1).step_by(TILE as usize) {
            for left in (first..=columns.1).step_by(TILE as usize) {
                let span = Span {
                    left,
                    bottom,
                    groups: (columns.1.min(left + TILE - 1) - left) / group + 1,
                    rows: rows.1.min(bottom + TILE - 1) - bottom + 1,
                };
                self.cover_tile(pattern, span, &mut draw);
            }
        }
    }

    #[inline]
    fn cover_tile(&self, pattern: &Pattern, span: Span, draw: &mut impl FnMut(usize, usize, i32x4, f32x4)) {
        let (mut steps, mut crossed) = ([Step::default(); 3], false);
        for (step, edge) in steps.iter_mut().zip(&self.edges.0) {
            match edge.in_tile(pattern, &span) {
                Crossing::Outside => return,
                Crossing::Inside => {}
                Crossing::Here(found) => (*step, crossed) = (found, true),
            }
        }
        let [s, t, u] = steps;
        let Plane { origin, z, slope } = self.plane;
        let lane = |offsets: [i32; 4]| i32x4::new(offsets).round_float() * f32x4::splat(0.125);
        let (lane_x, lane_y) = (lane(pattern.x), lane(pattern.y));
        let x = lane_x + f32x4::splat(span.left as f32 - origin[0]);
        let across = f32x4::splat(slope[0] * pattern.columns as f32);
        let first_group = (span.left / pattern.columns) as usize;
        for row in 0..span.rows {
            let line = span.bottom + row;
            let y = lane_y + f32x4::splat(line as f32 - origin[1]);
            let depth = f32x4::splat(z) + (f32x4::splat(slope[0]) * x + f32x4::splat(slope[1]) * y);
            if !crossed {
                for group in 0..span.groups {
                    let depth = depth + across * f32x4::splat(group as f32);
                    draw(line as usize, first_group + group as usize, i32x4::splat(-1), depth);
                }
                continue;
            }
            let mut e = [s, t, u].map(|step| step.start + i32x4::splat(step.up * row));
            for group in 0..span.groups {
                let outside = e[0] | e[1] | e[2];
                let mask = !outside.is_negative();
                if mask.any() {
                    draw(
                        line as usize,
                        first_group + group as usize,
                        mask,
                        depth + across * f32x4::splat(group as f32),
                    );
                }
                e = [
                    e[0] + i32x4::splat(s.across),
                    e[1] + i32x4::splat(t.across),
                    e[2] + i32x4::splat(u.across),
                ];
            }
        }
    }
}

/// Part of a tile that a triangle's box covers.
#[derive(Clone, Copy)]
struct Span {
    left: i32,
    bottom: i32,
    groups: i32,
    rows: i32,
}

/// How an edge lies to a tile.
enum Crossing {
    /// No sample is inside.
    Outside,
    /// All samples are.
    Inside,
    /// Some may be.
    Here(Step),
}

/// An edge function over a tile, at the samples of its first group and its steps to the next group and row.
#[derive(Clone, Copy, Default)]
struct Step {
    start: i32x4,
    across: i32,
    up: i32,
}

impl Edge {
    /// The edge function within a tile.
    #[inline]
    fn in_tile(&self, pattern: &Pattern, span: &Span) -> Crossing {
        let at = i64::from(self.a) * i64::from(span.left) * 256
            + i64::from(self.b) * i64::from(span.bottom) * 256
            + self.c;
        let corner = at >> 5;
        // Samples lie within [0, 8 columns] by [0, 8 rows] steps of the corner.
        let reach_x = i64::from(self.a) * i64::from(8 * span.groups * pattern.columns);
        let reach_y = i64::from(self.b) * i64::from(8 * span.rows);
        let most = corner + reach_x.max(0) + reach_y.max(0);
        let least = corner + reach_x.min(0) + reach_y.min(0);
        if most < 0 {
            return Crossing::Outside;
        }
        if least >= 0 {
            return Crossing::Inside;
        }
        let (x, y) = (i32x4::new(pattern.x), i32x4::new(pattern.y));
        let start = i32x4::splat(corner as i32) + i32x4::splat(self.a) * x + i32x4::splat(self.b) * y;
        Crossing::Here(Step { start, across: 8 * pattern.columns * self.a, up: 8 * self.b })
    }
}

/// The edge function of the line from `p` to `q`, at least 0 on its left; on the line itself only where the triangle is right of
/// or above it.
fn edge(p: [i32; 2], q: [i32; 2]) -> Edge {
    let (a, b) = (p[1] - q[1], q[0] - p[0]);
    let owns = a > 0 || (a == 0 && b > 0);
    let c = -(i64::from(a) * i64::from(p[0]) + i64::from(b) * i64::from(p[1]));
    Edge { a, b, c: if owns { c } else { c - 1 } }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXTENT: Extent = Extent { width: 100, height: 90 };

    fn vertex(x: i32, y: i32, z: f32) -> Vertex {
        Vertex::new([x, y].map(|x| x as f32 / 256.0), z)
    }

    fn target(pattern: Pattern, facing: Facing) -> Target {
        Target::new(pattern, facing, &EXTENT.region())
    }

    /// How often each sample is covered by some triangles.
    fn counts(triangles: &[[Vertex; 3]], pattern: &Pattern) -> Vec<u32> {
        let groups = pattern.groups(EXTENT.width as usize);
        let mut counts = vec![0; groups * EXTENT.height as usize * 4];
        for v in triangles {
            let Some(triangle) = Triangle::new(v, &target(*pattern, Facing::Both)) else { continue };
            triangle.cover(pattern, |row, group, mask, _| {
                for (lane, &set) in mask.to_array().iter().enumerate() {
                    counts[(row * groups + group) * 4 + lane] += u32::from(set != 0);
                }
            });
        }
        counts
    }

    /// A deterministic mixture of bits.
    fn mixed(seed: u32) -> i32 {
        let x = seed.wrapping_mul(0x9e37_79b9) ^ (seed >> 7).wrapping_mul(0x85eb_ca6b);
        ((x ^ (x >> 15)).wrapping_mul(0x2c1b_3c6d) >> 8) as i32
    }

    #[test]
    fn a_fan_covers_every_sample_once() {
        for pattern in [Pattern::CENTER, Pattern::FOUR] {
            for seed in 0..40 {
                // Corners on and off the grid of samples, far outside the window.
                let corner = |k: u32| mixed(seed * 16 + k) % (400 * 32) * if seed % 2 == 0 { 32 } else { 7 };
                let hub = vertex(50 * 256 + mixed(seed) % 3000, 45 * 256 + 96, 0.5);
                let far = 2_500_000;
                let rim = [(-far, -far), (far, -far + corner(1)), (far, far), (-far + corner(2), far)];
                let fan: Vec<_> = (0..4)
                    .map(|i| {
                        let (p, q) = (rim[i], rim[(i + 1) % 4]);
                        [hub, vertex(p.0, p.1, 0.5), vertex(q.0, q.1, 0.5)]
                    })
                    .collect();
                let groups = pattern.groups(EXTENT.width as usize);
                for (i, &count) in counts(&fan, &pattern).iter().enumerate() {
                    let column = i % (groups * 4) / 4 * pattern.columns as usize;
                    assert!(
                        count == 1 || column + 4 > EXTENT.width as usize,
                        "sample {i} is covered {count} times"
                    );
                }
            }
        }
    }

    #[test]
    fn coverage_and_depth_agree_with_their_definition() {
        let v = [vertex(1000, 500, 0.1), vertex(20_000, 3000, 0.7), vertex(6000, 19_000, 0.4)];
        let triangle = Triangle::new(&v, &target(Pattern::FOUR, Facing::Front)).expect("it is seen");
        let mut covered = 0;
        triangle.cover(&Pattern::FOUR, |row, group, mask, depth| {
            for lane in 0..4 {
                let (x, y) =
                    (8 * group as i32 + Pattern::FOUR.x[lane], 8 * row as i32 + Pattern::FOUR.y[lane]);
                let inside = mask.to_array()[lane] != 0;
                assert_eq!(inside, triangle.edges.contain(32 * x, 32 * y));
                let expected = triangle.plane.depth(x as f32 / 8.0, y as f32 / 8.0);
                assert!(!inside || (depth.to_array()[lane] - expected).abs() < 1e-5);
                covered += u32::from(inside);
            }
        });
        // Four samples a pixel, area by the cross product.
        let area = (19_000.0 * 18_500.0 - 5000.0 * 2500.0) / 2.0 / 65536.0;
        assert!((f64::from(covered) / 4.0 - area).abs() < 0.01 * area, "{covered} samples, {area} pixels");
        for (corner, z) in v.iter().zip([0.1, 0.7, 0.4]) {
            assert!((triangle.plane.depth(corner.at()[0], corner.at()[1]) - z).abs() < 1e-5);
        }
    }

    #[test]
    fn the_far_side_is_not_seen() {
        let v = [vertex(0, 0, 0.5), vertex(0, 9000, 0.5), vertex(9000, 0, 0.5)];
        assert!(Triangle::new(&v, &target(Pattern::FOUR, Facing::Front)).is_none());
        assert!(Triangle::new(&v, &target(Pattern::FOUR, Facing::Back)).is_some());
    }
}
