//! Pictures of many scenes, read back from the GPU. A page cannot wait for them.

use super::read_back::{ReadBack, Return};
use super::{GpuRenderer, View};
use crate::adapter::{Choice, pick};
use crate::device::Gpu;
use crate::error::GpuError;
use render::picture::Channels;
use render::raster::{Settings, Shot, draw_labels};
use render::scene::Scene;
use render::{Assets, Picture};

impl GpuRenderer {
    /// A renderer with the settings of a model, see [`Settings::of`], on the GPU that is chosen.
    ///
    /// # Errors
    /// There is no such GPU, or it cannot draw pictures with these settings.
    pub fn new(settings: Settings, choice: &Choice) -> Result<Self, GpuError> {
        Self::on(settings, Gpu::open(&pick(choice)?)?)
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
        for shot in shots.iter_mut() {
            let Picture { rgb, depth, segmentation, .. } = shot.picture;
            rgb.clear();
            depth.clear();
            segmentation.clear();
        }
        let wanted = wanted(shots);
        let cells = self.prepare(&views(shots))?;
        if wanted == (Channels { rgb: false, depth: false, segmentation: false }) {
            return Ok(());
        }
        shots.chunks_mut(cells.max(1)).try_for_each(|shots| self.draw_atlas(shots, wanted))
    }

    /// Draws as many shots as the atlas holds, with these channels.
    fn draw_atlas(&mut self, shots: &mut [Shot<'_>], wanted: Channels) -> Result<(), GpuError> {
        let mut encoder = self.commands(&views(shots), wanted)?;
        let GpuRenderer { gpu, atlas, back, .. } = self;
        let back = back.get_or_insert_with(|| Return::new(gpu));
        let wants_items = wanted.depth || wanted.segmentation;
        back.copy(gpu, &mut encoder, atlas, shots.len(), [wanted.rgb, wants_items]);
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        back.read(gpu, atlas.grid, shots.len(), |back| {
            shots.iter_mut().enumerate().for_each(|(cell, shot)| take(back, cell, shot));
        })
    }

    /// Reads back a picture that was shown: bytes R, G, B, A of each pixel from the top.
    ///
    /// # Errors
    /// The GPU failed, or nothing was shown yet.
    pub fn read_shown(&mut self, size: [usize; 2]) -> Result<Vec<u8>, GpuError> {
        let GpuRenderer { gpu, atlas, back, .. } = self;
        let back = back.get_or_insert_with(|| Return::new(gpu));
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        back.copy(gpu, &mut encoder, atlas, 1, [true, false]);
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        let mut pixels = Vec::with_capacity(4 * size[0] * size[1]);
        back.read(gpu, atlas.grid, 1, |back| back.colours(0, size).for_each(|row| pixels.extend(row)))?;
        Ok(pixels)
    }
}

fn views<'a>(shots: &'a [Shot<'_>]) -> Vec<View<'a>> {
    let view = |shot: &'a Shot<'_>| View {
        assets: shot.assets,
        scene: shot.scene,
        size: [shot.picture.width, shot.picture.height],
    };
    shots.iter().map(view).collect()
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
