//! From scenes to pictures.

use crate::adapter::{Adapter, Choice, pick};
use crate::atlas::{Atlas, Grid, ReadBack};
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
use render::raster::{Samples, Settings, Shot, draw_labels};
use render::scene::Scene;
use render::{Assets, Picture, RenderError};
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
}

impl GpuRenderer {
    /// A renderer with the settings of a model, see [`Settings::of`], on the GPU that is chosen.
    ///
    /// # Errors
    /// There is no such GPU, or it cannot draw pictures with these settings.
    pub fn new(settings: Settings, choice: &Choice) -> Result<Self, GpuError> {
        let gpu = Gpu::open(&pick(choice)?)?;
        suits(&gpu, &settings)?;
        let samples = samples(&settings);
        let textures = Textures::new(&gpu);
        let lamps = Lamps::new(&gpu, settings.shadow.size);
        let stage = Stage::new(&gpu);
        let groups = [stage.layout(), textures.layout(), lamps.layout()];
        let pipelines = Pipelines::new(&gpu, samples, groups);
        let (meshes, atlas) = (Meshes::new(&gpu), Atlas::new(&gpu, samples));
        gpu.check()?;
        Ok(GpuRenderer { settings, gpu, meshes, textures, stage, lamps, pipelines, atlas })
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
            self.atlas = Atlas::new(&self.gpu, samples);
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

    /// Draws a scene of the model that `assets` were made of into the wanted channels of a picture, at its size.
    ///
    /// # Errors
    /// As [`GpuRenderer::draw_batch`].
    pub fn draw(
        &mut self,
        assets: &Assets,
        scene: &Scene,
        channels: Channels,
        picture: &mut Picture,
    ) -> Result<(), GpuError> {
        self.draw_batch(&mut [Shot { assets, scene, channels, picture }])
    }

    /// Draws all shots, of one model or several, each with the wanted channels of its picture: in one submission and with one
    /// read-back, unless they have more than four million pixels together.
    ///
    /// # Errors
    /// A picture has no pixels or too many, a view's frustum is empty or not finite, or the GPU failed.
    pub fn draw_batch(&mut self, shots: &mut [Shot<'_>]) -> Result<(), GpuError> {
        let mut largest = [0; 2];
        for shot in shots.iter_mut() {
            let Picture { width, height, rgb, depth, segmentation } = shot.picture;
            let (width, height) = (*width, *height);
            if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
                return Err(RenderError::Size { width, height }.into());
            }
            largest = [largest[0].max(width), largest[1].max(height)];
            rgb.clear();
            depth.clear();
            segmentation.clear();
        }
        let wanted = wanted(shots);
        if wanted == (Channels { rgb: false, depth: false, segmentation: false }) {
            return Ok(());
        }
        let mut assets: Vec<&Assets> = shots.iter().map(|shot| shot.assets).collect();
        assets.dedup_by(|a, b| std::ptr::eq(*a, *b));
        self.meshes.update(&self.gpu, &assets);
        self.textures.update(&self.gpu, &assets);
        self.atlas.fit(Grid::fitting(shots.len(), largest));
        let cells = self.atlas.grid.cells();
        shots.chunks_mut(cells).try_for_each(|shots| self.draw_atlas(shots, wanted))
    }

    /// Draws as many shots as the atlas holds, with these channels.
    fn draw_atlas(&mut self, shots: &mut [Shot<'_>], wanted: Channels) -> Result<(), GpuError> {
        let GpuRenderer { settings, gpu, meshes, textures, stage, lamps, pipelines, atlas } = self;
        stage.clear();
        let mut seen: Vec<Seen<'_>> = Vec::with_capacity(shots.len());
        for shot in shots.iter() {
            let Shot { assets, scene, picture, .. } = shot;
            let known = seen.last().filter(|last| std::ptr::eq(last.assets, *assets));
            let places = known.map(|last| last.places.clone());
            let places = places.unwrap_or_else(|| Arc::new(Places::of(assets, meshes, textures)));
            seen.push(Seen { assets, scene, places });
            stage.add(&seen, [picture.width, picture.height], settings, lamps)?;
        }
        let wants_items = wanted.depth || wanted.segmentation;
        let layers = lamps.layers(stage.shadows.len());
        let maps = (wanted.rgb && !stage.shadows.is_empty()).then(|| lamps.reserve(gpu, layers));
        stage.upload(gpu, maps.map_or(1, |maps| maps.layers.len()))?;
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("batch") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        let mut studio = Studio { gpu, stage, meshes, textures, pipelines };
        if wants_items {
            studio.items(&mut encoder, atlas);
        }
        if wanted.rgb {
            studio.colours(&mut encoder, atlas, maps);
        }
        atlas.copy(gpu, &mut encoder, shots.len(), [wanted.rgb, wants_items]);
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        atlas.read(gpu, shots.len(), |back| {
            shots.iter_mut().enumerate().for_each(|(cell, shot)| take(back, cell, shot));
        })
    }
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

/// The channels that any of these shots wants.
fn wanted(shots: &[Shot<'_>]) -> Channels {
    let any = |channel: fn(&Channels) -> bool| shots.iter().any(|shot| channel(&shot.channels));
    Channels { rgb: any(|c| c.rgb), depth: any(|c| c.depth), segmentation: any(|c| c.segmentation) }
}

/// Fills a picture with what was read back.
fn take(back: &ReadBack<'_>, cell: usize, shot: &mut Shot<'_>) {
    let Shot { scene, channels, picture, .. } = shot;
    let size = [picture.width, picture.height];
    if channels.rgb {
        for row in back.colours(cell, size) {
            picture.rgb.extend(row.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
        }
        draw_labels(scene, picture);
    }
    if !channels.depth && !channels.segmentation {
        return;
    }
    let frustum = &scene.view.frustum;
    let (near, far) = (frustum.near, frustum.far);
    let (top, reach) = ((near * far) as f32, (far - near) as f32);
    let metres = |z: f32| match frustum.orthographic {
        true => far as f32 - z * reach,
        false => top / (near as f32 + z * reach),
    };
    for row in back.items(cell, size) {
        for &[a, b, c, d, e, f, g, h] in row.as_chunks::<8>().0 {
            if channels.depth {
                picture.depth.push(metres(f32::from_ne_bytes([e, f, g, h])));
            }
            if channels.segmentation {
                let item = u32::from_ne_bytes([a, b, c, d]) as usize;
                let object =
                    item.checked_sub(1).and_then(|item| scene.items.get(item)).map(|item| item.object);
                picture.segmentation.push(object.map_or([-1; 2], |object| [object.id, object.kind]));
            }
        }
    }
}
