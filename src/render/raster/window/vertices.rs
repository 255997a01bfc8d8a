//! Positions of a surface in the window.

use super::clip::{Corner, GUARD};
use super::projection::Columns;
use wide::bytemuck::cast;
use wide::{f32x4, i32x4};

/// Steps of window coordinates in a pixel.
pub const SUBPIXELS: i32 = 256;
/// 1.5 * 2^23: adding it to a number within 2^22 rounds that to an integer, ties to even, on every machine. The conversions of
/// vectors round ties to even or away from zero, as each processor does.
const ROUND: f32 = 12_582_912.0;

/// One position in the window: column from the left and row from below, reversed depth, and bits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    lanes: f32x4,
}

impl Vertex {
    /// The position in the space that can be drawn that is nearest to one in the window \[pixel\]; its origin for no number.
    pub fn new(at: [f32; 2], z: f32) -> Self {
        let [x, y] = at.map(|x| if x.is_nan() { 0.0 } else { x.clamp(-GUARD, GUARD) });
        Vertex { lanes: f32x4::new([x, y, z, 0.0]) }
    }

    /// Column and row \[pixel\].
    #[inline]
    pub fn at(&self) -> [f32; 2] {
        let [x, y, ..] = self.lanes.to_array();
        [x, y]
    }

    /// Reversed depth.
    #[inline]
    pub fn z(&self) -> f32 {
        self.lanes.to_array()[2]
    }

    /// Bits of the faces that it lies beyond; its other numbers say nothing then.
    #[inline]
    pub fn beyond(&self) -> u32 {
        self.lanes.to_array()[3].to_bits()
    }

    /// Column and row in the first two lanes \[1/256 pixel\].
    #[inline]
    pub fn on_grid(&self) -> i32x4 {
        on_grid(self.lanes)
    }
}

#[inline]
fn on_grid(lanes: f32x4) -> i32x4 {
    let rounded: i32x4 = cast(lanes * f32x4::splat(SUBPIXELS as f32) + f32x4::splat(ROUND));
    rounded - i32x4::splat(ROUND.to_bits() as i32)
}

/// Least and largest column and row of three positions that can be drawn \[1/256 pixel\]. Rounding keeps their order and
/// forgets the sign of zero, the only thing that minima of vectors leave open for numbers.
#[inline]
pub fn box_on_grid([p, q, r]: &[Vertex; 3]) -> [i32x4; 2] {
    let low = p.lanes.fast_min(q.lanes).fast_min(r.lanes);
    let high = p.lanes.fast_max(q.lanes).fast_max(r.lanes);
    [on_grid(low), on_grid(high)]
}

/// Bits of [`Vertex::beyond`].
mod face {
    pub const NEAR: u32 = 1;
    pub const FAR: u32 = 2;
    pub const LEFT: u32 = 4;
    pub const RIGHT: u32 = 8;
    pub const BELOW: u32 = 16;
    pub const ABOVE: u32 = 32;
    pub const MIRROR: u32 = 64;
}

/// A half space that is drawn: points with `normal . p + shift >= 0`, in the surface's coordinates.
pub type HalfSpace = [f32; 4];

/// The window positions of some of `positions`, written over `out`; all of them can be drawn.
#[inline]
pub fn project_whole(columns: &Columns, positions: &[[f32; 3]], rows: &[u32], out: &mut [Vertex]) {
    let [a, b, c, d] = columns.0.map(f32x4::new);
    for (&row, out) in rows.iter().zip(out) {
        let p = positions[row as usize];
        let corner = a * f32x4::splat(p[0]) + b * f32x4::splat(p[1]) + c * f32x4::splat(p[2]) + d;
        out.lanes = corner * f32x4::splat(1.0 / corner.to_array()[3]) * DRAWN;
    }
}

/// Clears the bits.
const DRAWN: f32x4 = f32x4::new([1.0, 1.0, 1.0, 0.0]);

/// The window positions of some of `positions`, written over `out`, marked where they cannot be drawn.
pub fn project(
    columns: &Columns,
    mirror: Option<HalfSpace>,
    (positions, rows): (&[[f32; 3]], &[u32]),
    out: &mut [Vertex],
) {
    let [a, b, c, d] = columns.0.map(f32x4::new);
    for (&row, out) in rows.iter().zip(out) {
        let p = positions[row as usize];
        let corner = a * f32x4::splat(p[0]) + b * f32x4::splat(p[1]) + c * f32x4::splat(p[2]) + d;
        let behind = mirror.is_some_and(|half| distance(half, p) < 0.0);
        let bits = beyond(corner.to_array()) | if behind { face::MIRROR } else { 0 };
        let mut lanes = (corner * f32x4::splat(1.0 / corner.to_array()[3])).to_array();
        lanes[3] = f32::from_bits(bits);
        out.lanes = f32x4::new(lanes);
    }
}

/// Signed distance of a point from the face of a half space.
pub fn distance(half: HalfSpace, p: [f32; 3]) -> f32 {
    half[0] * p[0] + half[1] * p[1] + half[2] * p[2] + half[3]
}

/// The window position of a corner that has been cut to the space that can be drawn.
pub fn inside(corner: &Corner) -> Vertex {
    let [x, y, z, w, _] = *corner;
    let scale = 1.0 / w;
    Vertex::new([x * scale, y * scale], (z * scale).clamp(0.0, 1.0))
}

/// Bits of the faces beyond which a corner lies.
fn beyond([x, y, z, w]: [f32; 4]) -> u32 {
    let reach = GUARD * w;
    let faces = [
        // A w of 0 or less is before the near plane.
        (z > w || w.is_nan() || w <= 0.0, face::NEAR),
        (z < 0.0, face::FAR),
        (x < -reach, face::LEFT),
        (x > reach, face::RIGHT),
        (y < -reach, face::BELOW),
        (y > reach, face::ABOVE),
    ];
    faces.iter().fold(0, |bits, &(is, bit)| bits | if is { bit } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_are_snapped_to_even_steps() {
        let half = 0.5 / SUBPIXELS as f32;
        let snapped = |x: f32, y: f32| {
            let [x, y, ..] = Vertex::new([x, y], 0.5).on_grid().to_array();
            [x, y]
        };
        let found = [1.0, 3.0, 5.0, -7.0].map(|x| snapped(x * half, -x * half));
        assert_eq!(found, [[0, 0], [2, -2], [2, -2], [-4, 4]]);
        assert_eq!(snapped(GUARD, -GUARD), [GUARD as i32 * SUBPIXELS, -GUARD as i32 * SUBPIXELS]);
    }

    #[test]
    fn positions_are_snapped_and_marked() {
        let identity =
            Columns([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.5, 0.0]]);
        let positions = [[3.0, 5.0, 2.0], [1.0, 1.0, -1.0], [1e9, 0.0, 1.0], [0.0, 0.0, 0.25]];
        let mut out = [Vertex::default(); 4];
        project(&identity, Some([0.0, 1.0, 0.0, -0.5]), (&positions, &[0, 1, 2, 3]), &mut out);
        assert_eq!((out[0].at(), out[0].z(), out[0].beyond()), ([1.5, 2.5], 0.25, 0));
        assert_eq!(out[0].on_grid().to_array()[..2], [384, 640]);
        assert!(out[1].beyond() & face::NEAR != 0);
        assert_eq!(out[2].beyond(), face::RIGHT | face::MIRROR);
        assert_eq!(out[3].beyond() & face::NEAR, face::NEAR);
        let mut whole = [Vertex::default()];
        project_whole(&identity, &positions, &[0], &mut whole);
        assert_eq!(whole[0], out[0]);
    }
}
