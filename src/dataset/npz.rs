//! Numpy archives: a zip file with one `.npy` member an array.
//!
//! ```
//! use robohive_dataset::{Array, NpzReader, NpzWriter};
//! use std::io::Cursor;
//!
//! let mut bytes = Cursor::new(Vec::new());
//! let mut writer = NpzWriter::new(&mut bytes);
//! writer.add("qpos", &Array::f64(vec![2], vec![0.1, 0.2]))?;
//! writer.finish()?;
//! let archive = NpzReader::read(bytes)?;
//! assert_eq!(archive.require("qpos")?.values.to_f64(), [0.1, 0.2]);
//! assert!(archive.get("qvel")?.is_none());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::expansion;
use crate::npy::{Array, MAX_SCALARS};
use std::collections::BTreeMap;
use std::fmt;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;

/// Bytes of all members of an archive together: small archives that unpack to all memory are refused.
pub const MAX_BYTES: u64 = 8 * MAX_SCALARS as u64 + 4096;

/// What is wrong with an archive, and in which member.
#[derive(Debug)]
pub struct NpzError {
    /// File, empty when the archive is in memory.
    pub path: PathBuf,
    /// Member, empty when the archive itself is at fault.
    pub member: String,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for NpzError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if !self.member.is_empty() {
            write!(f, ", array {:?}", self.member)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for NpzError {}

/// An archive read into memory; arrays are decoded on demand and sorted by name.
pub struct NpzReader {
    path: PathBuf,
    members: BTreeMap<String, Vec<u8>>,
}

impl NpzReader {
    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read or is no archive of arrays.
    pub fn open(path: &Path) -> Result<Self, NpzError> {
        let fail = |message: String| NpzError { path: path.to_owned(), member: String::new(), message };
        let file = std::fs::File::open(path).map_err(|e| fail(e.to_string()))?;
        let mut reader =
            Self::read(std::io::BufReader::new(file)).map_err(|e| NpzError { path: path.to_owned(), ..e })?;
        reader.path = path.to_owned();
        Ok(reader)
    }

    /// Reads an archive from any seekable source.
    ///
    /// # Errors
    /// The bytes are no archive of arrays, or unpack to more than [`MAX_BYTES`], or to more than 256 MiB and fifty times
    /// what they are.
    pub fn read(source: impl Read + Seek) -> Result<Self, NpzError> {
        let mut source = source;
        let fail = |e: std::io::Error| NpzError {
            path: PathBuf::new(),
            member: String::new(),
            message: e.to_string(),
        };
        let packed = source.seek(SeekFrom::End(0)).map_err(fail)?;
        source.rewind().map_err(fail)?;
        Self::read_within(source, expansion::most(packed).min(MAX_BYTES))
    }

    fn read_within(source: impl Read + Seek, limit: u64) -> Result<Self, NpzError> {
        let fail = |member: &str, message: String| NpzError {
            path: PathBuf::new(),
            member: member.to_owned(),
            message,
        };
        let mut zip =
            zip::ZipArchive::new(source).map_err(|e| fail("", format!("not a numpy archive: {e}")))?;
        let mut members = BTreeMap::new();
        let mut room = limit;
        for i in 0..zip.len() {
            let file = zip.by_index(i).map_err(|e| fail("", format!("member {i}: {e}")))?;
            let name = file.name().trim_end_matches(".npy").to_owned();
            let mut bytes = Vec::with_capacity(file.size().min(room + 1) as usize);
            file.take(room + 1).read_to_end(&mut bytes).map_err(|e| fail(&name, e.to_string()))?;
            room = room
                .checked_sub(bytes.len() as u64)
                .ok_or_else(|| fail(&name, format!("the archive unpacks to more than {limit} bytes: save it with numpy.savez, which does not compress, or in parts")))?;
            members.insert(name, bytes);
        }
        Ok(NpzReader { path: PathBuf::new(), members })
    }

    /// Names of all arrays, sorted.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.members.keys().map(String::as_str)
    }

    /// True when there is an array called `name`.
    pub fn contains(&self, name: &str) -> bool {
        self.members.contains_key(name)
    }

    /// Decodes an array; `None` when the archive has none of that name.
    ///
    /// # Errors
    /// The member is not a readable array.
    pub fn get(&self, name: &str) -> Result<Option<Array>, NpzError> {
        self.members.get(name).map(|bytes| Array::decode(bytes)).transpose().map_err(|error| NpzError {
            path: self.path.clone(),
            member: name.to_owned(),
            message: error.to_string(),
        })
    }

    /// Decodes an array that must be there.
    ///
    /// # Errors
    /// The array is missing or not readable.
    pub fn require(&self, name: &str) -> Result<Array, NpzError> {
        self.get(name)?.ok_or_else(|| NpzError {
            path: self.path.clone(),
            member: name.to_owned(),
            message: "the archive has no such array".into(),
        })
    }
}

/// Writes an archive array by array.
pub struct NpzWriter<W: Write + Seek> {
    zip: zip::ZipWriter<W>,
}

impl NpzWriter<std::io::BufWriter<std::fs::File>> {
    /// Creates a file, replacing what was there.
    ///
    /// # Errors
    /// The file cannot be created.
    pub fn create(path: &Path) -> std::io::Result<Self> {
        Ok(NpzWriter::new(std::io::BufWriter::new(std::fs::File::create(path)?)))
    }
}

impl<W: Write + Seek> NpzWriter<W> {
    /// Writes to any seekable sink.
    pub fn new(sink: W) -> Self {
        NpzWriter { zip: zip::ZipWriter::new(sink) }
    }

