//! What draws the picture: the GPU that draws the window, or the CPU.

use super::channel::Channel;
use crate::drawing::Scenery;
use eframe::egui::{ColorImage, Context, Rect, TextureHandle, TextureId, TextureOptions, pos2};
use eframe::egui_wgpu::RenderState;
use render::{Picture, RenderError, Renderer, Settings};
use render_gpu::{Adapter, GpuError, GpuRenderer, Shown, wgpu};

/// A picture that egui can show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Painted {
    /// Its texture.
    pub texture: TextureId,
    /// Where it lies in the texture; upside down where its rows are.
    pub place: Rect,
    /// Labels are in it already.
    pub labelled: bool,
    /// Of depth, the distances \[m\] that have the first and the last colour.
    pub scale: Option<[f32; 2]>,
}

/// Textures for a small picture beside the picture.
#[derive(Default)]
pub(super) struct Sheet {
    by_cpu: Option<TextureHandle>,
    by_gpu: Option<Copied>,
}

/// The painters of a window. Pictures of all its models go to the same textures, one after the other.
#[derive(Default)]
pub struct Painters {
    cpu: CpuPainter,
    gpu: Option<GpuPainter>,
    prefers_gpu: bool,
    /// Why the GPU does not draw.
    reason: String,
}

impl Painters {
    /// The GPU that draws a window, where it can also draw pictures faster than the CPU; else the CPU.
    pub fn of(state: Option<&RenderState>) -> Self {
        let Some(state) = state else {
            return Painters { reason: "no GPU draws this window".into(), ..Painters::default() };
        };
        match GpuPainter::new(state) {
            Ok(gpu) => {
                let software = gpu.adapter.is_software();
                let reason =
                    if software { format!("{} computes on the CPU", gpu.adapter) } else { String::new() };
                Painters { cpu: CpuPainter::default(), gpu: Some(gpu), prefers_gpu: !software, reason }
            }
            Err(error) => Painters { reason: error.to_string(), ..Painters::default() },
        }
    }

    /// Whether there is a choice between GPU and CPU.
    pub fn has_gpu(&self) -> bool {
        self.gpu.is_some()
    }

    /// Whether the GPU draws.
    pub fn uses_gpu(&self) -> bool {
        self.has_gpu() && self.prefers_gpu
    }

    /// Lets the GPU draw, or the CPU. Without a GPU it stays the CPU.
    pub fn use_gpu(&mut self, wanted: bool) {
        self.prefers_gpu = wanted;
    }

    /// What draws, for people.
    pub fn name(&self) -> String {
        match self.gpu.as_ref().filter(|_| self.prefers_gpu) {
            Some(gpu) => gpu.adapter.to_string(),
            None => "CPU".into(),
        }
    }

    /// What draws colours, or something else, for people.
    pub fn drawer_of(&self, channel: Channel) -> String {
        if channel == Channel::Colours { self.name() } else { "CPU".into() }
    }

    /// Why the GPU does not draw; empty where it does.
    pub fn reason(&self) -> &str {
        if self.uses_gpu() { "" } else { &self.reason }
    }

    /// Draws what stands in `scenery`, `size` pixels wide and high; depth and objects by the CPU. A GPU that fails is not asked
    /// again.
    ///
    /// # Errors
    /// The size is zero or too large, or the view's frustum is empty.
    pub fn paint(
        &mut self,
        context: &Context,
        scenery: &Scenery,
        channel: Channel,
        size: [usize; 2],
    ) -> Result<Painted, RenderError> {
        if self.prefers_gpu
            && channel == Channel::Colours
            && let Some(gpu) = &mut self.gpu
        {
            match gpu.paint(scenery, size) {
                Ok(painted) => return Ok(painted),
                Err(GpuError::Render(error)) => return Err(error),
                // This picture is left to the CPU.
                Err(GpuError::Effect { .. }) => {}
                Err(error) => (self.gpu, self.reason) = (None, error.to_string()),
            }
        }
        self.cpu.paint(context, scenery, channel, size)
    }

    /// Draws what stands in `scenery` on a sheet, by what [`Painters::paint`] draws with.
    ///
    /// # Errors
    /// As [`Painters::paint`].
    pub(super) fn paint_sheet(
        &mut self,
        context: &Context,
        scenery: &Scenery,
        channel: Channel,
        size: [usize; 2],
        sheet: &mut Sheet,
    ) -> Result<Painted, RenderError> {
        if self.prefers_gpu
            && channel == Channel::Colours
            && let Some(gpu) = &mut self.gpu
        {
            match gpu.paint_sheet(scenery, size, &mut sheet.by_gpu) {
                Ok(painted) => return Ok(painted),
                Err(GpuError::Render(error)) => return Err(error),
                Err(GpuError::Effect { .. }) => {}
                Err(error) => (self.gpu, self.reason) = (None, error.to_string()),
            }
        }
        self.cpu.paint_to(&mut sheet.by_cpu, context, scenery, channel, size)
    }

    /// The texture of the last picture by the GPU, bytes R, G, B, A from the top: what tests look at.
    ///
    /// # Errors
    /// The GPU failed.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read_gpu(&mut self, size: [usize; 2]) -> Result<Option<Vec<u8>>, GpuError> {
        let renderer = self.gpu.as_mut().and_then(|gpu| gpu.renderer.as_mut());
        renderer.map(|renderer| renderer.read_shown(size)).transpose()
    }

    /// The same of the last sheet.
    ///
    /// # Errors
    /// The GPU failed.
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn read_gpu_sheet(&mut self, size: [usize; 2]) -> Result<Option<Vec<u8>>, GpuError> {
        let renderer = self.gpu.as_mut().and_then(|gpu| gpu.aside.as_mut());
        renderer.map(|renderer| renderer.read_shown(size)).transpose()
    }
}

