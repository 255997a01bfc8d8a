//! A tensor of a file: its type and shape, and where its numbers lie.

use dataset::F16;
use std::io::{Read, Seek, SeekFrom};
use zip::ZipArchive;

/// Most numbers of a tensor.
pub const MAX_NUMBERS: usize = 1 << 26;

/// Type of a tensor's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    F16,
    Bf16,
    F32,
    F64,
    /// Counters and masks, which no network here computes with; bytes of each.
    Other(usize),
}

impl Kind {
    pub(super) fn bytes(self) -> usize {
        match self {
            Kind::F16 | Kind::Bf16 => 2,
            Kind::F32 => 4,
            Kind::F64 => 8,
            Kind::Other(bytes) => bytes,
        }
    }

    /// The numbers of little-endian bytes in single precision; none where they are not floats.
    pub(super) fn decode(self, bytes: &[u8]) -> Option<Vec<f32>> {
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
pub(super) enum Storage {
    /// Bytes of the file.
    Region { offset: u64, bytes: u64 },
    /// A member of the archive.
    Member { index: usize },
}

/// A tensor of a file.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) kind: Kind,
    pub(super) shape: Vec<usize>,
    /// Numbers between neighbours along each axis.
    pub(super) strides: Vec<usize>,
    /// The first number within the storage.
    pub(super) start: usize,
    pub(super) storage: Storage,
}

/// Numbers of a shape, if there are not too many.
pub(super) fn numbers(shape: &[usize]) -> Result<usize, String> {
    let count = shape.iter().try_fold(1usize, |count, &axis| count.checked_mul(axis));
    count
        .filter(|&count| count <= MAX_NUMBERS)
        .ok_or_else(|| format!("its shape {shape:?} has more than {MAX_NUMBERS} numbers"))
}

/// Strides of a shape whose last axis runs fastest.
pub(super) fn row_major(shape: &[usize]) -> Vec<usize> {
    let mut strides = vec![1; shape.len()];
    for axis in (1..shape.len()).rev() {
        strides[axis - 1] = strides[axis] * shape[axis].max(1);
    }
    strides
}

/// A file, or bytes in memory.
pub(super) trait Stream: Read + Seek {}

impl<T: Read + Seek> Stream for T {}

/// Where the storages are read from.
pub(super) enum Source {
    File(Box<dyn Stream>),
    /// An archive, and the length of its file.
    Archive(Box<ZipArchive<Box<dyn Stream>>>, u64),
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

    pub(super) fn read(&self, source: &mut Source) -> Result<Vec<f32>, String> {
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
pub(super) fn read_storage(
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
