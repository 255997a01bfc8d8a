//! The surfaces of a batch in the memory of the GPU.

use crate::device::Gpu;
use crate::growing::Growing;
use render::Assets;
use render::geometry::Surface;
use std::collections::{HashMap, HashSet};
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

/// A surface and where it lies.
#[derive(Clone, Debug)]
struct Slot {
    surface: Arc<Surface>,
    place: Place,
}

/// Corners and triangles of the surfaces of a batch.
#[derive(Clone, Debug)]
pub struct Meshes {
    slots: Vec<Slot>,
    /// Numbers of the slots, by the address of their surface.
    numbers: HashMap<usize, usize>,
    corners: Growing,
    indices: Growing,
}

impl Meshes {
    /// No surfaces yet.
    pub fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        Meshes {
            slots: Vec::new(),
            numbers: HashMap::new(),
            corners: Growing::new(device, "corners", BufferUsages::VERTEX | BufferUsages::COPY_DST),
            indices: Growing::new(device, "triangles", BufferUsages::INDEX | BufferUsages::COPY_DST),
        }
    }

    /// Uploads the surfaces that are not there yet. One that takes the place of another of its size, such as one that was
    /// edited, is uploaded alone; others make all be uploaded.
    pub fn update(&mut self, gpu: &Gpu, assets: &[&Assets]) {
        let mut wanted = HashSet::new();
        let all = assets.iter().flat_map(|assets| &assets.surfaces);
        let all: Vec<_> = all.filter(|surface| wanted.insert(address(surface))).collect();
        for surface in &all {
            if self.numbers.contains_key(&address(surface)) {
                continue;
            }
            let flat = Flat::of(surface);
            let sizes = (flat.corners.len() as u32, flat.indices.len() as u32);
            let free = self.slots.iter().position(|slot| {
                (slot.place.corners, slot.place.indices) == sizes && !wanted.contains(&address(&slot.surface))
            });
            let Some(number) = free else { return self.replace(gpu, &all) };
            self.write(gpu, self.slots[number].place, &flat);
            self.numbers.remove(&address(&self.slots[number].surface));
            self.numbers.insert(address(surface), number);
            self.slots[number].surface = Arc::clone(surface);
        }
    }

    /// The number of a surface that was uploaded.
    pub fn number(&self, surface: &Arc<Surface>) -> usize {
        self.numbers[&address(surface)]
    }

    /// Where a surface lies.
    pub fn place(&self, number: usize) -> Place {
        self.slots[number].place
    }

    /// Has a pass read corners and triangles from here.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.corners.buffer().slice(..));
        pass.set_index_buffer(self.indices.buffer().slice(..), wgpu::IndexFormat::Uint32);
    }

    fn replace(&mut self, gpu: &Gpu, surfaces: &[&Arc<Surface>]) {
        let flat: Vec<Flat> = surfaces.iter().map(|surface| Flat::of(surface)).collect();
        let (mut first_corner, mut first_index) = (0, 0);
        self.slots.clear();
        self.numbers.clear();
        for (surface, flat) in surfaces.iter().zip(&flat) {
            let (corners, indices) = (flat.corners.len() as u32, flat.indices.len() as u32);
            let place = Place { first_index, indices, first_corner: first_corner as i32, corners };
            self.numbers.insert(address(surface), self.slots.len());
            self.slots.push(Slot { surface: Arc::clone(surface), place });
            first_corner += corners;
            first_index += indices;
        }
        self.corners.reserve(&gpu.device, u64::from(first_corner) * size_of::<Corner>() as u64);
        self.indices.reserve(&gpu.device, u64::from(first_index) * size_of::<u32>() as u64);
        for (slot, flat) in self.slots.iter().zip(&flat) {
            self.write(gpu, slot.place, flat);
        }
    }

    fn write(&self, gpu: &Gpu, place: Place, flat: &Flat) {
        let corner = place.first_corner as u64 * size_of::<Corner>() as u64;
        let index = u64::from(place.first_index) * size_of::<u32>() as u64;
        gpu.queue.write_buffer(self.corners.buffer(), corner, bytemuck::cast_slice(&flat.corners));
        gpu.queue.write_buffer(self.indices.buffer(), index, bytemuck::cast_slice(&flat.indices));
    }
}

/// What tells a surface from the others that are kept.
fn address(surface: &Arc<Surface>) -> usize {
    Arc::as_ptr(surface).addr()
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
