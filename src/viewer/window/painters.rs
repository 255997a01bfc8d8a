//! What draws the picture: the GPU that draws the window, or the CPU.

use super::channel::Channel;
use crate::drawing::Scenery;
use eframe::egui::{ColorImage, Context, Rect, TextureHandle, TextureId, TextureOptions, pos2};
use eframe::egui_wgpu::RenderState;
use render::{Picture, RenderError, Renderer};
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

    /// The texture of the last picture by the GPU, bytes R, G, B, A from the top: what tests look at.
    ///
    /// # Errors
    /// The GPU failed.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read_gpu(&mut self, size: [usize; 2]) -> Result<Option<Vec<u8>>, GpuError> {
        let renderer = self.gpu.as_mut().and_then(|gpu| gpu.renderer.as_mut());
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
        let renderer = self.renderer.get_or_insert_with(|| Renderer::new(scenery.settings));
        [self.picture.width, self.picture.height] = size;
        let scale = channel.draw(scenery, renderer, &mut self.picture)?;
        let image = ColorImage::from_rgb(size, &self.picture.rgb);
        // Between two objects there is no third.
        let options =
            if channel == Channel::Objects { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
        let texture = match &mut self.texture {
            Some(texture) => {
                texture.set(image, options);
                &*texture
            }
            None => self.texture.insert(context.load_texture("picture", image, options)),
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
    /// The texture as egui knows it.
    known: Option<(wgpu::TextureView, TextureId)>,
}

impl GpuPainter {
    fn new(state: &RenderState) -> Result<Self, GpuError> {
        let adapter = GpuRenderer::suits(&state.adapter)?;
        Ok(GpuPainter { state: state.clone(), adapter, renderer: None, known: None })
    }

    fn paint(&mut self, scenery: &Scenery, size: [usize; 2]) -> Result<Painted, GpuError> {
        let Scenery { assets, scene, settings, .. } = scenery;
        let RenderState { adapter, device, queue, .. } = &self.state;
        let renderer = match &mut self.renderer {
            Some(renderer) => {
                renderer.set(settings)?;
                renderer
            }
            None => self.renderer.insert(GpuRenderer::shared(*settings, adapter, device, queue)?),
        };
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
