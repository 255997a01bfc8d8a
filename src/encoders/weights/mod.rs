//! Tensors of files with weights: safetensors, and what `torch.save` wrote, as a zip archive or in its form before 1.6.
//!
//! Opening a file reads its list of tensors; their numbers are read one tensor at a time. The pickles in files of PyTorch are
//! read without being executed. What a file may ask for is bounded by its own length and by these limits:
//!
//! | what | bound |
//! |---|---|
//! | header of a safetensors file | 4 MiB |
//! | pickle of a PyTorch file, or what precedes its storages | 4 MiB |
//! | tensors | 65,536 |
//! | numbers of a tensor | 2²⁶ |

mod parameters;
mod safetensors;
mod torch;

pub use parameters::{Naming, Parameter, Parameters};

use crate::error::EncoderError;
use dataset::F16;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use zip::ZipArchive;

/// Most bytes of the header of a safetensors file.
pub const MAX_HEADER: u64 = 4 << 20;
/// Most bytes of a pickle, or of what precedes the storages.
pub const MAX_PICKLE: u64 = 4 << 20;
/// Most tensors of a file.
pub const MAX_TENSORS: usize = 1 << 16;
/// Most numbers of a tensor.
pub const MAX_NUMBERS: usize = 1 << 26;

/// Type of a tensor's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    F16,
    Bf16,
    F32,
    F64,
    /// Counters and masks, which no network here computes with; bytes of each.
    Other(usize),
}

impl Kind {
    fn bytes(self) -> usize {
        match self {
            Kind::F16 | Kind::Bf16 => 2,
            Kind::F32 => 4,
            Kind::F64 => 8,
            Kind::Other(bytes) => bytes,
        }
    }

    /// The numbers of little-endian bytes in single precision; none where they are not floats.
    fn decode(self, bytes: &[u8]) -> Option<Vec<f32>> {
        let halves = || bytes.as_chunks::<2>().0.iter().map(|&number| u16::from_le_bytes(number));
        Some(match self {
            Kind::F16 => halves().map(|bits| F16(bits).to_f64() as f32).collect(),
            Kind::Bf16 => halves().map(|bits| f32::from_bits(u32::from(bits) << 16)).collect(),
            Kind::F32 => bytes.as_chunks::<4>().0.iter().map(|&number| f32::from_le_bytes(number)).collect(),
            Kind::F64 => {
                bytes.as_chunks::<8>().0.iter().map(|&number| f64::from_le_bytes(number) as f32).collect()
            }
            Kind::Other(_) => return None,
        })
    }
}

/// Where the numbers of a storage are.
#[derive(Clone, Copy, Debug)]
enum Storage {
    /// Bytes of the file.
    Region { offset: u64, bytes: u64 },
    /// A member of the archive.
    Member { index: usize },
}

/// A tensor of a file.
#[derive(Clone, Debug)]
struct Entry {
    kind: Kind,
    shape: Vec<usize>,
    /// Numbers between neighbours along each axis.
    strides: Vec<usize>,
    /// The first number within the storage.
    start: usize,
    storage: Storage,
}

/// Numbers of a shape, if there are not too many.
fn numbers(shape: &[usize]) -> Result<usize, String> {
    let count = shape.iter().try_fold(1usize, |count, &axis| count.checked_mul(axis));
    count
        .filter(|&count| count <= MAX_NUMBERS)
        .ok_or_else(|| format!("its shape {shape:?} has more than {MAX_NUMBERS} numbers"))
}

/// Strides of a shape whose last axis runs fastest.
fn row_major(shape: &[usize]) -> Vec<usize> {
    let mut strides = vec![1; shape.len()];
    for axis in (1..shape.len()).rev() {
        strides[axis - 1] = strides[axis] * shape[axis].max(1);
    }
    strides
}

/// A file, or bytes in memory.
trait Stream: Read + Seek {}

impl<T: Read + Seek> Stream for T {}

/// Where the storages are read from.
enum Source {
    File(Box<dyn Stream>),
    /// An archive, and the length of its file.
    Archive(Box<ZipArchive<Box<dyn Stream>>>, u64),
}

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
    // The first byte of a safetensors file is part of a length, so it may look like the first byte of a pickle.
    let entries = if start.len() == 9 && start[8] == b'{' {
        safetensors::index(&mut *file, length)?
    } else if start.starts_with(&[0x80]) {
        torch::index_legacy(&mut *file, length)?
    } else {
        return Err("it is neither a safetensors file nor one that torch.save wrote".into());
    };
    Ok((entries, Source::File(file)))
}

impl Entry {
    /// Numbers from the start of the storage to the end of the tensor.
    fn end(&self) -> Result<usize, String> {
        if numbers(&self.shape)? == 0 {
            return Ok(self.start);
        }
        let mut axes = self.shape.iter().zip(&self.strides);
        let last = axes
            .try_fold(self.start, |sum, (&axis, &stride)| sum.checked_add((axis - 1).checked_mul(stride)?));
        last.and_then(|last| last.checked_add(1)).ok_or_else(|| "its strides are too large".into())
    }

    fn read(&self, source: &mut Source) -> Result<Vec<f32>, String> {
        let (count, end) = (numbers(&self.shape)?, self.end()?);
        let span = end - self.start;
        if span > MAX_NUMBERS {
            return Err(format!("it spreads over more than {MAX_NUMBERS} numbers"));
        }
        let skipped = self.start.checked_mul(self.kind.bytes()).ok_or("its offset is too large")?;
        let bytes = read_storage(source, self.storage, skipped, span * self.kind.bytes())?;
        let stored = self.kind.decode(&bytes).ok_or("its numbers are no floats")?;
        if self.strides == row_major(&self.shape) {
            return Ok(stored);
        }
        let place = |index: usize| {
            let (mut rest, mut place) = (index, 0);
            for (&axis, &stride) in self.shape.iter().zip(&self.strides).rev() {
                place += rest % axis * stride;
                rest /= axis;
            }
            place
        };
        Ok((0..count).map(|index| stored[place(index)]).collect())
    }
}

/// Bytes of a storage, the first `skipped` left out.
fn read_storage(
    source: &mut Source,
    storage: Storage,
    skipped: usize,
    bytes: usize,
) -> Result<Vec<u8>, String> {
    let short =
        |held: u64| format!("it ends at byte {} of a storage of {held} bytes", skipped as u64 + bytes as u64);
    let needed = skipped as u64 + bytes as u64;
    match (source, storage) {
        (Source::File(file), Storage::Region { offset, bytes: held }) => {
            if needed > held {
                return Err(short(held));
            }
            let mut out = vec![0; bytes];
            file.seek(SeekFrom::Start(offset + skipped as u64)).map_err(|error| error.to_string())?;
            file.read_exact(&mut out).map_err(|error| error.to_string())?;
            Ok(out)
        }
        (Source::Archive(archive, length), Storage::Member { index }) => {
            let mut member = archive.by_index(index).map_err(|error| error.to_string())?;
            let held = member.size();
            if needed > held {
                return Err(short(held));
            }
            if member.compression() != zip::CompressionMethod::Stored || held > *length {
                return Err(
                    "its member of the archive is compressed, as none that torch.save writes is".into()
                );
            }
            // Read to its end, where its checksum is compared.
            let mut out = Vec::with_capacity(held as usize);
            member.read_to_end(&mut out).map_err(|error| error.to_string())?;
            out.drain(..skipped);
            out.truncate(bytes);
            Ok(out)
        }
        _ => Err("its storage is elsewhere".into()),
    }
}
