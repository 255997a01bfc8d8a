//! Images of an environment's visual keys.

use super::env::Env;
use crate::error::EnvError;
use crate::pictures::eyes::Exteroception;
use crate::pictures::network::Network;
use render::raster;
use std::sync::Arc;

impl Env {
    /// The images of the visual keys, drawn of the state that the last observation shows, as the robot's sensors see it. No
    /// other method draws them, so that an environment with visual keys costs nothing more until they are asked for. Asked
    /// again in the same state they are not drawn again.
    ///
    /// An environment without visual keys has no images. Depth is in metres, of shape 1 x H x W as in the original. A `d:`
    /// key is drawn whether or not its colours are asked for too; the original leaves it out without them. Where the robot is
    /// hardware the images are the newest frames of its cameras.
    ///
    /// # Errors
    /// The model or a camera cannot be drawn; a camera of the hardware has no frame; a network is missing, with the file that has its weights.
    pub fn exteroception(&mut self) -> Result<&Exteroception, EnvError> {
        if self.eyes.open() {
            return Ok(self.eyes.seen());
        }
        let network = self.network()?;
        let data = if self.differs { &self.observed } else { &self.scene.data };
        if let Some(cameras) = self.live.as_mut().and_then(|live| live.cameras.as_mut()) {
            self.eyes.look_through(&mut **cameras)?;
        } else {
            self.sight.draw(&self.scene.model, data, self.eyes.shots())?;
        }
        self.eyes.finish(self.scene.data.time(), network.as_deref())
    }

    /// The network of the visual keys, where one of them needs it.
    fn network(&self) -> Result<Option<Arc<dyn Network>>, EnvError> {
        let encoded = self.visual_keys.iter().find(|key| key.is_encoded());
        encoded.map(|key| self.eyes.network(key, self.compat)).transpose()
    }

    /// Lists what the images show, if they are out of date: [`Env::shots`] draw them.
    pub(crate) fn list_images(&mut self) -> Result<(), EnvError> {
        if self.eyes.open() {
            return Ok(());
        }
        self.network()?;
        let data = if self.differs { &self.observed } else { &self.scene.data };
        let (cameras, scenes) = self.eyes.scenes();
        self.sight.list(&self.scene.model, data, cameras, scenes)
    }

    /// What was listed, to be drawn; [`Env::finish_images`] follows.
    pub(crate) fn shots(&mut self) -> impl Iterator<Item = raster::Shot<'_>> {
        let assets = self.sight.assets().filter(|_| !self.eyes.open());
        assets.into_iter().zip(std::iter::once(&mut self.eyes)).flat_map(|(assets, eyes)| eyes.listed(assets))
    }

    /// Makes images of the drawings, if they are out of date.
    pub(crate) fn finish_images(&mut self) -> Result<(), EnvError> {
        if !self.eyes.open() {
            let network = self.network()?;
            self.eyes.finish(self.scene.data.time(), network.as_deref())?;
        }
        Ok(())
    }

    /// The images, where they were drawn of the present state; RoboHive's `visual_dict`, which is empty otherwise.
    pub fn visuals(&self) -> Option<&Exteroception> {
        self.eyes.open().then(|| self.eyes.seen())
    }
}
