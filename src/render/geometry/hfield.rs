//! Height fields: flat-shaded relief, four sides, and a bottom.

use super::surface::{Surface, face_normal};

/// What a height field's surface depends on.
pub(super) struct Relief<'a> {
    /// Half width, half depth, height of the relief, depth of the base \[m\].
    pub size: [f32; 4],
    /// Number of rows, along y, at least 2.
    pub rows: usize,
    /// Number of columns, along x, at least 2.
    pub columns: usize,
    /// Elevations from 0 to 1, row by row.
    pub data: &'a [f32],
    /// Squares along a side of the bottom.
    pub quads: usize,
}

impl Relief<'_> {
    fn x(&self, column: usize) -> f32 {
        self.size[0] * (column as f32 / (0.5 * (self.columns - 1) as f32) - 1.0)
    }

    fn y(&self, row: usize) -> f32 {
        self.size[1] * (row as f32 / (0.5 * (self.rows - 1) as f32) - 1.0)
    }
}

/// The surface of a height field in the frame of its geom.
pub(super) fn hfield(relief: &Relief) -> Surface {
    let mut surface = Surface::default();
    for r in 0..relief.rows {
        for c in 0..relief.columns {
            let z = relief.data[r * relief.columns + c] * relief.size[2];
            surface.positions.push([relief.x(c), relief.y(r), z]);
        }
    }
    add_relief(&mut surface, relief);
    add_sides(&mut surface, relief);
    add_bottom(&mut surface, relief);
    surface.finish();
    surface
}

/// Two triangles a cell. Along a row of cells they form a strip that zigzags between the cell's two rows of vertices.
fn add_relief(surface: &mut Surface, relief: &Relief) {
    let at = |r: usize, c: usize| (r * relief.columns + c) as u32;
    for r in 0..relief.rows - 1 {
        for c in 0..relief.columns - 1 {
            let [near, far] = [at(r, c), at(r + 1, c)];
            let [next, far_next] = [at(r, c + 1), at(r + 1, c + 1)];
            for position in [[far, near, far_next], [near, next, far_next]] {
                let [a, b, d] = position.map(|row| surface.positions[row as usize]);
                let normal = [surface.normals.len() as u32; 3];
                surface.normals.push(face_normal(a, b, d));
                surface.push(position, normal, [0; 3]);
            }
        }
    }
}

/// The four walls from the relief's edge down to the base.
fn add_sides(surface: &mut Surface, relief: &Relief) {
    let base = -relief.size[3];
    let (last_row, last_column) = (relief.rows - 1, relief.columns - 1);
    let at = |r: usize, c: usize| r * relief.columns + c;
    let walls = [
        ([-1.0, 0.0, 0.0], (0..=last_row).rev().map(|r| at(r, 0)).collect::<Vec<_>>()),
        ([1.0, 0.0, 0.0], (0..=last_row).map(|r| at(r, last_column)).collect()),
        ([0.0, -1.0, 0.0], (0..=last_column).map(|c| at(0, c)).collect()),
        ([0.0, 1.0, 0.0], (0..=last_column).rev().map(|c| at(last_row, c)).collect()),
    ];
    for (normal, edge) in walls {
        let foot = surface.positions.len() as u32;
        for &top in &edge {
            let [x, y, _] = surface.positions[top];
            surface.positions.push([x, y, base]);
        }
        let row = surface.normals.len() as u32;
        surface.normals.push(normal);
        for (i, pair) in (foot..).zip(edge.windows(2)) {
            surface.push_quad([i, i + 1, pair[1] as u32, pair[0] as u32], row, [0; 4]);
        }
    }
}

/// The base, seen from below.
fn add_bottom(surface: &mut Surface, relief: &Relief) {
    let quads = relief.quads;
    let coordinate = |i: usize, half: f32| half * (i as f32 / (0.5 * quads as f32) - 1.0);
    let first = surface.positions.len() as u32;
    for r in 0..=quads {
        for c in 0..=quads {
            let [x, y] = [coordinate(c, relief.size[0]), coordinate(r, relief.size[1])];
            surface.positions.push([x, y, -relief.size[3]]);
        }
    }
    let normal = surface.normals.len() as u32;
    surface.normals.push([0.0, 0.0, -1.0]);
    let line = quads as u32 + 1;
    for r in 0..quads as u32 {
        for c in 0..quads as u32 {
            let low = first + r * line + c;
            surface.push_quad([low, low + line, low + line + 1, low + 1], normal, [0; 4]);
        }
    }
}
