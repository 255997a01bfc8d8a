//! The picture of a session.

use crate::ghost::Ghost;
use crate::session::Session;
use physics::Model;
use render::picture::Channels;
use render::raster::Shot;
use render::scene::SceneOptions;
use render::{Assets, Painter, Picture, Profile, RenderError, Renderer, Scene, Settings, View};

/// What a session's model is drawn of, and how its present state looks.
pub struct Scenery {
    /// Triangles and textures.
    pub assets: Assets,
    /// What is drawn.
    pub scene: Scene,
    ghost: Ghost,
    /// How finely.
    pub settings: Settings,
}

impl Scenery {
    /// Prepares triangles and textures for a session's model.
    ///
    /// # Errors
    /// A texture or mesh cannot be drawn.
    pub fn new(model: &Model) -> Result<Self, RenderError> {
        let assets = Assets::new(model, Profile::Mujoco312)?;
        Ok(Scenery { assets, scene: Scene::new(), ghost: Ghost::default(), settings: Settings::of(model) })
    }

    /// Takes the present state of a session with this model.
    ///
    /// # Errors
    /// The camera or an item has no place.
    pub fn update(&mut self, session: &Session) -> Result<(), RenderError> {
        let (model, data, options) = (session.model(), session.data(), session.shown());
        self.assets.refresh(model)?;
        self.assets.pose(model, data, &options)?;
        self.look(session, session.view()?, &options)
    }

    /// Sees the state that was taken last from `view`, with these options, which show the same surfaces.
    ///
    /// # Errors
    /// An item has no place.
    pub fn look(&mut self, session: &Session, view: View, options: &SceneOptions) -> Result<(), RenderError> {
        let (model, data) = (session.model(), session.data());
        self.scene.update(model, data, view, options)?;
        if let Some(reference) = session.reference() {
            self.ghost.haunt(&mut self.scene, model, reference.data(), view, options)?;
        }
        self.scene.items.extend_from_slice(session.guests());
        Ok(())
    }

    /// Draws what was updated into these channels of a picture, at its size.
    ///
    /// # Errors
    /// The size is zero or too large; what draws fails.
    pub fn paint(
        &self,
        painter: &mut dyn Painter,
        channels: Channels,
        picture: &mut Picture,
    ) -> Result<(), RenderError> {
        let Scenery { assets, scene, settings, .. } = self;
        painter.paint(settings, &mut [Shot { assets, scene, channels, picture }])
    }
}

/// What draws a session, and the last picture of it.
pub struct Drawing {
    scenery: Scenery,
    painter: Renderer,
    picture: Picture,
}

impl Drawing {
    /// Prepares triangles and textures for a session's model, drawn by the CPU.
    ///
    /// # Errors
    /// A texture or mesh cannot be drawn.
    pub fn new(model: &Model) -> Result<Self, RenderError> {
        let scenery = Scenery::new(model)?;
        Ok(Drawing { painter: Renderer::new(scenery.settings), scenery, picture: Picture::default() })
    }

    /// Draws the present state of a session with this model, `size` pixels wide and high.
    ///
    /// # Errors
    /// The camera or an item has no place.
    pub fn draw(&mut self, session: &Session, size: [usize; 2]) -> Result<&Picture, RenderError> {
        self.draw_channels(session, size, Channels::RGB)
    }

    /// Draws colours, depth or segmentation of the present state.
    ///
    /// # Errors
    /// The camera or an item has no place.
    pub fn draw_channels(
        &mut self,
        session: &Session,
        size: [usize; 2],
        channels: Channels,
    ) -> Result<&Picture, RenderError> {
        self.scenery.update(session)?;
        [self.picture.width, self.picture.height] = size;
        self.scenery.paint(&mut self.painter, channels, &mut self.picture)?;
        Ok(&self.picture)
    }

    /// The last picture.
    pub fn picture(&self) -> &Picture {
        &self.picture
    }
}
