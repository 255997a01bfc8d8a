//! From scenes to pictures.

use crate::adapter::{Adapter, Choice, pick};
use crate::atlas::{Atlas, Grid, ReadBack};
use crate::device::Gpu;
use crate::encode::Studio;
use crate::error::GpuError;
use crate::lamps::Lamps;
use crate::meshes::Meshes;
use crate::pipelines::Pipelines;
use crate::stage::Stage;
use crate::textures::Textures;
use render::error::MAX_SIDE;
use render::picture::Channels;
use render::raster::{Samples, Settings};
use render::scene::Scene;
use render::{Assets, Picture, RenderError};

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
        let most = gpu.device.limits().max_texture_dimension_2d as usize;
        if settings.shadow.size > most {
            let size = settings.shadow.size;
            return Err(GpuError::Unsuitable {
                adapter: gpu.adapter.to_string(),
                message: format!("a shadow map of {size} texels a side is larger than its textures, {most}"),
            });
        }
        let samples = match settings.samples {
            Samples::One => 1,
            Samples::Four => 4,
        };
        let textures = Textures::new(&gpu);
        let lamps = Lamps::new(&gpu, settings.shadow.size);
        let stage = Stage::new(&gpu);
        let groups = [stage.layout(), textures.layout(), lamps.layout()];
        let pipelines = Pipelines::new(&gpu, samples, groups);
        let (meshes, atlas) = (Meshes::new(&gpu), Atlas::new(&gpu, samples));
        gpu.check()?;
        Ok(GpuRenderer { settings, gpu, meshes, textures, stage, lamps, pipelines, atlas })
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
        self.draw_batch(assets, &[scene], channels, std::slice::from_mut(picture))
    }

    /// Draws scenes of one model into as many pictures, each at its size: in one submission and with one read-back, unless
    /// they have more than four million pixels together.
    ///
    /// # Errors
    /// A picture has no pixels or too many, a view's frustum is empty or not finite, the scenes are not as many as the pictures,
    /// or the GPU failed.
    pub fn draw_batch(
        &mut self,
        assets: &Assets,
        scenes: &[&Scene],
        channels: Channels,
        pictures: &mut [Picture],
    ) -> Result<(), GpuError> {
        if scenes.len() != pictures.len() {
            return Err(GpuError::Batch { scenes: scenes.len(), pictures: pictures.len() });
        }
        let mut largest = [0; 2];
        for picture in pictures.iter_mut() {
            let (width, height) = (picture.width, picture.height);
            if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
                return Err(RenderError::Size { width, height }.into());
            }
            largest = [largest[0].max(width), largest[1].max(height)];
            picture.rgb.clear();
            picture.depth.clear();
            picture.segmentation.clear();
        }
        if pictures.is_empty() || channels == (Channels { rgb: false, depth: false, segmentation: false }) {
            return Ok(());
        }
        self.meshes.update(&self.gpu, assets);
        self.textures.update(&self.gpu, assets);
        self.atlas.fit(Grid::fitting(scenes.len(), largest));
        let cells = self.atlas.grid.cells();
        for (scenes, pictures) in scenes.chunks(cells).zip(pictures.chunks_mut(cells)) {
            self.draw_atlas(assets, scenes, channels, pictures)?;
        }
        Ok(())
    }

    /// Draws as many scenes as the atlas holds.
    fn draw_atlas(
        &mut self,
        assets: &Assets,
        scenes: &[&Scene],
        channels: Channels,
        pictures: &mut [Picture],
    ) -> Result<(), GpuError> {
        let GpuRenderer { settings, gpu, meshes, textures, stage, lamps, pipelines, atlas } = self;
        stage.clear();
        for (index, picture) in pictures.iter().enumerate() {
            stage.add(assets, &scenes[..=index], [picture.width, picture.height], settings, lamps)?;
        }
        let wants_items = channels.depth || channels.segmentation;
        let layers = lamps.layers(stage.shadows.len());
        let maps = (channels.rgb && !stage.shadows.is_empty()).then(|| lamps.reserve(gpu, layers));
        stage.upload(gpu, maps.map_or(1, |maps| maps.layers.len()))?;
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("batch") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        let mut studio = Studio { gpu, stage, meshes, textures, pipelines };
        if wants_items {
            studio.items(&mut encoder, atlas);
        }
        if channels.rgb {
            studio.colours(&mut encoder, atlas, maps);
        }
        atlas.copy(gpu, &mut encoder, scenes.len(), [channels.rgb, wants_items]);
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        atlas.read(gpu, scenes.len(), |back| {
            for (cell, (scene, picture)) in scenes.iter().zip(pictures).enumerate() {
                take(back, cell, scene, channels, picture);
            }
        })
    }
}

/// Fills a picture with what was read back.
fn take(back: &ReadBack<'_>, cell: usize, scene: &Scene, channels: Channels, picture: &mut Picture) {
    let size = [picture.width, picture.height];
    if channels.rgb {
        for row in back.colours(cell, size) {
            picture.rgb.extend(row.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
        }
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