/// The CPU, and the texture that its pictures are uploaded to.
#[derive(Default)]
struct CpuPainter {
    renderer: Option<Renderer>,
    picture: Picture,
    texture: Option<TextureHandle>,
}

impl CpuPainter {
    fn paint(
        &mut self,
        context: &Context,
        scenery: &Scenery,
        channel: Channel,
        size: [usize; 2],
    ) -> Result<Painted, RenderError> {
        let mut texture = self.texture.take();
        let painted = self.paint_to(&mut texture, context, scenery, channel, size);
        self.texture = texture;
        painted
    }

    fn paint_to(
        &mut self,
        texture: &mut Option<TextureHandle>,
        context: &Context,
        scenery: &Scenery,
        channel: Channel,
        size: [usize; 2],
    ) -> Result<Painted, RenderError> {
        let renderer = self.renderer.get_or_insert_with(|| Renderer::new(scenery.settings));
        [self.picture.width, self.picture.height] = size;
        let scale = channel.draw(scenery, renderer, &mut self.picture)?;
        let image = ColorImage::from_rgb(size, &self.picture.rgb);
        // Between two objects there is no third.
        let options =
            if channel == Channel::Objects { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
        let texture = match texture {
            Some(texture) => {
                texture.set(image, options);
                &*texture
            }
            None => texture.insert(context.load_texture("picture", image, options)),
        };
        let place = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        Ok(Painted { texture: texture.id(), place, labelled: channel == Channel::Colours, scale })
    }
}

/// The GPU of the window, and the texture that it draws to.
struct GpuPainter {
    state: RenderState,
    adapter: Adapter,
    renderer: Option<GpuRenderer>,
    /// What draws sheets: the texture of the first renderer is on the screen.
    aside: Option<GpuRenderer>,
    /// The texture as egui knows it.
    known: Option<(wgpu::TextureView, TextureId)>,
}

impl GpuPainter {
    fn new(state: &RenderState) -> Result<Self, GpuError> {
        let adapter = GpuRenderer::suits(&state.adapter)?;
        Ok(GpuPainter { state: state.clone(), adapter, renderer: None, aside: None, known: None })
    }

    fn paint(&mut self, scenery: &Scenery, size: [usize; 2]) -> Result<Painted, GpuError> {
        let Scenery { assets, scene, settings, .. } = scenery;
        let device = &self.state.device;
        let renderer = ready(&mut self.renderer, &self.state, settings)?;
        let Shown { view, taken: [right, top] } = renderer.show(assets, scene, size)?;
        let texture = match &self.known {
            Some((known, texture)) if known == view => *texture,
            Some((_, texture)) => {
                let mut egui = self.state.renderer.write();
                egui.update_egui_texture_from_wgpu_texture(device, view, FILTER, *texture);
                *texture
            }
            None => self.state.renderer.write().register_native_texture(device, view, FILTER),
        };
        self.known = Some((view.clone(), texture));
        let place = Rect::from_min_max(pos2(0.0, top), pos2(right, 0.0));
        Ok(Painted { texture, place, labelled: false, scale: None })
    }

    /// Draws a picture and copies it: the next one on another sheet takes its place.
    fn paint_sheet(
        &mut self,
        scenery: &Scenery,
        size: [usize; 2],
        sheet: &mut Option<Copied>,
    ) -> Result<Painted, GpuError> {
        let Scenery { assets, scene, settings, .. } = scenery;
        let RenderState { device, queue, .. } = &self.state;
        let renderer = ready(&mut self.aside, &self.state, settings)?;
        let Shown { view, .. } = renderer.show(assets, scene, size)?;
        let copied = match sheet {
            Some(copied) if copied.size == size => copied,
            _ => sheet.insert(Copied::new(&self.state, size)),
        };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let (from, to) = (view.texture().as_image_copy(), copied.texture.as_image_copy());
        encoder.copy_texture_to_texture(from, to, copied.texture.size());
        queue.submit([encoder.finish()]);
        let place = Rect::from_min_max(pos2(0.0, 1.0), pos2(1.0, 0.0));
        Ok(Painted { texture: copied.known, place, labelled: false, scale: None })
    }
}

/// A texture that a picture by the GPU was copied to.
struct Copied {
    size: [usize; 2],
    texture: wgpu::Texture,
    known: TextureId,
    state: RenderState,
}

impl Copied {
    fn new(state: &RenderState, size: [usize; 2]) -> Self {
        let [width, height] = size.map(|side| side as u32);
        let texture = state.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("sheet"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let known = state.renderer.write().register_native_texture(&state.device, &view, FILTER);
        Copied { size, texture, known, state: state.clone() }
    }
}

impl Drop for Copied {
    fn drop(&mut self) {
        self.state.renderer.write().free_texture(&self.known);
    }
}

/// The renderer of a place, with these settings.
fn ready<'a>(
    place: &'a mut Option<GpuRenderer>,
    state: &RenderState,
    settings: &Settings,
) -> Result<&'a mut GpuRenderer, GpuError> {
    let RenderState { adapter, device, queue, .. } = state;
    match place {
        Some(renderer) => {
            renderer.set(settings)?;
            Ok(renderer)
        }
        None => Ok(place.insert(GpuRenderer::shared(*settings, adapter, device, queue)?)),
    }
}

/// How the picture is scaled while it is coarse.
const FILTER: wgpu::FilterMode = wgpu::FilterMode::Linear;

impl Drop for GpuPainter {
    fn drop(&mut self) {
        if let Some((_, texture)) = &self.known {
            self.state.renderer.write().free_texture(texture);
        }
    }
}
