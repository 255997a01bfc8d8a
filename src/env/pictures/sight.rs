//! What an environment draws with: triangles and textures of its model, and the memory of pictures.

use crate::error::EnvError;
use physics::{Data, Model};
use render::painter::{Painter, Painters};
use render::picture::Channels;
use render::scene::{Camera, SceneOptions};
use render::{Assets, Picture, Profile, RenderError, Scene, Settings, raster};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The pictures of one environment. Clones share what was prepared from the model, and the memory of pictures: there is as
/// much of that as there are threads that draw at the same time.
#[derive(Clone)]
pub(crate) struct Sight {
    profile: Profile,
    options: SceneOptions,
    painters: Arc<dyn Painters>,
    /// Prepared by the first that draws.
    prepared: Arc<Mutex<Option<Assets>>>,
    /// `prepared` with the edits of this environment's model.
    assets: Option<Assets>,
    studios: Arc<Mutex<Vec<Studio>>>,
}

/// The memory of pictures that are being drawn.
struct Studio {
    scenes: [Scene; TOGETHER],
    /// Stand where fewer pictures are drawn.
    spare: [Picture; TOGETHER],
    painter: Box<dyn Painter>,
}

/// Pictures that are drawn together.
const TOGETHER: usize = 8;

/// A camera and the picture that it fills.
pub(crate) struct Shot<'a> {
    pub camera: Camera,
    pub channels: Channels,
    pub picture: &'a mut Picture,
}

impl Sight {
    /// Nothing is prepared before the first picture.
    pub(crate) fn new(profile: Profile, options: SceneOptions, painters: Arc<dyn Painters>) -> Self {
        Sight { profile, options, painters, prepared: Arc::default(), assets: None, studios: Arc::default() }
    }

    /// Whose pictures are followed.
    pub(crate) fn profile(&self) -> Profile {
        self.profile
    }

    /// Draws pictures of one state, whose poses must have been computed.
    ///
    /// # Errors
    /// The model or a camera cannot be drawn.
    pub(crate) fn draw<'a>(
        &mut self,
        model: &Model,
        data: &Data,
        shots: impl IntoIterator<Item = Shot<'a>>,
    ) -> Result<(), EnvError> {
        let assets = current(&mut self.assets, &self.prepared, (model, data), (self.profile, &self.options))?;
        let settings = Settings::of(model);
        let mut studio = idle(&self.studios, &*self.painters, &settings);
        let outcome = studio.draw((model, data), (assets, &self.options), &settings, shots);
        keep(&self.studios, studio, &outcome);
        Ok(outcome?)
    }

    /// Whether pictures of many environments are drawn in less time together.
    pub(crate) fn draws_batches(&self, model: &Model) -> bool {
        let studio = idle(&self.studios, &*self.painters, &Settings::of(model));
        let draws_batches = studio.painter.draws_batches();
        keep(&self.studios, studio, &Ok(()));
        draws_batches
    }

    /// Lists what cameras see of a state, for pictures that are drawn together with pictures of other environments.
    ///
    /// # Errors
    /// As [`Sight::draw`].
    pub(crate) fn list(
        &mut self,
        model: &Model,
        data: &Data,
        cameras: impl ExactSizeIterator<Item = Camera>,
        scenes: &mut Vec<Scene>,
    ) -> Result<(), EnvError> {
        current(&mut self.assets, &self.prepared, (model, data), (self.profile, &self.options))?;
        scenes.resize_with(cameras.len(), Scene::new);
        for (scene, camera) in scenes.iter_mut().zip(cameras) {
            scene.update(model, data, camera.view(model, data)?, &self.options)?;
        }
        Ok(())
    }

    /// Triangles and textures of what was listed or drawn last.
    pub(crate) fn assets(&self) -> Option<&Assets> {
        self.assets.as_ref()
    }

    /// Draws pictures of several environments, as finely as the settings beside them say.
    ///
    /// # Errors
    /// As [`Sight::draw`].
    pub(crate) fn draw_listed(
        &self,
        model: &Model,
        batches: &mut [(Settings, Vec<raster::Shot<'_>>)],
    ) -> Result<(), EnvError> {
        let mut studio = idle(&self.studios, &*self.painters, &Settings::of(model));
        let outcome =
            batches.iter_mut().try_for_each(|(settings, shots)| studio.painter.paint(settings, shots));
        keep(&self.studios, studio, &outcome);
        Ok(outcome?)
    }
}

/// Memory for pictures that nobody uses.
fn idle(studios: &Mutex<Vec<Studio>>, painters: &dyn Painters, settings: &Settings) -> Studio {
    let idle = lock(studios).pop();
    idle.unwrap_or_else(|| Studio::new(painters.painter(settings)))
}

/// Keeps memory for the next pictures, unless what draws in it has failed.
fn keep(studios: &Mutex<Vec<Studio>>, studio: Studio, outcome: &Result<(), RenderError>) {
    if !matches!(outcome, Err(RenderError::Device { .. })) {
        lock(studios).push(studio);
    }
}

impl Studio {
    fn new(painter: Box<dyn Painter>) -> Self {
        Studio { scenes: std::array::from_fn(|_| Scene::new()), spare: Default::default(), painter }
    }

    /// Draws pictures of one state, as many together as there are scenes.
    fn draw<'a>(
        &mut self,
        (model, data): (&Model, &Data),
        (assets, options): (&Assets, &SceneOptions),
        settings: &Settings,
        shots: impl IntoIterator<Item = Shot<'a>>,
    ) -> Result<(), RenderError> {
        let mut shots = shots.into_iter();
        loop {
            let Studio { scenes, spare, painter } = self;
            let (mut count, mut outcome) = (0, Ok(()));
            let mut places = scenes.iter_mut().zip(spare);
            let mut group = [(); TOGETHER].map(|()| {
                let (scene, spare) = places.next().expect("there is a place for each");
                let Some(Shot { camera, channels, picture }) = shots.next() else {
                    return raster::Shot { assets, scene, channels: Channels::RGB, picture: spare };
                };
                count += 1;
                let view = camera.view(model, data);
                let updated = view.and_then(|view| scene.update(model, data, view, options));
                outcome = std::mem::replace(&mut outcome, Ok(())).and(updated);
                raster::Shot { assets, scene, channels, picture }
            });
            outcome?;
            painter.paint(settings, &mut group[..count])?;
            if count < TOGETHER {
                return Ok(());
            }
        }
    }
}

/// What was prepared, with the edits of `model`, its skins and flexes posed as in the state.
fn current<'a>(
    own: &'a mut Option<Assets>,
    prepared: &Mutex<Option<Assets>>,
    (model, data): (&Model, &Data),
    (profile, options): (Profile, &SceneOptions),
) -> Result<&'a Assets, RenderError> {
    let mut assets = match own.take() {
        Some(assets) => assets,
        None => {
            let mut shared = lock(prepared);
            match &*shared {
                Some(assets) => assets.clone(),
                None => shared.insert(Assets::new(model, profile)?).clone(),
            }
        }
    };
    assets.refresh(model)?;
    assets.pose(model, data, options)?;
    Ok(own.insert(assets))
}

/// What a mutex holds. A panic elsewhere leaves whole values, since these are put in place when they are complete.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