    /// Appends an array, compressed.
    ///
    /// # Errors
    /// Writing fails or the name was used before.
    pub fn add(&mut self, name: &str, array: &Array) -> std::io::Result<()> {
        self.start(name, zip::CompressionMethod::Deflated)?;
        self.zip.write_all(&array.encode())
    }

    /// Appends the array that the bytes of a `.npy` file describe, read piece by piece and stored as they are: a long
    /// trajectory takes no longer than its copy.
    ///
    /// # Errors
    /// Reading or writing fails, or the name was used before.
    pub fn add_npy(&mut self, name: &str, npy: &mut impl Read) -> std::io::Result<()> {
        self.start(name, zip::CompressionMethod::Stored)?;
        std::io::copy(npy, &mut self.zip).map(|_| ())
    }

    /// Begins a member.
    fn start(&mut self, name: &str, method: zip::CompressionMethod) -> std::io::Result<()> {
        // A fixed date keeps equal content equal byte for byte.
        let options = SimpleFileOptions::default()
            .compression_method(method)
            .last_modified_time(zip::DateTime::default())
            .large_file(true);
        Ok(self.zip.start_file(format!("{name}.npy"), options)?)
    }

    /// Completes the archive.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> std::io::Result<()> {
        self.zip.finish()?.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::npy::Values;
    use std::io::Cursor;

    fn archive(arrays: &[(&str, Array)]) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let mut writer = NpzWriter::new(&mut bytes);
        for (name, array) in arrays {
            writer.add(name, array).unwrap();
        }
        writer.finish().unwrap();
        bytes.into_inner()
    }

    #[test]
    fn every_dtype_survives_a_round_trip() {
        let arrays = [
            ("flags", Array { shape: vec![3], values: Values::Bool(vec![true, false, true]) }),
            ("bytes", Array { shape: vec![2], values: Values::U8(vec![7, 255]) }),
            ("ints", Array { shape: vec![2, 1], values: Values::I32(vec![-1, 1 << 30]) }),
            ("longs", Array { shape: vec![], values: Values::I64(vec![-(1 << 40)]) }),
            ("floats", Array { shape: vec![1, 2], values: Values::F32(vec![0.1, f32::MIN_POSITIVE]) }),
            ("doubles", Array::f64(vec![0, 4], vec![])),
        ];
        let reader = NpzReader::read(Cursor::new(archive(&arrays))).unwrap();
        assert_eq!(reader.names().count(), arrays.len());
        for (name, array) in &arrays {
            assert_eq!(&reader.require(name).unwrap(), array);
        }
    }

    #[test]
    fn equal_content_gives_equal_bytes() {
        let arrays = [("x", Array::f64(vec![2], vec![1.0, f64::NAN]))];
        assert_eq!(archive(&arrays), archive(&arrays));
    }

    #[test]
    fn the_size_of_all_members_together_is_bounded() {
        let zeros = Array::f64(vec![1000], vec![0.0; 1000]);
        let packed = archive(&[("a", zeros.clone()), ("b", zeros.clone())]);
        let both = 2 * zeros.encode().len() as u64;
        assert!(packed.len() < 1000);
        assert_eq!(NpzReader::read_within(Cursor::new(&packed), both).unwrap().names().count(), 2);
        let error = NpzReader::read_within(Cursor::new(&packed), both - 1).err().unwrap();
        assert_eq!(error.member, "b");
        assert!(error.message.contains("unpacks to more than"), "{error}");
    }

    /// An array deflated to nothing took 1.4 GB.
    #[test]
    fn what_a_small_archive_unpacks_to_is_bounded() {
        let zeros = Array { shape: vec![300 << 20], values: Values::U8(vec![0; 300 << 20]) };
        let packed = archive(&[("zeros", zeros)]);
        assert!(packed.len() < 1 << 20);
        let error = NpzReader::read(Cursor::new(packed)).err().unwrap();
        assert!(error.message.contains("numpy.savez"), "{error}");
    }

    #[test]
    fn lying_headers_are_refused() {
        let good = Array::f64(vec![4], vec![1.0, 2.0, 3.0, 4.0]).encode();
        assert!(Array::decode(&good[..good.len() - 1]).unwrap_err().to_string().contains("31 bytes"));
        let huge = String::from_utf8_lossy(&good[..80]).replace("(4,)", "(99999999999,)").into_bytes();
        assert!(Array::decode(&huge).is_err());
        assert!(Array::decode(b"PK").unwrap_err().to_string().contains("magic"));
        assert!(NpzReader::read(Cursor::new(b"no zip".to_vec())).is_err());
    }
}
