//! Cameras of hardware, whose frames visual keys show.

use crate::message::message;
use render::Picture;
use render::picture::Channels;

message! {
    /// A camera that is not there or shows nothing: which, and why.
    CameraError
}

/// Cameras that are there, where a simulation draws pictures.
pub trait Cameras: Send {
    /// Names that visual keys may have.
    fn names(&self) -> Vec<String>;

    /// Fills the channels of a picture, which has the size that is wanted, with the newest frames of a camera.
    ///
    /// # Errors
    /// The camera shows nothing, nothing new, or not that: why.
    fn take(&mut self, camera: &str, channels: Channels, picture: &mut Picture) -> Result<(), CameraError>;
}
