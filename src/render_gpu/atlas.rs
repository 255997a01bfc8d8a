//! Targets that hold the pictures of a batch side by side.

use crate::device::Gpu;
use crate::pipelines::{COLOUR, DEPTH, ITEM};
use wgpu::{Extent3d, Texture, TextureFormat, TextureUsages, TextureView};

/// Most pixels of an atlas: with four samples, colours and depths of one take 128 bytes at most.
const MAX_PIXELS: usize = 1 << 22;
/// Most columns or rows of an atlas: positions in it keep 1/256 pixel in single precision with bits to spare.
const MAX_SIDE: usize = 4096;

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

    /// Its texels.
    pub fn extent(&self) -> Extent3d {
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
        let copied = match (samples, format) {
            (1, COLOUR) => TextureUsages::COPY_SRC | TextureUsages::TEXTURE_BINDING,
            (1, ITEM) => TextureUsages::COPY_SRC,
            _ => TextureUsages::empty(),
        };
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
}

impl Atlas {
    /// An atlas without targets, for `samples` samples a pixel.
    pub fn new(samples: u32) -> Self {
        Atlas { grid: Grid::default(), samples, colours: None, items: None }
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

    /// The texture and the view of the colours that were drawn last, all samples of a pixel in one.
    pub fn drawn(&self) -> Option<(&Texture, &TextureView)> {
        let colours = self.colours.as_ref()?;
        let Target { texture, view } = colours.mean.as_ref().unwrap_or(&colours.samples);
        Some((texture, view))
    }

    /// The numbers and depths of items that were drawn last.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn listed(&self) -> Option<&Texture> {
        self.items.as_ref().map(|items| &items.numbers.texture)
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
