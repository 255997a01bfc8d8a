//! Collects triangles into a surface, with every position, normal and texture coordinate stored once.

use super::surface::{Corners, HALVES, Surface};
use std::collections::HashMap;

/// What a triangle needs at one corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Position in the surface's coordinates.
    pub position: [f32; 3],
    /// Unit normal.
    pub normal: [f32; 3],
    /// Texture coordinates.
    pub texcoord: [f32; 2],
}

/// A surface under construction. Rows with equal bits become one row; -0 counts as 0.
#[derive(Default)]
pub(super) struct Builder {
    surface: Surface,
    positions: HashMap<[u32; 3], u32>,
    normals: HashMap<[u32; 3], u32>,
    texcoords: HashMap<[u32; 2], u32>,
}

impl Builder {
    /// Adds a triangle, counter-clockwise from outside.
    pub fn triangle(&mut self, corners: [Corner; 3]) {
        let (position, lit) = self.rows(corners);
        self.surface.push(position, lit.normal, lit.texcoord);
    }

    /// The rows of a triangle's corners.
    fn rows(&mut self, corners: [Corner; 3]) -> ([u32; 3], Corners) {
        let surface = &mut self.surface;
        let position = corners.map(|c| row(&mut self.positions, &mut surface.positions, c.position));
        let normal = corners.map(|c| row(&mut self.normals, &mut surface.normals, c.normal));
        let texcoord = corners.map(|c| row(&mut self.texcoords, &mut surface.texcoords, c.texcoord));
        (position, Corners { normal, texcoord })
    }

    /// Adds a quadrilateral as two triangles.
    pub fn quad(&mut self, quad: [Corner; 4]) {
        for (corners, sides) in HALVES {
            let (position, lit) = self.rows(corners.map(|k| quad[k]));
            self.surface.push_part(position, lit, sides);
        }
    }

    /// The surface, with its bounds.
    pub fn finish(mut self) -> Surface {
        self.surface.finish();
        self.surface
    }
}

/// The number of a row, appended unless it is there already.
fn row<const N: usize>(known: &mut HashMap<[u32; N], u32>, rows: &mut Vec<[f32; N]>, value: [f32; N]) -> u32 {
    let value = value.map(|x| x + 0.0);
    *known.entry(value.map(f32::to_bits)).or_insert_with(|| {
        rows.push(value);
        (rows.len() - 1) as u32
    })
}
