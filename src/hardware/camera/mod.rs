//! Cameras: `camera` (any that Linux knows as a video device) and `realsense` (Intel RealSense of the series D400).
//!
//! A device of a config with one of these interfaces is a camera with the device's name, which visual keys name:
//! `rgb:right_cam:480x640:2d` shows what the device `right_cam` sees. Its list `cam` says what it has: an entry whose
//! `hdr_id` is `rgb`, and one whose `hdr_id` is `d` where there is depth. Depths come out in metres, times the entry's
//! `scale`, plus its `offset`, clipped to its `range`.
//!
//! | parameter of `camera` | meaning | default |
//! |---|---|---|
//! | `name` | device node, as `/dev/video0` or a link of `/dev/v4l/by-id` | required |
//! | `width`, `height`, `rate` | pixels and frames a second that are asked for; the camera gives these or is refused | 640, 480, 30 |
//! | `format` | `auto`, `yuyv`, `uyvy` or `mjpg` | `auto`: the first of these that the camera has |
//! | `warm_up` | frames that are thrown away while exposure settles | 5 |
//! | `stale` | age at which a frame is too old to be an observation \[s\] | three periods, no less than 0.1 |
//!
//! | parameter of `realsense`, besides these | meaning | default |
//! |---|---|---|
//! | `serial` | serial number on the USB bus | the digits in `rgb_topic`, as RoboHive's configs have them; else the only one there is |
//! | `name`, `depth_name` | device nodes of colour and depth, instead of a serial number | found |
//! | `depth_unit` | metres in one step of depth | 0.001 |
//! | `rgb_intrinsics`, `depth_intrinsics` | \[fx, fy, cx, cy\] in pixels of the frames asked for | depth stays as its own imager sees it |
//! | `depth_to_rgb` | rotation, row by row, then translation \[m\]: from the depth imager's frame to that of colours | none |
//! | `warm_up` | as above | 30, as in RoboHive |
//!
//! With intrinsics depth is aligned to colours, as in the original: each point that the depth imager sees is seen by the
//! colour imager ([`Registration`]). `rs-enumerate-devices -c` prints the numbers; lens distortion is not corrected. They
//! cannot be read from the camera here, because that takes a request of its driver that no safe library offers.
//!
//! A thread takes every frame from the camera and keeps the newest; [`Cameras::take`] decodes it, so that pictures that
//! nobody asks for cost a copy. Frames that the camera numbers and nobody gets are counted ([`Counts`]).

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
use robot::{Clock, Config, Fault};
use settings::{Depth, Settings};
use std::fmt;
use stream::Stream;

/// Whether an interface of this type is a camera.
pub fn is_camera(kind: &str) -> bool {
    matches!(kind, "camera" | "realsense")
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
    /// What its frames are.
    pub format: Format,
    /// What became of them.
    pub counts: Counts,
}

/// Where the pictures go that are taken at one time: those that are wanted.
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
    /// Frames before they have the size that is wanted.
    colours: Vec<u8>,
    depths: Vec<f32>,
    aligned: Vec<f32>,
}

impl Cameras {
    /// Opens the cameras of `config` and waits for their first frames; those of other interfaces are left alone.
    ///
    /// # Errors
    /// A camera that is not there or cannot do what the config says: which, and what to do about it.
    pub fn connect(config: &Config, setup: &Setup) -> Result<Cameras, CameraError> {
        let mut clock = setup.clock();
        let chosen =
            config.devices.iter().filter(|device| device.interface.kind.as_deref().is_some_and(is_camera));
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

    /// Fills what is wanted with the newest frames of a camera, scaled to `[height, width]`.
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
                "the robot's config has no device of this name with the interface 'camera' or 'realsense'; cameras of it: {known}"
            ))));
        };
        self.cameras[place].take(size, wanted, &mut *self.clock).map_err(error)
    }

    /// Their streams, and what became of the frames so far.
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

/// The config says of a camera that it has less than is asked of it.
fn lacks(what: &str, id: &str) -> Fault {
    Fault::Refused(format!("its list 'cam' has no entry with hdr_id '{id}', so that it shows no {what}"))
}
