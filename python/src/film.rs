//! Videos of frames that Python has.

use numpy::{PyReadonlyArray4, PyUntypedArrayMethods};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use std::path::PathBuf;
use video::{Frame, VideoWriter};

/// Writes frames (T x height x width x 3 bytes) as a video, whose format the extension gives: .mp4, .gif or .png.
///
/// # Errors
/// The frames have another shape (`ValueError`), or the file cannot be written (`OSError`).
#[pyfunction]
pub fn write_video(
    py: Python<'_>,
    path: PathBuf,
    frames: PyReadonlyArray4<'_, u8>,
    frames_per_second: f64,
) -> PyResult<()> {
    let (shape, bytes) = (frames.shape(), frames.as_slice()?);
    let (&[_, height, width, 3], true) = (shape, !bytes.is_empty()) else {
        return Err(PyValueError::new_err(format!("frames have shape (T, height, width, 3), not {shape:?}")));
    };
    let size = u32::try_from(width).ok().zip(u32::try_from(height).ok());
    let (width, height) = size.ok_or_else(|| PyValueError::new_err("frames are too large"))?;
    py.detach(|| {
        let mut video = VideoWriter::create(&path, (width, height), frames_per_second)?;
        for frame in bytes.chunks_exact(width as usize * height as usize * 3) {
            video.push(&Frame::new(width, height, frame)?)?;
        }
        video.finish()
    })
    .map_err(|error| PyOSError::new_err(error.to_string()))
}
