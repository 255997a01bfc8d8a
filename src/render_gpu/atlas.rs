//! Targets that hold the pictures of a batch side by side, and the memory that they are read back through.

use crate::device::Gpu;
use crate::error::GpuError;
use crate::growing::Growing;
use crate::pipelines::{COLOUR, DEPTH, ITEM};
use std::sync::{Arc, Mutex, PoisonError};
use wgpu::{BufferUsages, CommandEncoder, Extent3d, Texture, TextureFormat, TextureUsages, TextureView};

/// Most pixels of an atlas: with four samples, colours and depths of one take 128 bytes at most.
const MAX_PIXELS: usize = 1 << 22;
/// Most columns or rows of an atlas: positions in it keep 1/256 pixel in single precision with bits to spare.
const MAX_SIDE: usize = 4096;
/// Rows that are copied to buffers begin at multiples of this \[byte\].
const ROW: usize = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize;

/// Cells of an atlas, one for each picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Grid {
    /// Columns and rows of a cell \[pixel\]; even, so that squares of four pixels stay in one cell.
    pub cell: [usize; 2],
    /// Cells in a row.
    pub columns: usize,
    /// Rows of cells.
    pub rows: usize,
}

impl Grid {
    /// Cells for at most `count` pictures of at most these sizes; fewer where an atlas cannot hold them all.
    pub fn fitting(count: usize, [width, height]: [usize; 2]) -> Self {
        let cell = [width.next_multiple_of(2), height.next_multiple_of(2)];
        let most = (MAX_PIXELS / (cell[0] * cell[1])).clamp(1, count.max(1));
        let square = (most * cell[1]).div_ceil(cell[0]).isqrt().max(1);
        let columns = square.min(MAX_SIDE / cell[0]).clamp(1, most);
        let rows = (MAX_SIDE / cell[1]).clamp(1, most.div_ceil(columns));
        Grid { cell, columns, rows }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// First pixel of a cell.
    pub fn origin(&self, cell: usize) -> [usize; 2] {
        [cell % self.columns * self.cell[0], cell / self.columns * self.cell[1]]
    }

    fn extent(&self) -> Extent3d {
        Extent3d {
            width: (self.columns * self.cell[0]) as u32,
            height: (self.rows * self.cell[1]) as u32,
            depth_or_array_layers: 1,
        }
    }
}

/// One target.
#[derive(Clone, Debug)]
pub struct Target {
    /// Its memory.
    texture: Texture,
    /// What passes draw to.
    pub view: TextureView,
}

impl Target {
    fn new(gpu: &Gpu, grid: &Grid, format: TextureFormat, samples: u32) -> Self {
        let copied =
            if samples == 1 && format != DEPTH { TextureUsages::COPY_SRC } else { TextureUsages::empty() };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("atlas"),
            size: grid.extent(),
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: TextureUsages::RENDER_ATTACHMENT | copied,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Target { texture, view }
    }
}

/// Targets for colours.
#[derive(Clone, Debug)]
pub struct Colours {
    /// All samples.
    pub samples: Target,
    /// Their depths.
    pub depth: Target,
    /// Means of the samples, where there are several.
    pub mean: Option<Target>,
}

/// Targets for numbers and depths of items.
#[derive(Clone, Debug)]
pub struct Items {
    /// Both numbers.
    pub numbers: Target,
    /// Depths for the test.
    pub depth: Target,
}

/// Targets of one grid, made when they are first needed.
#[derive(Clone, Debug)]
pub struct Atlas {
    /// Where the pictures lie.
    pub grid: Grid,
    samples: u32,
    colours: Option<Colours>,
    items: Option<Items>,
    read_back: Growing,
}

/// What was read back, and where in it what lies.
pub struct ReadBack<'a> {
    bytes: &'a [u8],
    grid: Grid,
    items_at: usize,
}

impl Atlas {
    /// An atlas without targets, for `samples` samples a pixel.
    pub fn new(gpu: &Gpu, samples: u32) -> Self {
        let usage = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let read_back = Growing::new(&gpu.device, "read back", usage);
        Atlas { grid: Grid::default(), samples, colours: None, items: None, read_back }
    }

