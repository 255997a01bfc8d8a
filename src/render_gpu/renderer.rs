//! From scenes to pictures.

#[cfg(not(target_arch = "wasm32"))]
mod batch;
#[cfg(not(target_arch = "wasm32"))]
mod read_back;

use crate::adapter::{Adapter, check};
use crate::atlas::{Atlas, Grid};
use crate::device::Gpu;
use crate::encode::Studio;
use crate::error::GpuError;
use crate::lamps::Lamps;
use crate::meshes::Meshes;
use crate::pipelines::Pipelines;
use crate::places::{Places, Seen};
use crate::stage::Stage;
use crate::textures::Textures;
use render::error::MAX_SIDE;
use render::picture::Channels;
use render::raster::{Samples, Settings};
use render::scene::Scene;
use render::{Assets, RenderError};
use std::sync::Arc;

/// Draws scenes on a GPU. It keeps the memory of a batch, so that the next one of the same sizes and scenes makes nothing
/// new.
#[derive(Debug)]
pub struct GpuRenderer {
    settings: Settings,
    gpu: Gpu,
    meshes: Meshes,
    textures: Textures,
    stage: Stage,
    lamps: Lamps,
    pipelines: Pipelines,
    atlas: Atlas,
    #[cfg(not(target_arch = "wasm32"))]
    back: Option<read_back::Return>,
}

/// A picture that stays in the memory of the GPU, until the next one is drawn.
#[derive(Clone, Debug)]
pub struct Shown<'a> {
    /// The texture, `Rgba8Unorm` with values as screens take them, opaque. Row 0 is the lowest of the picture.
    pub view: &'a wgpu::TextureView,
    /// Shares of its columns and rows that the picture takes.
    pub taken: [f32; 2],
}

/// What a picture of some size shows.
#[derive(Clone, Copy, Debug)]
struct View<'a> {
    assets: &'a Assets,
    scene: &'a Scene,
    size: [usize; 2],
}

impl GpuRenderer {
    /// A renderer on a GPU that somebody else has opened, with the settings of a model. It hears of every error of `device`
    /// and of its loss from now on. Nothing waits, so that it is also there for a page.
    ///
    /// # Errors
    /// The GPU cannot draw pictures, or not with these settings.
    pub fn shared(
        settings: Settings,
        adapter: &wgpu::Adapter,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<Self, GpuError> {
        Self::on(settings, Gpu::shared(adapter, device, queue)?)
    }

    /// What is known of a GPU with which [`GpuRenderer::shared`] can draw.
    ///
    /// # Errors
    /// It cannot draw pictures.
    pub fn suits(adapter: &wgpu::Adapter) -> Result<Adapter, GpuError> {
        check(adapter)?;
        Ok(Adapter::from(&adapter.get_info()))
    }

    fn on(settings: Settings, gpu: Gpu) -> Result<Self, GpuError> {
        suits(&gpu, &settings)?;
        let samples = samples(&settings);
        let textures = Textures::new(&gpu);
        let lamps = Lamps::new(&gpu, settings.shadow.size);
        let stage = Stage::new(&gpu);
        let groups = [stage.layout(), textures.layout(), lamps.layout()];
        let pipelines = Pipelines::new(&gpu, samples, groups);
        let (meshes, atlas) = (Meshes::new(&gpu), Atlas::new(samples));
        gpu.check()?;
        Ok(GpuRenderer {
            settings,
            gpu,
            meshes,
            textures,
            stage,
            lamps,
            pipelines,
            atlas,
            #[cfg(not(target_arch = "wasm32"))]
            back: None,
        })
    }

    /// Draws as finely as these settings say from now on. Other samples and sizes of shadow maps take new memory.
    ///
    /// # Errors
    /// The GPU cannot draw pictures with these settings.
    pub fn set(&mut self, settings: &Settings) -> Result<(), GpuError> {
        let samples = samples(settings);
        let resized = settings.shadow.size != self.settings.shadow.size;
        if resized {
            suits(&self.gpu, settings)?;
            self.lamps = Lamps::new(&self.gpu, settings.shadow.size);
        }
        if resized || settings.samples != self.settings.samples {
            let groups = [self.stage.layout(), self.textures.layout(), self.lamps.layout()];
            self.pipelines = Pipelines::new(&self.gpu, samples, groups);
            self.atlas = Atlas::new(samples);
        }
        self.settings = *settings;
        self.gpu.check()
    }

    /// How finely it draws.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The GPU that draws.
    pub fn adapter(&self) -> &Adapter {
        &self.gpu.adapter
    }

    /// Draws a scene of the model that `assets` were made of, `size` pixels wide and high, into a texture that stays in the
    /// memory of the GPU. It has no labels.
    ///
    /// # Errors
    /// The picture has no pixels or too many, the view's frustum is empty or not finite, the scene has an effect that a GPU does not
    /// draw, or the GPU failed. In a page its
    /// refusals are told when the next picture is drawn.
    pub fn show(&mut self, assets: &Assets, scene: &Scene, size: [usize; 2]) -> Result<Shown<'_>, GpuError> {
        let view = [View { assets, scene, size }];
        self.prepare(&view)?;
        let encoder = self.commands(&view, Channels::RGB)?;
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.check()?;
        let Grid { cell, columns, rows } = self.atlas.grid;
        let share = |pixels: usize, cells: usize, cell: usize| pixels as f32 / (cells * cell) as f32;
        let taken = [share(size[0], columns, cell[0]), share(size[1], rows, cell[1])];
        match self.atlas.drawn() {
            Some((_, view)) => Ok(Shown { view, taken }),
            None => Err(GpuError::Refused { message: "it has no colours".into() }),
        }
    }

