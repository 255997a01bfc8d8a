//! Pictures of a model's states, one after the other.

use crate::failure::Failure;
use crate::pictures::look::Size;
use physics::{Data, Model};
use render::picture::Channels;
use render::raster::Shot;
use render::scene::{Camera, SceneOptions};
use render::{Assets, Painter, Painters, Picture, Profile, Scene, Settings};
use video::Frame;

/// How a model is drawn.
pub struct Plan {
    /// From where.
    pub camera: Camera,
    /// At which size.
    pub size: Size,
    /// With what.
    pub options: SceneOptions,
    /// How finely.
    pub settings: Settings,
}

/// Draws states of a model, with the memory of its pictures.
pub struct Drawing {
    plan: Plan,
    assets: Assets,
    painter: Box<dyn Painter>,
    scene: Scene,
    picture: Picture,
}

impl Drawing {
    /// Prepares triangles and textures of a model.
    ///
    /// # Errors
    /// The model cannot be drawn.
    pub fn new(model: &Model, plan: Plan, painters: &dyn Painters) -> Result<Self, Failure> {
        let assets = Assets::new(model, Profile::default()).map_err(Failure::new)?;
        let painter = painters.painter(&plan.settings);
        let picture = Picture::new(plan.size.width, plan.size.height);
        Ok(Drawing { plan, assets, painter, scene: Scene::new(), picture })
    }

    /// Looks through another camera, at another size.
    pub fn aim(&mut self, camera: Camera, size: Size) {
        self.plan.camera = camera;
        self.plan.size = size;
        self.picture = Picture::new(size.width, size.height);
    }

    /// Draws a state that a forward pass has evaluated. The model is the one that the drawing was
    /// made for, but may have been edited.
    ///
    /// # Errors
    /// The camera sees nothing, or something in the scene is not finite.
    pub fn take(&mut self, model: &Model, data: &Data, channels: Channels) -> Result<&Picture, Failure> {
        self.assets.refresh(model).map_err(Failure::new)?;
        self.assets.pose(model, data, &self.plan.options).map_err(Failure::new)?;
        let view = self.plan.camera.view(model, data).map_err(Failure::new)?;
        self.scene.update(model, data, view, &self.plan.options).map_err(Failure::new)?;
        let Drawing { plan, assets, painter, scene, picture } = self;
        let drawn = painter.paint(&plan.settings, &mut [Shot { assets, scene, channels, picture }]);
        drawn.map_err(Failure::new)?;
        Ok(&self.picture)
    }
}

/// The colours of a picture.
pub fn frame(picture: &Picture) -> Result<Frame<'_>, Failure> {
    Frame::new(picture.width as u32, picture.height as u32, &picture.rgb).map_err(Failure::new)
}
