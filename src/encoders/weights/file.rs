//! A file with weights: what kind it is, and its tensors by name.

use super::tensor::{Entry, Source, Stream};
use super::{safetensors, torch};
use crate::error::EncoderError;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use zip::ZipArchive;

/// Most tensors of a file.
pub const MAX_TENSORS: usize = 1 << 16;

/// A file with weights, and the list of its tensors.
pub struct WeightFile {
    path: PathBuf,
    entries: BTreeMap<String, Entry>,
    source: Source,
}

impl WeightFile {
    /// Reads the list of tensors of a file; what kind of file it is, its first bytes say.
    ///
    /// # Errors
    /// [`EncoderError::Weights`]: the file cannot be read, is none with weights, is damaged or asks for too much.
    pub fn open(path: &Path) -> Result<Self, EncoderError> {
        let file = File::open(path)
            .map_err(|error| EncoderError::Weights { path: path.to_owned(), reason: error.to_string() })?;
        Self::from_stream(path, BufReader::new(file))
    }

    /// Reads the list of tensors of what is no file of the disk; messages call it `path`.
    ///
    /// # Errors
    /// As [`WeightFile::open`].
    pub fn from_stream(path: &Path, stream: impl Read + Seek + 'static) -> Result<Self, EncoderError> {
        let fail = |reason: String| EncoderError::Weights { path: path.to_owned(), reason };
        let (entries, source) = index(Box::new(stream)).map_err(fail)?;
        if entries.len() > MAX_TENSORS {
            return Err(fail(format!("{} tensors are more than {MAX_TENSORS}", entries.len())));
        }
        Ok(WeightFile { path: path.to_owned(), entries, source })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the tensors, sorted.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.keys().map(String::as_str)
    }

    /// The shape of a tensor.
    pub fn shape(&self, name: &str) -> Option<&[usize]> {
        self.entries.get(name).map(|entry| entry.shape.as_slice())
    }

    /// The numbers of a tensor in single precision, the last axis fastest.
    ///
    /// # Errors
    /// [`EncoderError::Weights`]: there is no such tensor, its storage is damaged or cut off, or its numbers are not finite
    /// floats.
    pub fn read(&mut self, name: &str) -> Result<Vec<f32>, EncoderError> {
        let fail = |reason: String| EncoderError::Weights {
            path: self.path.clone(),
            reason: format!("tensor {name}: {reason}"),
        };
        let entry = self.entries.get(name).ok_or_else(|| fail("the file has none of that name".into()))?;
        let values = entry.read(&mut self.source).map_err(fail)?;
        match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(fail(format!("its number {value} is not finite"))),
            None => Ok(values),
        }
    }
}

/// The tensors of a file and where to read them from.
fn index(mut file: Box<dyn Stream>) -> Result<(BTreeMap<String, Entry>, Source), String> {
    let length = file.seek(SeekFrom::End(0)).map_err(|error| error.to_string())?;
    file.rewind().map_err(|error| error.to_string())?;
    let mut start = Vec::new();
    Read::by_ref(&mut file).take(9).read_to_end(&mut start).map_err(|error| error.to_string())?;
    file.rewind().map_err(|error| error.to_string())?;
    if start.starts_with(b"PK\x03\x04") {
        let mut archive = ZipArchive::new(file).map_err(|error| {
            format!("the file begins as a zip archive and is none, or is cut off: {error}")
        })?;
        let entries = torch::index_archive(&mut archive)?;
        return Ok((entries, Source::Archive(Box::new(archive), length)));
    }
    // The first byte of a safetensors file is part of a length, and may be that of a pickle too.
    let entries = if start.len() == 9 && start[8] == b'{' {
        safetensors::index(&mut *file, length)?
    } else if start.starts_with(&[0x80]) {
        torch::index_legacy(&mut *file, length)?
    } else {
        return Err("it is neither a safetensors file nor one that torch.save wrote".into());
    };
    Ok((entries, Source::File(file)))
}
