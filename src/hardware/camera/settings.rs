//! Settings of a camera, from a config.

use super::registration::{Intrinsics, Registration};
use crate::parameters::Parameters;
use crate::port::{Encoding, Request, Source};
use robot::{CameraConfig, DeviceConfig, Fault, HardwareId};

/// Range of the pixels along a side, and of the frames a second.
const SIDES: [f64; 2] = [16.0, 8192.0];
const RATES: [f64; 2] = [1.0, 300.0];

/// Settings of a camera.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    /// The stream of colours.
    pub(super) rgb: Option<Request>,
    /// The stream of depth.
    pub(super) depth: Option<Depth>,
    /// Number of first frames that are discarded.
    pub(super) warm_up: u32,
    /// Age at which a frame is too old \[s\].
    pub(super) stale: f64,
}

/// A stream of depth, and how its values are converted.
#[derive(Clone, Debug)]
pub(super) struct Depth {
    pub(super) request: Request,
    /// One unit of depth \[m\].
    pub(super) unit: f64,
    pub(super) registration: Option<Registration>,
    scale: f64,
    offset: f64,
    range: [f64; 2],
}

impl Depth {
    /// Applies scale, offset and range of the config; a depth of 0, none, stays 0.
    pub(super) fn correct(&self, depths: &mut [f32]) {
        let [low, high] = self.range;
        for depth in depths.iter_mut().filter(|depth| **depth > 0.0) {
            *depth = (f64::from(*depth) * self.scale + self.offset).clamp(low, high) as f32;
        }
    }
}

fn refused<T>(why: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::Refused(why.into()))
}

impl Settings {
    /// The settings of a device.
    ///
    /// # Errors
    /// A parameter that is missing or wrong.
    pub(super) fn new(config: &DeviceConfig) -> Result<Settings, Fault> {
        let mut parameters = Parameters::new(config);
        let [rgb, depth] = streams(config)?;
        let settings = match config.interface.kind.as_deref() {
            Some("realsense") => realsense(&mut parameters, rgb, depth)?,
            _ => camera(&mut parameters, rgb, depth)?,
        };
        parameters.finish()?;
        Ok(settings)
    }
}

/// The entries for colours and for depth in the list `cam`.
fn streams(config: &DeviceConfig) -> Result<[Option<&CameraConfig>; 2], Fault> {
    if !config.sensors.is_empty() || !config.actuators.is_empty() {
        return refused("a camera must have a list 'cam' and no sensors or actuators");
    }
    let mut found = [None; 2];
    for entry in &config.cameras {
        let place = match &entry.hardware {
            HardwareId::Name(name) if name == "rgb" => 0,
            HardwareId::Name(name) if name == "d" => 1,
            _ => {
                return refused(format!("the hdr_id of its entry '{}' must be 'rgb' or 'd'", entry.name));
            }
        };
        if found[place].replace(entry).is_some() {
            return refused(format!(
                "two entries of its list 'cam' have the hdr_id '{}'",
                ["rgb", "d"][place]
            ));
        }
    }
    match found {
        [None, None] => refused("its list 'cam' has no entry; add one with hdr_id 'rgb', or 'd' for depth"),
        [Some(rgb), _] if (rgb.scale, rgb.offset) != (1.0, 0.0) => refused(format!(
            "the scale of '{}' must be 1 and its offset 0: colours are not converted",
            rgb.name
        )),
        found => Ok(found),
    }
}

/// Settings of both kinds of camera.
struct Common {
    width: usize,
    height: usize,
    rate: f64,
    encodings: Vec<Encoding>,
    warm_up: u32,
    stale: f64,
}

impl Common {
    fn new(parameters: &mut Parameters, warm_up: f64) -> Result<Common, Fault> {
        let side = |parameters: &mut Parameters, key, usual| {
            parameters.number(key, usual, SIDES).map(|side| side as usize)
        };
        let (width, height) = (side(parameters, "width", 640.0)?, side(parameters, "height", 480.0)?);
        if width % 2 != 0 {
            return refused("its width must be even: cameras send pixels in pairs");
        }
        let rate = parameters.number("rate", 30.0, RATES)?;
        let encodings = match parameters.choice("format", &["auto", "yuyv", "uyvy", "mjpg"])? {
            0 => Encoding::COLOURS.to_vec(),
            chosen => vec![Encoding::COLOURS[chosen - 1]],
        };
        let warm_up = parameters.number("warm_up", warm_up, [0.0, 1000.0])? as u32;
        let stale = parameters.number("stale", (3.0 / rate).max(0.1), [0.01, 60.0])?;
        Ok(Common { width, height, rate, encodings, warm_up, stale })
    }

    fn request(&self, source: Source, encodings: Vec<Encoding>) -> Request {
        Request { source, encodings, width: self.width, height: self.height, rate: self.rate }
    }