    /// Makes room for a grid; a larger one with the same cells is kept.
    pub fn fit(&mut self, grid: Grid) {
        let suffices = self.grid.cell == grid.cell && self.grid.cells() >= grid.cells();
        if !suffices {
            self.grid = grid;
            (self.colours, self.items) = (None, None);
        }
    }

    /// The targets for colours.
    pub fn colours(&mut self, gpu: &Gpu) -> &Colours {
        let (grid, samples) = (self.grid, self.samples);
        self.colours.get_or_insert_with(|| Colours {
            samples: Target::new(gpu, &grid, COLOUR, samples),
            depth: Target::new(gpu, &grid, DEPTH, samples),
            mean: (samples > 1).then(|| Target::new(gpu, &grid, COLOUR, 1)),
        })
    }

    /// The targets for items.
    pub fn items(&mut self, gpu: &Gpu) -> &Items {
        let grid = self.grid;
        self.items.get_or_insert_with(|| Items {
            numbers: Target::new(gpu, &grid, ITEM, 1),
            depth: Target::new(gpu, &grid, DEPTH, 1),
        })
    }

    /// Copies the first `cells` cells to memory that can be read; colours and items as wanted.
    pub fn copy(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        cells: usize,
        [colours, items]: [bool; 2],
    ) {
        let rows = cells.div_ceil(self.grid.columns) * self.grid.cell[1];
        let sizes = self.sizes(rows);
        self.read_back.reserve(&gpu.device, (sizes[0] + sizes[1]) as u64);
        let colour = self.colours.as_ref().filter(|_| colours);
        let colour = colour.map(|colours| &colours.mean.as_ref().unwrap_or(&colours.samples).texture);
        let item = self.items.as_ref().filter(|_| items).map(|items| &items.numbers.texture);
        for (texture, offset, bytes) in [(colour, 0, 4), (item, sizes[0], 8)] {
            let Some(texture) = texture else { continue };
            let layout = wgpu::TexelCopyBufferLayout {
                offset: offset as u64,
                bytes_per_row: Some(self.pitch(bytes) as u32),
                rows_per_image: None,
            };
            encoder.copy_texture_to_buffer(
                texture.as_image_copy(),
                wgpu::TexelCopyBufferInfo { buffer: self.read_back.buffer(), layout },
                Extent3d { height: rows as u32, ..self.grid.extent() },
            );
        }
    }

    /// Waits for the copy of the first `cells` cells, and has `read` take what it wants.
    pub fn read(&self, gpu: &Gpu, cells: usize, read: impl FnOnce(&ReadBack<'_>)) -> Result<(), GpuError> {
        let rows = cells.div_ceil(self.grid.columns) * self.grid.cell[1];
        let [colours, items] = self.sizes(rows);
        let buffer = self.read_back.buffer();
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
            read(&ReadBack { bytes: &bytes, grid: self.grid, items_at: colours });
        }
        buffer.unmap();
        Ok(())
    }

    /// Bytes of `rows` rows of colours and of items.
    fn sizes(&self, rows: usize) -> [usize; 2] {
        [rows * self.pitch(4), rows * self.pitch(8)]
    }

    fn pitch(&self, pixel: usize) -> usize {
        pitch(&self.grid, pixel)
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_do_not_overlap_and_stay_within_the_atlas() {
        for (count, size) in
            [(1, [84, 84]), (64, [224, 224]), (7, [1, 3]), (5, [4096, 4096]), (1000, [33, 7])]
        {
            let grid = Grid::fitting(count, size);
            assert!(
                grid.cells() >= 1
                    && grid.columns * grid.cell[0] <= MAX_SIDE
                    && grid.rows * grid.cell[1] <= MAX_SIDE
            );
            assert!(grid.cell[0] >= size[0] && grid.cell[1] >= size[1]);
            let last = grid.origin(grid.cells() - 1);
            assert_eq!(last, [(grid.columns - 1) * grid.cell[0], (grid.rows - 1) * grid.cell[1]]);
        }
        assert!(Grid::fitting(64, [224, 224]).cells() >= 64);
        assert_eq!(Grid::fitting(5, [4096, 4096]).cells(), 1);
    }
}