    /// Uploads what these views show, and makes room for them. Returns how many are drawn at once.
    fn prepare(&mut self, views: &[View<'_>]) -> Result<usize, GpuError> {
        let mut largest = [0; 2];
        for &View { scene, size: [width, height], .. } in views {
            if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
                return Err(RenderError::Size { width, height }.into());
            }
            if let Some(name) = missing(scene) {
                return Err(GpuError::Effect { name });
            }
            largest = [largest[0].max(width), largest[1].max(height)];
        }
        if views.is_empty() {
            return Ok(0);
        }
        let mut assets: Vec<&Assets> = views.iter().map(|view| view.assets).collect();
        assets.dedup_by(|a, b| std::ptr::eq(*a, *b));
        self.meshes.update(&self.gpu, &assets);
        self.textures.update(&self.gpu, &assets);
        self.atlas.fit(Grid::fitting(views.len(), largest));
        Ok(self.atlas.grid.cells())
    }

    /// The commands that draw these views, as many as the atlas holds, with these channels.
    fn commands(&mut self, views: &[View<'_>], wanted: Channels) -> Result<wgpu::CommandEncoder, GpuError> {
        let GpuRenderer { settings, gpu, meshes, textures, stage, lamps, pipelines, atlas, .. } = self;
        stage.clear();
        let mut seen: Vec<Seen<'_>> = Vec::with_capacity(views.len());
        for View { assets, scene, size } in views {
            let known = seen.last().filter(|last| std::ptr::eq(last.assets, *assets));
            let places = known.map(|last| last.places.clone());
            let places = places.unwrap_or_else(|| Arc::new(Places::of(assets, meshes, textures)));
            seen.push(Seen { assets, scene, places });
            stage.add(&seen, *size, settings, lamps)?;
        }
        let layers = lamps.layers(stage.shadows.len());
        let maps = (wanted.rgb && !stage.shadows.is_empty()).then(|| lamps.reserve(gpu, layers));
        stage.upload(gpu, maps.map_or(1, |maps| maps.layers.len()))?;
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("batch") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        let mut studio = Studio { gpu, stage, meshes, textures, pipelines };
        if wanted.depth || wanted.segmentation {
            studio.items(&mut encoder, atlas);
        }
        if wanted.rgb {
            studio.colours(&mut encoder, atlas, maps);
        }
        Ok(encoder)
    }
}

/// The effect of a scene that a GPU does not draw.
pub fn missing(scene: &Scene) -> Option<&'static str> {
    let effects = [
        (scene.wireframe, "wireframe"),
        (scene.additive, "additive transparency"),
        (!scene.culling, "backs of surfaces"),
    ];
    effects.into_iter().find(|&(on, _)| on).map(|(_, name)| name)
}

/// Refuses settings with which a GPU cannot draw.
fn suits(gpu: &Gpu, settings: &Settings) -> Result<(), GpuError> {
    let most = gpu.device.limits().max_texture_dimension_2d as usize;
    let size = settings.shadow.size;
    if size <= most {
        return Ok(());
    }
    Err(GpuError::Unsuitable {
        adapter: gpu.adapter.to_string(),
        message: format!("a shadow map of {size} texels a side is larger than its textures, {most}"),
    })
}

fn samples(settings: &Settings) -> u32 {
    match settings.samples {
        Samples::One => 1,
        Samples::Four => 4,
    }
}
