//! One model in front of cameras, again and again: what the measurements of pictures draw.

use crate::failure::Failure;
use physics::{Data, Model};
use render::picture::Channels;
use render::raster::Shot;
use render::scene::{Camera, Effects, SceneOptions};
use render::{Assets, Painter, Painters, Picture, Scene, Settings};

/// What a picture is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Colours, four samples a pixel unless the model has fewer.
    Rgb,
    /// Colours without shadows.
    Plain,
    /// Distances.
    Depth,
    /// Segmentation.
    Ids,
}

impl Kind {
    /// All of them, by the names that they are asked for.
    pub const ALL: [(&'static str, Kind); 4] =
        [("rgb", Kind::Rgb), ("plain", Kind::Plain), ("depth", Kind::Depth), ("ids", Kind::Ids)];

    fn channels(self) -> Channels {
        match self {
            Kind::Rgb | Kind::Plain => Channels::RGB,
            Kind::Depth => Channels::DEPTH,
            Kind::Ids => Channels::SEGMENTATION,
        }
    }
}

/// What draws one model on one thread.
pub struct Studio<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its triangles and textures.
    pub assets: Assets,
    /// What draws.
    pub painter: Box<dyn Painter>,
    settings: Settings,
    scenes: Vec<Scene>,
    pictures: Vec<Picture>,
}

impl<'a> Studio<'a> {
    /// A studio with its own memory for pictures.
    pub fn new(model: &'a Model, assets: &'a Assets, painters: &dyn Painters) -> Self {
        let settings = Settings::of(model);
        let painter = painters.painter(&settings);
        Studio { model, assets: assets.clone(), painter, settings, scenes: Vec::new(), pictures: Vec::new() }
    }

    /// Lists what is to be drawn of a state and draws it, from all cameras together.
    pub fn take(
        &mut self,
        data: &Data,
        cameras: &[Camera],
        side: usize,
        kind: Kind,
    ) -> Result<&[Picture], Failure> {
        let effects = Effects::default().with_shadows(kind != Kind::Plain);
        let options = SceneOptions::default().with_effects(effects);
        self.scenes.resize_with(cameras.len(), Scene::new);
        self.pictures.resize_with(cameras.len(), Picture::default);
        for (scene, camera) in self.scenes.iter_mut().zip(cameras) {
            let view = camera.view(self.model, data).map_err(Failure::new)?;
            scene.update(self.model, data, view, &options).map_err(Failure::new)?;
        }
        self.assets.pose(self.model, data, &options).map_err(Failure::new)?;
        let (assets, channels) = (&self.assets, kind.channels());
        let shot = |(scene, picture)| {
            let picture: &mut Picture = picture;
            (picture.width, picture.height) = (side, side);
            Shot { assets, scene, channels, picture }
        };
        let mut shots: Vec<_> = self.scenes.iter().zip(&mut self.pictures).map(shot).collect();
        self.painter.paint(&self.settings, &mut shots).map_err(Failure::new)?;
        Ok(&self.pictures)
    }

    /// Draws all states in colours at once.
    pub fn take_batch(&mut self, states: &[Data], camera: &Camera, side: usize) -> Result<(), Failure> {
        let mut scenes = vec![Scene::new(); states.len()];
        let mut posed = vec![self.assets.clone(); states.len()];
        let options = SceneOptions::default();
        for ((scene, assets), data) in scenes.iter_mut().zip(&mut posed).zip(states) {
            let view = camera.view(self.model, data).map_err(Failure::new)?;
            scene.update(self.model, data, view, &options).map_err(Failure::new)?;
            assets.pose(self.model, data, &options).map_err(Failure::new)?;
        }
        let mut pictures = vec![Picture::new(side, side); states.len()];
        let Studio { painter, settings, .. } = self;
        let shots = scenes.iter().zip(&posed).zip(&mut pictures);
        let shots =
            shots.map(|((scene, assets), picture)| Shot { assets, scene, channels: Channels::RGB, picture });
        painter.paint(settings, &mut shots.collect::<Vec<_>>()).map_err(Failure::new)
    }

    /// Items of the last scene, and triangles of one pass over them.
    pub fn load(&self) -> [usize; 2] {
        let mut parts = Vec::new();
        let items = self.scenes.first().map_or(&[][..], |scene| &scene.items[..]);
        items.iter().for_each(|item| self.assets.parts(item, &mut parts));
        let triangles = parts.iter().map(|part| self.assets.surfaces[part.surface].faces.len()).sum();
        [items.len(), triangles]
    }
}

/// The camera of this name, or the free one.
pub fn camera(model: &Model, name: &str) -> Result<Camera, Failure> {
    Camera::named(model, name).map_err(Failure::usage)
}

/// Data at keyframe 0, or at `qpos0`.
pub fn start(model: &Model) -> Result<Data, Failure> {
    let mut data = Data::new(model);
    if model.nkey > 0 {
        data.reset_to_key(model, 0).map_err(Failure::new)?;
    }
    Ok(data)
}
