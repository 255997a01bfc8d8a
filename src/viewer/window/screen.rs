//! The picture of a session, drawn as finely as time allows.

use crate::drawing::Drawing;
use crate::session::Session;
use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use physics::Model;
use render::scene::{Camera, SceneOptions};
use render::{Picture, RenderError};
use std::time::Instant;

/// What a picture may take while things move \[s\].
const BUDGET: f64 = 0.05;
/// Coarsest picture, in parts of the window's width.
const COARSEST: usize = 4;

/// What draws a session, and the texture of the last picture.
pub struct Screen {
    drawing: Drawing,
    texture: Option<TextureHandle>,
    shown: Option<Shown>,
    /// What a pixel takes \[s\].
    cost: f64,
}

/// What a picture depends on.
#[derive(Clone, PartialEq)]
struct Shown {
    revision: u64,
    camera: Camera,
    options: SceneOptions,
    size: [usize; 2],
}

impl Screen {
    /// Prepares triangles and textures.
    ///
    /// # Errors
    /// A texture or mesh cannot be drawn.
    pub fn new(model: &Model) -> Result<Self, RenderError> {
        Ok(Screen { drawing: Drawing::new(model)?, texture: None, shown: None, cost: 0.0 })
    }

    /// The picture of the present state for a window of `size` pixels: coarse while things move and drawing is slow, fine
    /// when they stand still. The flag says whether a finer one is still to come.
    ///
    /// # Errors
    /// The camera or an item has no place.
    pub fn draw(
        &mut self,
        context: &Context,
        session: &Session,
        size: [usize; 2],
    ) -> Result<(TextureHandle, bool), RenderError> {
        let wanted = |size| Shown {
            revision: session.revision(),
            camera: session.camera,
            options: session.shown(),
            size,
        };
        if let (Some(texture), true) = (&self.texture, self.shown.as_ref() == Some(&wanted(size))) {
            return Ok((texture.clone(), false));
        }
        let parts = self.parts(size);
        let coarse = size.map(|side| side.div_ceil(parts));
        let stands_still = self.shown.as_ref() == Some(&wanted(coarse));
        let chosen = if stands_still { size } else { coarse };
        let texture = self.paint(context, session, chosen)?;
        self.shown = Some(wanted(chosen));
        Ok((texture, chosen != size))
    }

    /// By how many pixels of the window a pixel of the picture is wide.
    fn parts(&self, size: [usize; 2]) -> usize {
        let whole = self.cost * (size[0] * size[1]) as f64;
        ((whole / BUDGET).sqrt().ceil() as usize).clamp(1, COARSEST)
    }

    fn paint(
        &mut self,
        context: &Context,
        session: &Session,
        size: [usize; 2],
    ) -> Result<TextureHandle, RenderError> {
        let began = Instant::now();
        let picture = self.drawing.draw(session, size)?;
        let image = ColorImage::from_rgb(size, &picture.rgb);
        let texture = match &mut self.texture {
            Some(texture) => {
                texture.set(image, TextureOptions::LINEAR);
                texture.clone()
            }
            None => {
                self.texture.insert(context.load_texture("picture", image, TextureOptions::LINEAR)).clone()
            }
        };
        self.cost = began.elapsed().as_secs_f64() / (size[0] * size[1]).max(1) as f64;
        Ok(texture)
    }

    /// The picture that is shown.
    pub fn picture(&self) -> &Picture {
        self.drawing.picture()
    }
}
