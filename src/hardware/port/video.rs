//! Frames from Linux's Video4Linux.

use super::capture::{Capture, Encoding, Format, Frame, Request};
use moq_v4l::buffer::{Flags, Type};
use moq_v4l::capability::Flags as Can;
use moq_v4l::io::traits::CaptureStream;
use moq_v4l::prelude::MmapStream;
use moq_v4l::video::Capture as _;
use moq_v4l::video::capture::Parameters;
use moq_v4l::{Device, FourCC};
use robot::Fault;
use std::io;
use std::time::Duration;

/// Buffers that the driver fills while others are read.
const BUFFERS: u32 = 4;
/// `POLLIN`: something can be read.
const READABLE: i16 = 1;

/// A video device that sends frames.
pub(super) struct Video {
    stream: MmapStream<'static>,
    format: Format,
    /// Whether the driver has the buffers.
    begun: bool,
}

impl Video {
    /// Begins the stream of a node.
    ///
    /// # Errors
    /// There is no such node, it is in use, or it does not support the request; the error lists what it supports.
    pub(super) fn open(path: &str, request: &Request) -> Result<Video, Fault> {
        let device = Device::with_path(path).map_err(|error| unopened(path, &error))?;
        let failed = |error: io::Error| Fault::Unreachable(format!("{path}: {error}"));
        let capabilities = device.query_caps().map_err(failed)?.capabilities;
        if !capabilities.contains(Can::VIDEO_CAPTURE | Can::STREAMING) {
            return Err(Fault::Refused(format!(
                "{path} is not a camera: it sends no frames; choose another node"
            )));
        }
        let encoding = encoding_of(&device, path, request)?;
        let mut format = device.format().map_err(failed)?;
        (format.width, format.height) = (request.width as u32, request.height as u32);
        format.fourcc = FourCC::new(encoding.fourcc());
        let format = device.set_format(&format).map_err(|error| busy(path, &error))?;
        if format.fourcc.repr != *encoding.fourcc()
            || [format.width as usize, format.height as usize] != [request.width, request.height]
        {
            return Err(Fault::Refused(format!(
                "{path} offers {} x {} pixels instead of {} x {}; set 'width' and 'height' of its interface to these",
                format.width, format.height, request.width, request.height
            )));
        }
        let asked = Parameters::with_fps(request.rate.round() as u32);
        let interval = device.set_params(&asked).map_err(failed)?.interval;
        let rate = f64::from(interval.denominator) / f64::from(interval.numerator.max(1));
        if (rate - request.rate).abs() > 0.05 * request.rate {
            return Err(Fault::Refused(format!(
                "{path} offers {rate:.0} frames a second at this size instead of {}; set the 'rate' of its interface to this",
                request.rate
            )));
        }
        let stream = MmapStream::with_buffers(&device, Type::VideoCapture, BUFFERS)
            .map_err(|error| busy(path, &error))?;
        let format = Format { encoding, width: request.width, height: request.height, rate };
        Ok(Video { stream, format, begun: false })
    }

    /// Whether a node sends frames in one of these encodings.
    pub(super) fn offers(path: &str, encodings: &[Encoding]) -> bool {
        Device::with_path(path).is_ok_and(|device| best(&device, encodings).is_some())
    }
}

/// The first of the encodings that a device has.
fn best(device: &Device, encodings: &[Encoding]) -> Option<Encoding> {
    let offered = device.enum_formats().ok()?;
    encodings
        .iter()
        .copied()
        .find(|encoding| offered.iter().any(|format| format.fourcc.repr == *encoding.fourcc()))
}

fn encoding_of(device: &Device, path: &str, request: &Request) -> Result<Encoding, Fault> {
    best(device, &request.encodings).ok_or_else(|| {
        let offered = device.enum_formats().unwrap_or_default();
        let offered: Vec<_> = offered.iter().map(|format| format.fourcc.to_string()).collect();
        let asked: Vec<_> = request.encodings.iter().map(Encoding::to_string).collect();
        Fault::Refused(format!(
            "{path} offers the formats {}, and none of {}",
            offered.join(", "),
            asked.join(", ")
        ))
    })
}

fn unopened(path: &str, error: &io::Error) -> Fault {
    let advice = match error.kind() {
        io::ErrorKind::NotFound => "; `robohive hardware list` shows the cameras of this machine",
        io::ErrorKind::PermissionDenied => {
            "; add yourself to the group video (sudo usermod -aG video $USER) and log in again"
        }
        _ => "",
    };
    Fault::Unreachable(format!("{path}: {error}{advice}"))
}

fn busy(path: &str, error: &io::Error) -> Fault {
    let advice = match error.kind() {
        io::ErrorKind::ResourceBusy => "; another program uses the camera: close it",
        _ => "",
    };
    Fault::Unreachable(format!("{path}: {error}{advice}"))
}

impl Capture for Video {
    fn format(&self) -> Format {
        self.format
    }

    fn next(&mut self, wait: Duration) -> io::Result<Option<Frame<'_>>> {
        // The first call gives the driver all buffers and waits; later ones give back the buffer that was read, which must
        // happen once a frame only.
        if self.begun {
            let milliseconds = i32::try_from(wait.as_millis()).unwrap_or(i32::MAX);
            if self.stream.handle().poll(READABLE, milliseconds)? == 0 {
                return Ok(None);
            }
        } else {
            self.stream.set_timeout(Duration::from_secs(5));
        }
        let (bytes, about) = self.stream.next()?;
        self.begun = true;
        let used = (about.bytesused as usize).min(bytes.len());
        Ok(Some(Frame {
            bytes: &bytes[..used],
            sequence: about.sequence,
            time: about.timestamp.sec as f64 + 1e-6 * about.timestamp.usec as f64,
            damaged: about.flags.contains(Flags::ERROR),
        }))
    }
}
