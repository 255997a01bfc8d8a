//! The surfaces of a scene under one projection: which can be seen, and their triangles in the window.

use super::draws::{Draw, Draws};
use super::lines::strip;
use super::window::clip::{Corner, GUARD, clip, clip_line};
use super::window::coverage::{Facing, Pattern, Region, Target, Triangle};
use super::window::lens::{Lens, Sides};
use super::window::projection::Columns;
use super::window::vertices::{HalfSpace, Vertex, distance, inside, project, project_whole};
use crate::geometry::{Assets, Bounds, CLUSTER, Surface};

/// Where all surfaces lie.
#[derive(Clone, Debug, Default)]
pub struct Layer {
    reach: Vec<Reach>,
    /// Numbers that every triangle has.
    numbers_each: u32,
}

/// Where a surface lies, as its box tells.
#[derive(Clone, Debug, PartialEq)]
enum Reach {
    /// Beside the window, or left out.
    Unseen,
    /// Maybe in it: the map that its positions take, and the side of the mirror.
    Seen { columns: Columns, half: Option<HalfSpace>, whole: bool },
}

/// How a surface's box lies to the space that can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// Beside the window, before the near plane, beyond the far one, or behind the mirror.
    Beside,
    /// All of it can be drawn.
    Whole,
    /// Some of it may have to be cut away.
    Cut,
}

impl Layer {
    /// Places the surfaces that `wanted` picks and whose boxes are not beside the window.
    pub fn update(&mut self, assets: &Assets, draws: &Draws, lens: &Lens, wanted: impl Fn(&Draw) -> bool) {
        self.numbers_each = draws.numbers_each;
        self.reach.clear();
        self.reach.extend(draws.list.iter().map(|draw| {
            if !wanted(draw) {
                return Reach::Unseen;
            }
            let columns = lens.projection.after(&draw.world);
            let half = lens.mirror.map(|plane| local(plane, draw));
            match side(&columns, half, lens, draw.surface(assets)) {
                Side::Beside => Reach::Unseen,
                side => Reach::Seen { columns, half, whole: side == Side::Whole },
            }
        }));
    }

    /// Calls `see(number, triangle)` for every triangle of a surface that covers samples; one that is cut gives several with the
    /// same number. Where the lens shows outlines, they are those of lines.
    #[inline]
    pub fn triangles(
        &self,
        assets: &Assets,
        (index, draw): (usize, &Draw),
        lens: &Lens,
        pattern: &Pattern,
        mut see: impl FnMut(u32, &Triangle),
    ) {
        if let Some(width) = lens.wire {
            let target = Target::new(*pattern, Facing::Both, &lens.region);
            self.outlines(assets, (index, draw), lens, |number, ends| {
                for corners in strip(ends, width, pattern) {
                    if let Some(triangle) = Triangle::new(&corners, &target) {
                        see(number, &triangle);
                    }
                }
            });
            return;
        }
        let target = Target::new(*pattern, facing(draw, lens), &lens.region);
        self.corners(
            assets,
            (index, draw),
            lens,
            |_| true,
            |number, corners| {
                if let Some(triangle) = Triangle::new(corners, &target) {
                    see(number, &triangle);
                }
            },
        );
    }

