//! The surface of a signed distance field as a mesh, by marching cubes.
//!
//! Samples, places on edges and normals are in single precision, as in MuJoCo.

use super::cube_triangles::TRIANGLES;
use super::source::RawMesh;
use crate::asset::AssetError;
use physics::plugin::Field;

/// Samples along the three half sizes of the box, added up.
const SAMPLES: f64 = 300.0;

/// An edge of a cube: the corners it joins, its axis, and the cell where it begins.
struct Edge {
    ends: [usize; 2],
    axis: usize,
    cell: [usize; 3],
}

/// The edges in the order in which vertices are made; corners are numbered by bits x, y, z.
const EDGES: [Edge; 12] = [
    Edge { ends: [0, 1], axis: 0, cell: [0, 0, 0] },
    Edge { ends: [2, 3], axis: 0, cell: [0, 1, 0] },
    Edge { ends: [4, 5], axis: 0, cell: [0, 0, 1] },
    Edge { ends: [6, 7], axis: 0, cell: [0, 1, 1] },
    Edge { ends: [0, 2], axis: 1, cell: [0, 0, 0] },
    Edge { ends: [1, 3], axis: 1, cell: [1, 0, 0] },
    Edge { ends: [4, 6], axis: 1, cell: [0, 0, 1] },
    Edge { ends: [5, 7], axis: 1, cell: [1, 0, 1] },
    Edge { ends: [0, 4], axis: 2, cell: [0, 0, 0] },
    Edge { ends: [1, 5], axis: 2, cell: [1, 0, 0] },
    Edge { ends: [2, 6], axis: 2, cell: [0, 1, 0] },
    Edge { ends: [3, 7], axis: 2, cell: [1, 1, 0] },
];

/// The mesh of the points at distance zero.
///
/// # Errors
/// The field is not finite, or its box is flat.
pub fn surface(field: &dyn Field) -> Result<RawMesh, AssetError> {
    let bounds = field.bounds();
    let half = [bounds[3], bounds[4], bounds[5]];
    let total = half[0] + half[1] + half[2];
    let count = half.map(|h| (SAMPLES / total * h).floor() + 1.0);
    if count.iter().any(|n| !(2.0..=SAMPLES + 1.0).contains(n)) {
        return Err(AssetError::geometry("the box of the signed distance field is empty, or too flat"));
    }
    let grid = Grid { count: count.map(|n| n as usize), bounds };
    let samples = grid.sample(field)?;
    let mut march = March { grid: &grid, vertices: Vec::new(), normals: Vec::new(), faces: Vec::new() };
    march.run(&samples);
    let March { vertices, normals, faces, .. } = march;
    let vert = vertices.iter().flat_map(|v| grid.place(*v)).collect();
    let normal = normals.into_iter().flat_map(unit).collect();
    let face = faces.into_iter().map(|v| v as i32).collect();
    Ok(RawMesh { vert, normal, face, ..RawMesh::default() })
}

/// Where samples are taken.
struct Grid {
    count: [usize; 3],
    /// Centre and half sizes of the box.
    bounds: [f64; 6],
}

impl Grid {
    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    fn sample(&self, field: &dyn Field) -> Result<Vec<f32>, AssetError> {
        let [nx, ny, nz] = self.count;
        let mut samples = Vec::with_capacity(nx * ny * nz);
        for (z, y) in (0..nz).flat_map(|z| (0..ny).map(move |y| (z, y))) {
            samples.extend((0..nx).map(|x| {
                let at = [x, y, z];
                let point = std::array::from_fn(|k| {
                    let (centre, half) = (self.bounds[k], self.bounds[k + 3]);
                    centre - half + 2.0 * half * at[k] as f64 / (self.count[k] - 1) as f64
                });
                field.distance(point) as f32
            }));
        }
        match samples.iter().any(|x| x.is_nan()) {
            true => {
                Err(AssetError::geometry("the signed distance field is not a number somewhere in its box"))
            }
            false => Ok(samples),
        }
    }

    /// Metres of a place counted in samples.
    fn place(&self, at: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|k| {
            let (centre, half) = (self.bounds[k], self.bounds[k + 3]);
            (2.0 * half * f64::from(at[k]) / (self.count[k] - 1) as f64 + centre - half) as f32
        })
    }
}

/// The mesh while it grows.
struct March<'g> {
    grid: &'g Grid,
    /// In numbers of samples.
    vertices: Vec<[f32; 3]>,
    /// Sums over triangles.
    normals: Vec<[f32; 3]>,
    faces: Vec<u32>,
}

impl March<'_> {
    fn run(&mut self, samples: &[f32]) {
        let [nx, ny, nz] = self.grid.count;
        // Vertices on the edges that begin in a cell, of two layers of cells.
        let mut layers = vec![[0_u32; 3]; nx * ny * 2];
        for z in 0..nz - 1 {
            for (y, x) in (0..ny - 1).flat_map(|y| (0..nx - 1).map(move |x| (y, x))) {
                let values: [f32; 8] = std::array::from_fn(|corner| {
                    samples[self.grid.index([x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)])]
                });
                self.cube([x, y, z], &values, &mut layers);
            }
        }
    }

    fn cube(&mut self, at: [usize; 3], values: &[f32; 8], layers: &mut [[u32; 3]]) {
        let inside = (0..8).fold(0, |bits, corner| bits | usize::from(values[corner] < 0.0) << corner);
        if inside == 0 || inside == 255 {
            return;
        }
        let [nx, ny, _] = self.grid.count;
        let slot = |cell: [usize; 3]| {
            let [x, y, z] = [0, 1, 2].map(|k| at[k] + cell[k]);
            nx * ny * (z % 2) + y * nx + x
        };
        for Edge { ends: [a, b], axis, cell } in &EDGES {
            // Cubes before this one have made the others.
            let first = (0..3).all(|k| k == *axis || cell[k] == 1 || at[k] == 0);
            let (a, b) = (values[*a], values[*b]);
            if first && (a < 0.0) != (b < 0.0) {
                let mut vertex: [f32; 3] = std::array::from_fn(|k| (at[k] + cell[k]) as f32);
                vertex[*axis] += a / (a - b);
                layers[slot(*cell)][*axis] = self.vertices.len() as u32;
                self.vertices.push(vertex);
                self.normals.push([0.0; 3]);
            }
        }
        let packed = TRIANGLES[inside];
        for triangle in 0..(packed & 15) as usize {
            let corners: [u32; 3] = std::array::from_fn(|k| {
                let edge = &EDGES[(packed >> (4 + 4 * (3 * triangle + k)) & 15) as usize];
                layers[slot(edge.cell)][edge.axis]
            });
            self.faces.extend(corners);
            self.add_normal(corners);
        }
    }

    fn add_normal(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|v| self.vertices[v as usize]);
        let from = |p: [f32; 3]| -> [f32; 3] { std::array::from_fn(|k| p[k] - b[k]) };
        let (u, v) = (from(c), from(a));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for corner in corners {
            let sum = &mut self.normals[corner as usize];
            (0..3).for_each(|k| sum[k] += normal[k]);
        }
    }
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}
