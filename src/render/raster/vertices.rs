//! Positions of a surface in the window.

use super::clip::{Corner, GUARD};
use super::window::Columns;
use wide::f32x4;

/// Steps of window coordinates in a pixel.
pub const SUBPIXELS: i32 = 256;

/// One position in the window.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// Column from the left [1/256 pixel].
    pub x: i32,
    /// Row from below [1/256 pixel].
    pub y: i32,
    /// Reversed depth.
    pub z: f32,
    /// Column and row, not rounded [pixel].
    pub at: [f32; 2],
    /// Bits of the faces that it lies beyond; its other numbers say nothing then.
    pub beyond: u32,
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

/// The window positions of `positions`, written over `out`.
pub fn project(columns: &Columns, mirror: Option<HalfSpace>, positions: &[[f32; 3]], out: &mut [Vertex]) {
    let [a, b, c, d] = columns.0.map(f32x4::new);
    for (p, out) in positions.iter().zip(&mut *out) {
        let corner = a * f32x4::splat(p[0]) + b * f32x4::splat(p[1]) + c * f32x4::splat(p[2]) + d;
        *out = window(corner.to_array());
    }
    if let Some(half) = mirror {
        for (&p, out) in positions.iter().zip(out) {
            out.beyond |= if distance(half, p) < 0.0 { face::MIRROR } else { 0 };
        }
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
    let limit = GUARD * SUBPIXELS as f32;
    let snap = |x: f32| (x * SUBPIXELS as f32).clamp(-limit, limit).round_ties_even() as i32;
    let at = [x * scale, y * scale];
    Vertex { x: snap(at[0]), y: snap(at[1]), at, z: (z * scale).clamp(0.0, 1.0), beyond: 0 }
}

/// Division, snapping to the grid, and the faces beyond which the corner lies.
fn window([x, y, z, w]: [f32; 4]) -> Vertex {
    let reach = GUARD * w;
    let faces = [
        (z > w, face::NEAR),
        (z < 0.0, face::FAR),
        (x < -reach, face::LEFT),
        (x > reach, face::RIGHT),
        (y < -reach, face::BELOW),
        (y > reach, face::ABOVE),
    ];
    let beyond = faces.iter().fold(0, |bits, &(is, bit)| bits | if is { bit } else { 0 });
    let scale = 1.0 / w;
    let at = f32x4::new([x, y, 0.0, 0.0]) * f32x4::splat(scale);
    let [x, y, ..] = (at * f32x4::splat(SUBPIXELS as f32)).fast_round_int().to_array();
    let [column, row, ..] = at.to_array();
    // A w of 0 or less is beyond the near plane, whose z is below every such w only there.
    let beyond = if w > 0.0 { beyond } else { beyond | face::NEAR };
    Vertex { x, y, at: [column, row], z: z * scale, beyond }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_snapped_and_marked() {
        let identity =
            Columns([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.5, 0.0]]);
        let positions = [[3.0, 5.0, 2.0], [1.0, 1.0, -1.0], [1e9, 0.0, 1.0], [0.0, 0.0, 0.25]];
        let mut out = [Vertex::default(); 4];
        project(&identity, Some([0.0, 1.0, 0.0, -0.5]), &positions, &mut out);
        assert_eq!((out[0].x, out[0].y, out[0].z, out[0].beyond), (384, 640, 0.25, 0));
        assert!(out[1].beyond & face::NEAR != 0);
        assert_eq!(out[2].beyond, face::RIGHT | face::MIRROR);
        assert_eq!(out[3].beyond & face::NEAR, face::NEAR);
    }
}
