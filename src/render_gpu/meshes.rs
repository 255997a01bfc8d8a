//! The surfaces of a model in the memory of the GPU.

use crate::device::Gpu;
use crate::growing::Growing;
use render::Assets;
use render::geometry::Surface;
use std::collections::HashMap;
use std::sync::Arc;
use wgpu::{BufferUsages, VertexAttribute, VertexBufferLayout, VertexFormat, VertexStepMode};

/// Position, normal and texture coordinates of a corner.
type Corner = [f32; 8];

/// How pipelines read corners.
pub const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
    array_stride: size_of::<Corner>() as u64,
    step_mode: VertexStepMode::Vertex,
    attributes: &[
        VertexAttribute { format: VertexFormat::Float32x3, offset: 0, shader_location: 0 },
        VertexAttribute { format: VertexFormat::Float32x3, offset: 12, shader_location: 1 },
        VertexAttribute { format: VertexFormat::Float32x2, offset: 24, shader_location: 2 },
    ],
};

/// Where a surface lies in the buffers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Its first index.
    pub first_index: u32,
    /// Three indices a triangle.
    pub indices: u32,
    /// Its first corner.
    pub first_corner: i32,
    corners: u32,
}

/// Corners and triangles of all surfaces of a model.
#[derive(Clone, Debug)]
pub struct Meshes {
    surfaces: Vec<Arc<Surface>>,
    places: Vec<Place>,
    corners: Growing,
    indices: Growing,
}

impl Meshes {
    /// No surfaces yet.
    pub fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        Meshes {
            surfaces: Vec::new(),
            places: Vec::new(),
            corners: Growing::new(device, "corners", BufferUsages::VERTEX | BufferUsages::COPY_DST),
            indices: Growing::new(device, "triangles", BufferUsages::INDEX | BufferUsages::COPY_DST),
        }
    }

    /// Uploads what is not there yet: all surfaces of another model, and of the same one those that changed.
    pub fn update(&mut self, gpu: &Gpu, assets: &Assets) {
        if self.surfaces.len() != assets.surfaces.len() {
            return self.replace(gpu, assets);
        }
        for index in 0..self.surfaces.len() {
            let surface = &assets.surfaces[index];
            if Arc::ptr_eq(&self.surfaces[index], surface) {
                continue;
            }
            let flat = Flat::of(surface);
            let place = self.places[index];
            if (flat.corners.len(), flat.indices.len()) != (place.corners as usize, place.indices as usize) {
                return self.replace(gpu, assets);
            }
            self.write(gpu, place, &flat);
            self.surfaces[index] = surface.clone();
        }
    }

    /// Where a surface lies.
    pub fn place(&self, surface: usize) -> Place {
        self.places[surface]
    }

    /// Has a pass read corners and triangles from here.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.corners.buffer().slice(..));
        pass.set_index_buffer(self.indices.buffer().slice(..), wgpu::IndexFormat::Uint32);
    }

    fn replace(&mut self, gpu: &Gpu, assets: &Assets) {
        let flat: Vec<Flat> = assets.surfaces.iter().map(|surface| Flat::of(surface)).collect();
        let (mut first_corner, mut first_index) = (0, 0);
        self.places.clear();
        for flat in &flat {
            let (corners, indices) = (flat.corners.len() as u32, flat.indices.len() as u32);
            self.places.push(Place { first_index, indices, first_corner: first_corner as i32, corners });
            first_corner += corners;
            first_index += indices;
        }
        self.corners.reserve(&gpu.device, u64::from(first_corner) * size_of::<Corner>() as u64);
        self.indices.reserve(&gpu.device, u64::from(first_index) * size_of::<u32>() as u64);
        for (place, flat) in self.places.iter().zip(&flat) {
            self.write(gpu, *place, flat);
        }
        self.surfaces.clone_from(&assets.surfaces);
    }

    fn write(&self, gpu: &Gpu, place: Place, flat: &Flat) {
        let corner = place.first_corner as u64 * size_of::<Corner>() as u64;
        let index = u64::from(place.first_index) * size_of::<u32>() as u64;
        gpu.queue.write_buffer(self.corners.buffer(), corner, bytemuck::cast_slice(&flat.corners));
        gpu.queue.write_buffer(self.indices.buffer(), index, bytemuck::cast_slice(&flat.indices));
    }
}

/// A surface whose corners have one index each.
struct Flat {
    corners: Vec<Corner>,
    indices: Vec<u32>,
}

impl Flat {
    fn of(surface: &Surface) -> Self {
        let mut known: HashMap<[u32; 3], u32> = HashMap::new();
        let mut flat = Flat { corners: Vec::new(), indices: Vec::with_capacity(3 * surface.faces.len()) };
        for (position, rows) in surface.faces.iter().zip(&surface.corners) {
            for k in 0..3 {
                let rows = [position[k], rows.normal[k], rows.texcoord[k]];
                let index = *known.entry(rows).or_insert_with(|| {
                    let [p, n, t] = rows.map(|row| row as usize);
                    let [x, y, z] = surface.positions[p];
                    let [i, j, k] = surface.normals[n];
                    let [u, v] = if surface.texcoords.is_empty() { [0.0; 2] } else { surface.texcoords[t] };
                    flat.corners.push([x, y, z, i, j, k, u, v]);
                    flat.corners.len() as u32 - 1
                });
                flat.indices.push(index);
            }
        }
        flat
    }
}