    fn settings(&self, rgb: Option<Source>, depth: Option<Depth>) -> Settings {
        let rgb = rgb.map(|source| self.request(source, self.encodings.clone()));
        Settings { rgb, depth, warm_up: self.warm_up, stale: self.stale }
    }
}

fn camera(
    parameters: &mut Parameters,
    rgb: Option<&CameraConfig>,
    depth: Option<&CameraConfig>,
) -> Result<Settings, Fault> {
    let common = Common::new(parameters, 5.0)?;
    if let Some(depth) = depth {
        return refused(format!(
            "an interface of type 'camera' has no depth for '{}'; use the type 'realsense', or remove the entry",
            depth.name
        ));
    }
    let Some(path) = parameters.text("name")? else {
        return refused("its interface needs a 'name', the camera's device node, such as '/dev/video0'");
    };
    Ok(common.settings(rgb.map(|_| Source::Node(path)), None))
}

fn realsense(
    parameters: &mut Parameters,
    rgb: Option<&CameraConfig>,
    depth: Option<&CameraConfig>,
) -> Result<Settings, Fault> {
    let common = Common::new(parameters, 30.0)?;
    let topics = [parameters.text("rgb_topic")?, parameters.text("topic")?];
    let serial =
        parameters.text("serial")?.or_else(|| topics.iter().flatten().find_map(|topic| serial_in(topic)));
    // Parameters of the separate program that sends frames to RoboHive.
    parameters.skip(&["d_topic", "data_type"]);
    let nodes = [parameters.text("name")?, parameters.text("depth_name")?];
    let unit = parameters.number("depth_unit", 0.001, [1e-6, 0.1])?;
    let registration = registration(parameters, [common.width, common.height])?;
    let [colour_source, depth_source] = nodes.map(|node| match node {
        Some(path) => Source::Node(path),
        None => Source::RealSense(serial.clone()),
    });
    let depth = depth.map(|entry| Depth {
        request: common.request(depth_source, vec![Encoding::Z16]),
        unit,
        registration,
        scale: entry.scale,
        offset: entry.offset,
        range: entry.range,
    });
    Ok(common.settings(rgb.map(|_| colour_source), depth))
}

/// The digits after the first underscore of a topic of RoboHive, such as `realsense_815412070228/color/image_raw`.
fn serial_in(topic: &str) -> Option<String> {
    let digits: String = topic.split_once('_')?.1.chars().take_while(char::is_ascii_digit).collect();
    (!digits.is_empty()).then_some(digits)
}

fn registration(parameters: &mut Parameters, size: [usize; 2]) -> Result<Option<Registration>, Fault> {
    let mut list = |key: &'static str, count: usize| match parameters.numbers(key)? {
        Some(numbers) if numbers.len() != count || !numbers.iter().all(|number| number.is_finite()) => {
            refused(format!(
                "the parameter '{key}' of its interface must be a list of {count} finite numbers"
            ))
        }
        numbers => Ok(numbers),
    };
    let (to, from, pose) =
        (list("rgb_intrinsics", 4)?, list("depth_intrinsics", 4)?, list("depth_to_rgb", 12)?);
    let (to, from) = match (to, from) {
        (Some(to), Some(from)) => {
            (intrinsics("rgb_intrinsics", &to, size)?, intrinsics("depth_intrinsics", &from, size)?)
        }
        (None, None) if pose.is_none() => return Ok(None),
        _ => {
            return refused(
                "its interface needs both 'rgb_intrinsics' and 'depth_intrinsics' to align depth to colours",
            );
        }
    };
    let pose = pose.unwrap_or_else(|| vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    let rotation = [0, 1, 2].map(|row| [0, 1, 2].map(|column| pose[3 * row + column]));
    for [a, b] in [[0, 1], [0, 2], [1, 2], [0, 0], [1, 1], [2, 2]] {
        let product: f64 = (0..3).map(|k| rotation[a][k] * rotation[b][k]).sum();
        if (product - f64::from(u8::from(a == b))).abs() > 1e-3 {
            return refused("the first nine numbers of 'depth_to_rgb' must be a rotation matrix, row by row");
        }
    }
    Ok(Some(Registration { from, to, rotation, translation: [pose[9], pose[10], pose[11]] }))
}

fn intrinsics(key: &str, numbers: &[f64], size: [usize; 2]) -> Result<Intrinsics, Fault> {
    if numbers[0] <= 0.0 || numbers[1] <= 0.0 {
        return refused(format!(
            "the first two numbers of '{key}' are focal lengths in pixels and must be positive"
        ));
    }
    Ok(Intrinsics { size, focal: [numbers[0], numbers[1]], centre: [numbers[2], numbers[3]] })
}
