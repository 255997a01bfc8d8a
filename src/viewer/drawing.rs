//! The picture of a session.

use crate::ghost::Ghost;
use crate::session::Session;
use physics::Model;
use render::picture::Channels;
use render::raster::Shot;
use render::{Assets, Painter, Picture, Profile, RenderError, Renderer, Scene, Settings};

/// What draws a session, and the last picture of it.
pub struct Drawing {
    assets: Assets,
    scene: Scene,
    ghost: Ghost,
    settings: Settings,
    painter: Box<dyn Painter>,
    picture: Picture,
}

impl Drawing {
    /// Prepares triangles and textures for a session's model, drawn by the CPU.
    ///
    /// # Errors
    /// A texture or mesh cannot be drawn.
    pub fn new(model: &Model) -> Result<Self, RenderError> {
        let settings = Settings::of(model);
        Ok(Drawing {
            assets: Assets::new(model, Profile::Mujoco312)?,
            scene: Scene::new(),
            ghost: Ghost::default(),
            settings,
            painter: Box::new(Renderer::new(settings)),
            picture: Picture::default(),
        })
    }

    /// Draws the present state of a session with this model, `size` pixels wide and high.
    ///
    /// # Errors
    /// The camera or an item has no place.
    pub fn draw(&mut self, session: &Session, size: [usize; 2]) -> Result<&Picture, RenderError> {
        let (model, data, options) = (session.model(), session.data(), session.shown());
        self.assets.refresh(model)?;
        self.assets.pose(model, data, &options)?;
        let view = session.view()?;
        self.scene.update(model, data, view, &options)?;
        if let Some(reference) = session.reference() {
            self.ghost.haunt(&mut self.scene, model, reference.data(), view, &options)?;
        }
        self.scene.items.extend_from_slice(session.guests());
        [self.picture.width, self.picture.height] = size;
        let shot = Shot {
            assets: &self.assets,
            scene: &self.scene,
            channels: Channels::RGB,
            picture: &mut self.picture,
        };
        self.painter.paint(&self.settings, &mut [shot])?;
        Ok(&self.picture)
    }

    /// The last picture.
    pub fn picture(&self) -> &Picture {
        &self.picture
    }
}
