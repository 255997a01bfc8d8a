//! Networks that turn pictures into features, for visual keys such as `rgb:CAMERA:224x224:r3m18`.

use crate::message::message;
use crate::pictures::visual::Encoder;
use robot::Compat;
use std::sync::Arc;

message! {
    /// A network that is not there, with the file to bring and where to put it, or one that cannot take a picture.
    NetworkError
}

/// A network with its weights.
pub trait Network: Send + Sync {
    /// Appends the features of a picture of `[height, width]` pixels, whose colours are given row by row from the top left.
    ///
    /// # Errors
    /// The network cannot take such a picture.
    fn encode(&self, size: [usize; 2], rgb: &[u8], features: &mut Vec<f32>) -> Result<(), NetworkError>;
}

/// Where networks come from.
pub trait Networks: Send + Sync {
    /// The network of an encoder, which sees pictures prepared as `compat` says.
    ///
    /// # Errors
    /// There is none: which file to bring, and where to put it.
    fn load(&self, encoder: Encoder, compat: Compat) -> Result<Arc<dyn Network>, NetworkError>;
}

/// No networks at all: enough for the encoders `1d` and `2d`.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoNetworks;

impl Networks for NoNetworks {
    fn load(&self, encoder: Encoder, _: Compat) -> Result<Arc<dyn Network>, NetworkError> {
        Err(format!("this program has no network {encoder}; 1d and 2d pass the pictures on as they are")
            .into())
    }
}
