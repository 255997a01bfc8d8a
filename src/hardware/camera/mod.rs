//! Cameras: `camera` (any video device of Linux) and `realsense` (Intel RealSense of the series D400).
//!
//! A device of a config with one of these interfaces is a camera with the device's name, which visual keys name:
//! `rgb:right_cam:480x640:2d` is the image of the device `right_cam`. Its list `cam` has an entry whose
//! `hdr_id` is `rgb`, and one whose `hdr_id` is `d` if there is depth. Depths are in metres, times the entry's
//! `scale`, plus its `offset`, clipped to its `range`.
//!
//! | parameter of `camera` | meaning | default |
//! |---|---|---|
//! | `name` | device node, as `/dev/video0` or a link of `/dev/v4l/by-id` | required |
//! | `width`, `height`, `rate` | pixels, and frames a second; a camera that does not have them is refused | 640, 480, 30 |
//! | `format` | `auto`, `yuyv`, `uyvy` or `mjpg` | `auto`: the first of these that the camera has |
//! | `warm_up` | frames that are discarded while exposure settles | 5 |
//! | `stale` | age at which a frame is too old to be an observation \[s\] | three periods, no less than 0.1 |
//!
//! | parameter of `realsense`, besides these | meaning | default |
//! |---|---|---|
//! | `serial` | serial number on the USB bus | the digits in `rgb_topic`, as RoboHive's configs have them; else the only one there is |
//! | `name`, `depth_name` | device nodes of colour and depth, instead of a serial number | found |
//! | `depth_unit` | metres in one step of depth | 0.001 |
//! | `rgb_intrinsics`, `depth_intrinsics` | \[fx, fy, cx, cy\] in pixels of the frames asked for | depth stays in the frame of the depth imager |
//! | `depth_to_rgb` | rotation, row by row, then translation \[m\]: from the depth imager's frame to the colour imager's | identity |
//! | `warm_up` | as above | 30, as in RoboHive |
//!
//! With intrinsics, depth is aligned to the colour image, as in RoboHive: each point of the depth image is projected into the
//! colour image ([`Registration`]). `rs-enumerate-devices -c` prints the numbers; lens distortion is not corrected. They
//! cannot be read from the camera here, because no safe library offers the driver request for them.
//!
//! A thread takes every frame from the camera and keeps the newest; [`Cameras::take`] decodes it, so that unused
//! frames cost only a copy. Gaps in the camera's frame numbers are counted ([`Counts`]).

mod decode;
mod fit;
mod registration;
mod settings;
mod stream;

pub use crate::port::{Capture, Captures, Encoding, Format, Found, Frame, Request, Source, video_devices};
pub use decode::{depth_to_z16, rgb_to_yuyv};
pub use registration::{Intrinsics, Registration};
pub use stream::Counts;

use crate::setup::Setup;
use decode::Decoder;
use fit::{fit_depth, fit_rgb};
use robot::{Clock, Config, DeviceConfig, Fault};
use settings::{Depth, Settings};
use std::fmt;
use stream::Stream;

/// Types of interface that are cameras.
pub const KINDS: [&str; 2] = ["camera", "realsense"];

/// Whether a device is a camera.
pub fn is_camera(device: &DeviceConfig) -> bool {
    device.interface.kind.as_deref().is_some_and(|kind| KINDS.contains(&kind))
}

/// The cameras of a config, connected.
pub struct Cameras {
    cameras: Vec<Camera>,
    clock: Box<dyn Clock + Send>,
}

/// A fault of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraError {
    /// The camera.
    pub camera: String,
    /// What is wrong.
    pub fault: Fault,
}

impl fmt::Display for CameraError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "camera '{}': {}", self.camera, self.fault)
    }
}

impl std::error::Error for CameraError {}

/// One stream of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Streamed<'a> {
    /// The camera.
    pub camera: &'a str,
    /// `rgb` or `d`.
    pub which: &'static str,
    /// Format of its frames.
    pub format: Format,
    /// Counts of its frames.
    pub counts: Counts,
}

/// Buffers for the images of one time; `None` for images that are not wanted.
#[derive(Debug, Default)]
pub struct Wanted<'a> {
    /// Colours, `height * width * 3`, row 0 at the top.
    pub rgb: Option<&'a mut Vec<u8>>,
    /// Depths \[m\], `height * width`; 0 where the camera found none.
    pub depth: Option<&'a mut Vec<f32>>,
}

/// One camera.
struct Camera {
    name: String,
    rgb: Option<Stream>,
    depth: Option<(Stream, Depth)>,
    decoder: Decoder,
    /// Decoded frames, in the size of the camera.
    colours: Vec<u8>,
    depths: Vec<f32>,
    aligned: Vec<f32>,
}