    /// Calls `see(number, corners)` for every triangle of a surface that can be drawn; a triangle that is clipped comes in
    /// pieces. Triangles in boxes that do not matter are skipped.
    #[inline]
    pub fn corners(
        &self,
        assets: &Assets,
        (index, draw): (usize, &Draw),
        lens: &Lens,
        matters: impl Fn(&Reached) -> bool,
        mut see: impl FnMut(u32, &[Vertex; 3]),
    ) {
        let Reach::Seen { columns, half, whole } = &self.reach[index] else { return };
        let surface = draw.surface(assets);
        // As many as a byte can number.
        let mut window = [Vertex::default(); 256];
        let clusters = surface.clusters.iter().zip(surface.places.chunks(CLUSTER));
        let step = self.numbers_each as usize;
        for ((index, (cluster, faces)), first) in
            clusters.enumerate().zip((draw.first_triangle..).step_by(CLUSTER * step))
        {
            // A box costs as much as some triangles.
            let hidden = faces.len() > SMALL
                && reached(columns, lens, &cluster.bounds)
                    .is_some_and(|reached| reached.is_empty() || !matters(&reached));
            if hidden {
                continue;
            }
            let rows = surface.rows_of(index);
            if *whole {
                project_whole(columns, &surface.positions, rows, &mut window);
                for (number, &[a, b, c]) in (first..).step_by(step).zip(faces) {
                    see(number, &[window[usize::from(a)], window[usize::from(b)], window[usize::from(c)]]);
                }
                continue;
            }
            project(columns, *half, (&surface.positions, rows), &mut window);
            for (number, face) in (first..).step_by(step).zip(faces) {
                let [a, b, c] = *face;
                let v = [window[usize::from(a)], window[usize::from(b)], window[usize::from(c)]];
                if (v[0].beyond() | v[1].beyond() | v[2].beyond()) == 0 {
                    see(number, &v);
                } else if (v[0].beyond() & v[1].beyond() & v[2].beyond()) == 0 {
                    let points = face.map(|place| surface.positions[rows[usize::from(place)] as usize]);
                    cut(columns, *half, points, |corners| see(number, corners));
                }
            }
        }
    }

    /// Calls `see(number, ends)` for the sides that outline a surface's triangles, of those that the lens shows; the number tells
    /// triangle and side.
    pub fn outlines(
        &self,
        assets: &Assets,
        (index, draw): (usize, &Draw),
        lens: &Lens,
        mut see: impl FnMut(u32, [Vertex; 2]),
    ) {
        let Reach::Seen { columns, half, .. } = &self.reach[index] else { return };
        let (surface, facing) = (draw.surface(assets), facing(draw, lens));
        let project = |row: u32| -> Corner {
            let p = surface.positions[row as usize];
            let [x, y, z, w] = columns.apply(p);
            [x, y, z, w, half.map_or(1.0, |half| distance(half, p))]
        };
        let numbers = (draw.first_triangle..).step_by(self.numbers_each as usize);
        for ((face, &sides), first) in surface.faces.iter().zip(&surface.outlines).zip(numbers) {
            let corners = face.map(project);
            if !shows(facing, &corners) {
                continue;
            }
            for (number, side) in (first..).zip(0..3).filter(|(_, side)| sides >> side & 1 != 0) {
                if let Some(ends) = clip_line([corners[side], corners[(side + 1) % 3]]) {
                    see(number, ends.map(|end| inside(&end)));
                }
            }
        }
    }

    /// The map from a surface's coordinates to the window, where the surface was projected.
    pub fn columns(&self, index: usize) -> Option<&Columns> {
        match &self.reach[index] {
            Reach::Seen { columns, .. } => Some(columns),
            Reach::Unseen => None,
        }
    }
}

/// Which side of a surface's triangles a lens shows.
pub fn facing(draw: &Draw, lens: &Lens) -> Facing {
    match (draw.facing, lens.mirror.is_some(), lens.sides) {
        (_, _, Sides::Both) => Facing::Both,
        (_, _, Sides::Averted) => Facing::Back,
        (facing, false, Sides::Seen) => facing,
        (Facing::Front, true, Sides::Seen) => Facing::Back,
        (Facing::Back, true, Sides::Seen) => Facing::Front,
        (Facing::Both, true, Sides::Seen) => Facing::Both,
    }
}

/// Whether a triangle shows a side, by the sense of rotation of its corners before division by w.
fn shows(facing: Facing, corners: &[Corner; 3]) -> bool {
    let [a, b, c] = corners.map(|[x, y, _, w, _]| [x, y, w].map(f64::from));
    let turn = a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    match facing {
        Facing::Front => turn > 0.0,
        Facing::Back => turn < 0.0,
        Facing::Both => true,
    }
}

/// Calls `see` for the pieces of a triangle that can be drawn.
#[inline(never)]
fn cut(columns: &Columns, half: Option<HalfSpace>, points: [[f32; 3]; 3], mut see: impl FnMut(&[Vertex; 3])) {
    let corners = points.map(|p| {
        let [x, y, z, w] = columns.apply(p);
        [x, y, z, w, half.map_or(1.0, |half| distance(half, p))]
    });
    for piece in clip(corners).triangles() {
        see(&piece.map(|corner| inside(&corner)));
    }
}

