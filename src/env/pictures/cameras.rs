//! Cameras of hardware, whose frames are the images of visual keys.

use crate::message::message;
use render::Picture;
use render::picture::Channels;

message! {
    /// A camera that is missing or has no new frame; the error names it and the cause.
    CameraError
}

/// Connected cameras, in place of rendered pictures.
pub trait Cameras: Send {
    /// Names of the cameras, as visual keys use them.
    fn names(&self) -> Vec<String>;

    /// Fills the channels of a picture with the newest frames of a camera, scaled to its size.
    ///
    /// # Errors
    /// The camera has no frame, no new frame, or not this channel.
    fn take(&mut self, camera: &str, channels: Channels, picture: &mut Picture) -> Result<(), CameraError>;
}