impl Cameras {
    /// Opens the cameras of `config` and waits for their first frames; other devices are ignored.
    ///
    /// # Errors
    /// A camera is missing or does not support the format in the config; the error names the camera and the fix.
    pub fn connect(config: &Config, setup: &Setup) -> Result<Cameras, CameraError> {
        let mut clock = setup.clock();
        let chosen = config.devices.iter().filter(|device| is_camera(device));
        let mut cameras = Vec::new();
        for device in chosen {
            let error = |fault| CameraError { camera: device.name.clone(), fault };
            let settings = Settings::new(device).map_err(error)?;
            cameras.push(Camera::open(&device.name, settings, setup, &mut *clock).map_err(error)?);
        }
        Ok(Cameras { cameras, clock })
    }

    /// Their names.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.cameras.iter().map(|camera| camera.name.as_str())
    }

    /// Fills the buffers of `wanted` with the newest frames of a camera, scaled to `[height, width]`.
    ///
    /// # Errors
    /// No camera has this name, or it has no depth or no colours; it is unplugged, or its newest frame is too old or
    /// damaged.
    pub fn take(&mut self, name: &str, size: [usize; 2], wanted: Wanted) -> Result<(), CameraError> {
        let error = |fault| CameraError { camera: name.to_owned(), fault };
        let Some(place) = self.cameras.iter().position(|camera| camera.name == name) else {
            let known: Vec<_> = self.names().collect();
            let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            return Err(error(Fault::Refused(format!(
                "the robot's config has no device of this name with the interface 'camera' or 'realsense'; its cameras are: {known}"
            ))));
        };
        self.cameras[place].take(size, wanted, &mut *self.clock).map_err(error)
    }

    /// Their streams, with counts of the frames since the cameras were opened.
    pub fn streams(&self) -> impl Iterator<Item = Streamed<'_>> {
        self.cameras.iter().flat_map(|camera| {
            let rgb = camera.rgb.as_ref().map(|stream| ("rgb", stream));
            let depth = camera.depth.as_ref().map(|(stream, _)| ("d", stream));
            let streamed = |(which, stream): (&'static str, &Stream)| Streamed {
                camera: &camera.name,
                which,
                format: stream.format(),
                counts: stream.counts(),
            };
            rgb.into_iter().chain(depth).map(streamed)
        })
    }
}

impl Camera {
    fn open(name: &str, settings: Settings, setup: &Setup, clock: &mut dyn Clock) -> Result<Camera, Fault> {
        let Settings { rgb, depth, warm_up, stale } = settings;
        let open = |request: &Request| Stream::open(name, request, stale, setup);
        let mut rgb = rgb.as_ref().map(open).transpose()?;
        let mut depth = match depth {
            Some(depth) => Some((open(&depth.request)?, depth)),
            None => None,
        };
        for stream in rgb.iter_mut().chain(depth.as_mut().map(|(stream, _)| stream)) {
            stream.warm_up(warm_up, clock)?;
        }
        Ok(Camera {
            name: name.to_owned(),
            rgb,
            depth,
            decoder: Decoder::default(),
            colours: Vec::new(),
            depths: Vec::new(),
            aligned: Vec::new(),
        })
    }

    fn take(&mut self, size: [usize; 2], wanted: Wanted, clock: &mut dyn Clock) -> Result<(), Fault> {
        let Camera { rgb, depth, decoder, colours, depths, aligned, .. } = self;
        if let Some(out) = wanted.rgb {
            let stream = rgb.as_mut().ok_or_else(|| lacks("colours", "rgb"))?;
            let format = stream.format();
            stream.newest(clock, |bytes| decoder.rgb(format, bytes, colours))?;
            fit_rgb(colours, [format.height, format.width], size, out);
        }
        if let Some(out) = wanted.depth {
            let (stream, settings) = depth.as_mut().ok_or_else(|| lacks("depth", "d"))?;
            let format = stream.format();
            stream.newest(clock, |bytes| decode::depth(format, bytes, settings.unit, depths))?;
            let (seen, shape) = match &settings.registration {
                Some(registration) => {
                    registration.align(depths, [format.height, format.width], aligned);
                    (&*aligned, registration.size())
                }
                None => (&*depths, [format.height, format.width]),
            };
            fit_depth(seen, shape, size, out);
            settings.correct(out);
        }
        Ok(())
    }
}

/// The fault of a camera whose config has no entry for a stream.
fn lacks(what: &str, id: &str) -> Fault {
    Fault::Refused(format!(
        "its list 'cam' has no entry with hdr_id '{id}', so it has no {what}; add one to the config"
    ))
}