/// A half space of the world in a surface's coordinates.
fn local(plane: [f64; 4], draw: &Draw) -> HalfSpace {
    std::array::from_fn(|j| {
        let along = (0..3).map(|i| plane[i] * draw.world[i][j]).sum::<f64>();
        (along + if j == 3 { plane[3] } else { 0.0 }) as f32
    })
}

/// The part of a region that a box covers, and its depths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// First and last column and row \[pixel\].
    pub region: Region,
    /// Least and largest depth.
    pub depths: (f32, f32),
}

impl Reached {
    /// Whether nothing of the region is covered.
    fn is_empty(&self) -> bool {
        self.region.low[0] > self.region.high[0] || self.region.low[1] > self.region.high[1]
    }
}

/// Triangles below which their box is not looked at.
const SMALL: usize = 16;

/// What a box covers of the region, a pixel more all round for rounding; none where it reaches before the near plane.
fn reached(columns: &Columns, lens: &Lens, bounds: &Bounds) -> Option<Reached> {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for p in corners(*bounds) {
        let [x, y, z, w] = columns.apply(p);
        if !(w > 0.0 && z <= w && z >= 0.0) {
            return None;
        }
        let scale = 1.0 / w;
        for (k, x) in [x * scale, y * scale, z * scale].into_iter().enumerate() {
            (low[k], high[k]) = (low[k].min(x), high[k].max(x));
        }
    }
    let from = |k: usize| ((low[k] - 1.0).floor() as i32).max(lens.region.low[k]);
    let to = |k: usize| ((high[k] + 1.0) as i32).min(lens.region.high[k]);
    let region = Region { low: [from(0), from(1)], high: [to(0), to(1)] };
    Some(Reached { region, depths: (low[2], high[2]) })
}

/// The corners of a box.
fn corners([middle, size]: Bounds) -> impl Iterator<Item = [f32; 3]> {
    let side = move |corner: u32, k: usize| {
        if corner >> k & 1 == 0 { middle[k] - size[k] } else { middle[k] + size[k] }
    };
    (0..8).map(move |corner| [side(corner, 0), side(corner, 1), side(corner, 2)])
}

/// How a surface's box lies to the space that can be drawn and looked at. One that leaves the range of single precision lies
/// beside it: it cannot be drawn.
fn side(columns: &Columns, half: Option<HalfSpace>, lens: &Lens, surface: &Surface) -> Side {
    // A pixel more all round, so that rounding leaves nothing out.
    let ([left, bottom], [right, top]) =
        (lens.region.low.map(|x| (x - 1) as f32), lens.region.high.map(|x| (x + 2) as f32));
    let (mut beyond, mut cut) = (u32::MAX, false);
    for p in corners(surface.bounds) {
        let [x, y, z, w] = columns.apply(p);
        if !(x.abs() + y.abs() + z.abs() + w.abs()).is_finite() {
            return Side::Beside;
        }
        let behind = half.is_some_and(|half| distance(half, p) < 0.0);
        let faces = [
            x < w * left,
            x > w * right,
            y < w * bottom,
            y > w * top,
            z > w * (lens.deepest + DEEPER),
            z < 0.0,
            behind,
        ];
        beyond &= faces.iter().enumerate().fold(0, |bits, (bit, &is)| bits | u32::from(is) << bit);
        let reach = INNER * GUARD * w;
        let drawn = z <= INNER * w && z >= 0.0 && x.abs() <= reach && y.abs() <= reach && !behind;
        cut |= !drawn;
    }
    match (beyond, cut) {
        (1.., _) => Side::Beside,
        (0, true) => Side::Cut,
        (0, false) => Side::Whole,
    }
}

/// What is farther than the deepest by less than this is kept.
const DEEPER: f32 = 1e-4;
/// Boxes that reach nearer to the faces than this may have positions beyond them, rounding included.
const INNER: f32 = 0.999;
