//! Shapes with flat sides: the unit box, the triangle, planes as grids.

use super::builder::{Builder, Corner};
use super::surface::Surface;

/// The box from -1 to 1 along every axis, each side cut into `quads` by `quads` squares.
pub(super) fn cuboid(quads: usize) -> Surface {
    // Of each side: its axis, the sign of its normal, and the two axes along which its squares lie.
    const SIDES: [(usize, f32, [usize; 2]); 6] = [
        (2, 1.0, [0, 1]),
        (2, -1.0, [0, 1]),
        (0, 1.0, [1, 2]),
        (0, -1.0, [1, 2]),
        (1, -1.0, [0, 2]),
        (1, 1.0, [0, 2]),
    ];
    let step = 2.0 / quads as f32;
    let mut builder = Builder::default();
    for (i, j) in (0..quads).flat_map(|i| (0..quads).map(move |j| (i, j))) {
        for (axis, sign, [across, along]) in SIDES {
            let mut normal = [0.0; 3];
            normal[axis] = sign;
            let corner = |a: usize, b: usize| {
                let mut position = normal;
                position[across] = step * a as f32 - 1.0;
                position[along] = step * b as f32 - 1.0;
                let v = 1.0 - b as f64 / quads as f64;
                Corner { position, normal, texcoord: [(a as f64 / quads as f64) as f32, v as f32] }
            };
            // Across and along turn counter-clockwise about the normal of the sides +z, +x and -y.
            let (low, high) = match (axis, sign > 0.0) {
                (0 | 2, true) | (1, false) => (j, j + 1),
                _ => (j + 1, j),
            };
            builder.quad([corner(i, low), corner(i + 1, low), corner(i + 1, high), corner(i, high)]);
        }
    }
    builder.finish()
}

/// The triangle with corners at the origin and at 1 along x and y.
pub(super) fn triangle() -> Surface {
    let corner =
        |x: f32, y: f32, v: f32| Corner { position: [x, y, 0.0], normal: [0.0, 0.0, 1.0], texcoord: [x, v] };
    let mut builder = Builder::default();
    builder.triangle([corner(0.0, 0.0, 1.0), corner(1.0, 0.0, 1.0), corner(0.0, 1.0, 0.0)]);
    builder.finish()
}

/// What the grid of a plane depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlaneShape {
    /// Half sizes along x and y, not positive where it is infinite, and half the spacing of its grid \[m\].
    pub size: [f64; 3],
    /// Repetitions of the texture; 0 without a material.
    pub texrepeat: [f32; 2],
    /// Distance of the far plane \[m\].
    pub far: f64,
}

/// Most cells of a plane along one axis.
const MAX_CELLS: usize = 200;

/// The grid of a plane in the frame of its geom. Strips without width, which cannot be seen, are left out.
pub(super) fn plane(shape: PlaneShape) -> Surface {
    let [xs, ys] = [0, 1].map(|axis| {
        let mut lines = grid_lines(shape, axis);
        lines.dedup_by_key(|x| *x as f32);
        lines
    });
    let mut surface = Surface { normals: vec![[0.0, 0.0, 1.0]], ..Surface::default() };
    for &x in &xs {
        for &y in &ys {
            surface.positions.push([x as f32, y as f32, 0.0]);
            let v = match shape.size[1] > 0.0 {
                true => 1.0 - (y + shape.size[1]) / (2.0 * shape.size[1]),
                false => -0.5 * y,
            };
            let u = match shape.size[0] > 0.0 {
                true => (x + shape.size[0]) / (2.0 * shape.size[0]),
                false => 0.5 * x,
            };
            surface.texcoords.push([u as f32, v as f32]);
        }
    }
    let rows = ys.len() as u32;
    for i in 0..xs.len() as u32 - 1 {
        for j in 0..rows - 1 {
            let low = i * rows + j;
            let quad = [low, low + rows, low + rows + 1, low + 1];
            surface.push_quad(quad, 0, quad);
        }
    }
    surface.finish();
    surface
}

/// Where the lines of a plane's grid lie along one axis.
fn grid_lines(shape: PlaneShape, axis: usize) -> Vec<f64> {
    let half = shape.size[axis];
    let reserve = (MAX_CELLS - 2) as f64;
    if half > 0.0 {
        // An even number of strips as wide as asked for, and at both ends a strip of what is left.
        let spacing = shape.size[2].max(half / reserve);
        let strips = (half / spacing.max(1e-15)).floor() as usize / 2 * 2;
        let pad = half - strips as f64 * spacing;
        let inner = (0..=strips).map(|i| -half + pad + i as f64 * spacing * 2.0);
        let last = -half + pad + strips as f64 * spacing * 2.0 + pad;
        return std::iter::once(-half).chain(inner).chain([last]).collect();
    }
    let stride = match shape.texrepeat[axis] {
        repeat if repeat > 0.0 => f64::from(2.0 / repeat),
        _ => 2.1 * shape.far / reserve,
    };
    let cell = (2.1 * shape.far + 2.0 * stride) / MAX_CELLS as f64;
    (0..=MAX_CELLS).map(|i| cell * i as f64 - cell * (MAX_CELLS / 2) as f64).collect()
}
