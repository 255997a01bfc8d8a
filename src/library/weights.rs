//! Networks of visual keys, from the weights on this machine.

use encoders::locate::Search;
use encoders::{Encoding, Picture, Profile};
use env::visual::Encoder;
use env::{Compat, Network, NetworkError, Networks};
use std::sync::Arc;

/// The folders in which weights are searched for.
pub struct Weights(Search);

impl Weights {
    /// The folders that environment variables name, then this project's data folder, then the folders in which the networks'
    /// own programs keep their weights.
    pub fn from_environment() -> Self {
        // A machine without a data folder has the other places; what is not found is an error that lists them.
        let data = store::default_folder().ok();
        Weights(Search::from_environment(data.as_deref()))
    }
}

impl Networks for Weights {
    fn load(&self, encoder: Encoder, compat: Compat) -> Result<Arc<dyn Network>, NetworkError> {
        let profile = match compat {
            Compat::RoboHive07 => Profile::RoboHive07,
            Compat::Fixed => Profile::Fixed,
        };
        let loaded = Encoding::parse(&encoder.to_string()).and_then(|encoding| {
            let path = self.0.find(encoding)?;
            encoders::Encoder::load(encoding, &path, profile)
        });
        loaded
            .map(|loaded| Arc::new(Loaded(loaded)) as Arc<dyn Network>)
            .map_err(|error| error.to_string().into())
    }
}

/// A network with its weights.
struct Loaded(encoders::Encoder);

impl Network for Loaded {
    fn encode(
        &self,
        [height, width]: [usize; 2],
        rgb: &[u8],
        features: &mut Vec<f32>,
    ) -> Result<(), NetworkError> {
        let picture = Picture::new(height, width, rgb).map_err(|error| error.to_string())?;
        features.extend(self.0.encode(&[picture]));
        Ok(())
    }
}
