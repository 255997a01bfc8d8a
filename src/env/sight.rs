//! What an environment draws with: triangles and textures of its model, and the memory of a picture.

use crate::error::EnvError;
use physics::{Data, Model};
use render::picture::Channels;
use render::scene::{Camera, SceneOptions};
use render::{Assets, Picture, Profile, RenderError, Renderer, Scene, Settings};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The pictures of one environment. Clones share what was prepared from the model, and the memory of pictures: there is as
/// much of that as there are threads that draw at the same time.
#[derive(Clone)]
pub(crate) struct Sight {
    profile: Profile,
    options: SceneOptions,
    /// Prepared by the first that draws.
    prepared: Arc<Mutex<Option<Assets>>>,
    /// `prepared` with the edits of this environment's model.
    assets: Option<Assets>,
    studios: Arc<Mutex<Vec<Studio>>>,
}

/// The memory of a picture that is being drawn.
struct Studio {
    scene: Scene,
    renderer: Renderer,
}

/// A camera and the picture that it fills.
pub(crate) struct Shot<'a> {
    pub camera: Camera,
    pub channels: Channels,
    pub picture: &'a mut Picture,
}

impl Sight {
    /// Nothing is prepared before the first picture.
    pub(crate) fn new(profile: Profile, options: SceneOptions) -> Self {
        Sight { profile, options, prepared: Arc::default(), assets: None, studios: Arc::default() }
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
        let assets = current(&mut self.assets, &self.prepared, model, self.profile)?;
        let idle = lock(&self.studios).pop();
        let mut studio = idle
            .unwrap_or_else(|| Studio { scene: Scene::new(), renderer: Renderer::new(Settings::of(model)) });
        *studio.renderer.settings_mut() = Settings::of(model);
        let outcome = shots.into_iter().try_for_each(|shot| {
            studio.scene.update(model, data, shot.camera.view(model, data)?, &self.options)?;
            studio.renderer.draw(assets, &studio.scene, shot.channels, shot.picture)
        });
        lock(&self.studios).push(studio);
        Ok(outcome?)
    }
}

/// What was prepared, with the edits of `model`.
fn current<'a>(
    own: &'a mut Option<Assets>,
    prepared: &Mutex<Option<Assets>>,
    model: &Model,
    profile: Profile,
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
    Ok(own.insert(assets))
}

/// What a mutex holds. A panic elsewhere leaves whole values, since these are put in place when they are complete.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
