//! Pictures from the memory of the GPU.

use crate::atlas::{Atlas, Grid};
use crate::device::Gpu;
use crate::error::GpuError;
use crate::growing::Growing;
use std::sync::{Arc, Mutex, PoisonError};
use wgpu::{BufferUsages, CommandEncoder, Extent3d};

/// Rows that are copied to buffers begin at multiples of this \[byte\].
const ROW: usize = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize;

/// Memory that pictures are read back through.
#[derive(Clone, Debug)]
pub struct Return(Growing);

/// What was read back, and where in it what lies.
pub struct ReadBack<'a> {
    bytes: &'a [u8],
    grid: Grid,
    items_at: usize,
}

impl Return {
    /// No memory yet.
    pub fn new(gpu: &Gpu) -> Self {
        Return(Growing::new(&gpu.device, "read back", BufferUsages::MAP_READ | BufferUsages::COPY_DST))
    }

    /// Copies the first `cells` cells of an atlas to memory that can be read; colours and items as wanted.
    pub fn copy(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        atlas: &Atlas,
        cells: usize,
        [colours, items]: [bool; 2],
    ) {
        let grid = &atlas.grid;
        let rows = rows(grid, cells);
        let sizes = sizes(grid, rows);
        self.0.reserve(&gpu.device, (sizes[0] + sizes[1]) as u64);
        let colour = atlas.drawn().filter(|_| colours).map(|(texture, _)| texture);
        let item = atlas.listed().filter(|_| items);
        for (texture, offset, bytes) in [(colour, 0, 4), (item, sizes[0], 8)] {
            let Some(texture) = texture else { continue };
            let layout = wgpu::TexelCopyBufferLayout {
                offset: offset as u64,
                bytes_per_row: Some(pitch(grid, bytes) as u32),
                rows_per_image: None,
            };
            encoder.copy_texture_to_buffer(
                texture.as_image_copy(),
                wgpu::TexelCopyBufferInfo { buffer: self.0.buffer(), layout },
                Extent3d { height: rows as u32, ..grid.extent() },
            );
        }
    }

    /// Waits for the copy of the first `cells` cells, and has `read` take what it wants.
    pub fn read(
        &self,
        gpu: &Gpu,
        grid: Grid,
        cells: usize,
        read: impl FnOnce(&ReadBack<'_>),
    ) -> Result<(), GpuError> {
        let [colours, items] = sizes(&grid, rows(&grid, cells));
        let buffer = self.0.buffer();
        let slice = buffer.slice(..(colours + items) as u64);
        let outcome = Arc::new(Mutex::new(None));
        let mapped = outcome.clone();
        slice.map_async(wgpu::MapMode::Read, move |result| {
            *mapped.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
        });
        gpu.wait()?;
        let refused = |message: String| GpuError::Refused { message };
        match outcome.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(Ok(())) => {}
            Some(Err(error)) => return Err(refused(error.to_string())),
            None => return Err(GpuError::Lost { message: "it never finished its commands".into() }),
        }
        {
            let bytes = slice.get_mapped_range().map_err(|error| refused(error.to_string()))?;
            read(&ReadBack { bytes: &bytes, grid, items_at: colours });
        }
        buffer.unmap();
        Ok(())
    }
}

/// Rows of texels of the first `cells` cells.
fn rows(grid: &Grid, cells: usize) -> usize {
    cells.div_ceil(grid.columns) * grid.cell[1]
}

/// Bytes of `rows` rows of colours and of items.
fn sizes(grid: &Grid, rows: usize) -> [usize; 2] {
    [rows * pitch(grid, 4), rows * pitch(grid, 8)]
}

/// Bytes from one row of an atlas to the next.
fn pitch(grid: &Grid, pixel: usize) -> usize {
    (grid.columns * grid.cell[0] * pixel).next_multiple_of(ROW)
}

impl<'a> ReadBack<'a> {
    /// Rows of colours of a picture, four bytes a pixel, from the top.
    pub fn colours(&self, cell: usize, size: [usize; 2]) -> impl Iterator<Item = &'a [u8]> {
        self.rows(cell, size, 0, 4)
    }

    /// Rows of items of a picture, eight bytes a pixel, from the top.
    pub fn items(&self, cell: usize, size: [usize; 2]) -> impl Iterator<Item = &'a [u8]> {
        self.rows(cell, size, self.items_at, 8)
    }

    fn rows(
        &self,
        cell: usize,
        [width, height]: [usize; 2],
        at: usize,
        pixel: usize,
    ) -> impl Iterator<Item = &'a [u8]> {
        let (bytes, pitch, [x, y]) = (self.bytes, pitch(&self.grid, pixel), self.grid.origin(cell));
        (0..height).rev().map(move |row| {
            let first = at + (y + row) * pitch + x * pixel;
            &bytes[first..first + width * pixel]
        })
    }
}
