//! Reading recordings: HDF5 files and numpy archives, a dataset when it is asked for.

use super::error::TraceError;
use super::layout::Layout;
use super::recorder::is_npz;
use crate::hdf5::dataset::Dataset;
use crate::hdf5::datatype::Datatype;
use crate::hdf5::file::{Hdf5Reader, Member};
use crate::npy::{Array, Dtype, Values};
use crate::npz::NpzReader;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Bytes of a dataset that is read whole at most: rows of a longer one are read piece by piece.
const MAX_BYTES: u64 = 1 << 32;

/// A recording.
pub struct TraceReader {
    path: PathBuf,
    store: Store,
    /// Names in the order of their numbers.
    trials: Vec<String>,
}

enum Store {
    Hdf5 { file: Box<Hdf5Reader>, members: BTreeMap<String, Member> },
    Npz(NpzReader),
}

/// A dataset of a trial.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name of the trial.
    pub trial: String,
    /// Name inside of the trial, as in `env_infos/obs_dict/qp`.
    pub key: String,
    /// Lengths of the axes; empty for a scalar.
    pub shape: Vec<usize>,
    /// Type of its elements.
    pub kind: EntryType,
    content: Content,
}

/// Type of the elements of a dataset.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EntryType {
    /// Numbers.
    Number(Dtype),
    /// Texts.
    Text,
    /// What is not read, by its name.
    Other(String),
}

impl EntryType {
    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            EntryType::Number(dtype) => dtype.name(),
            EntryType::Text => "text",
            EntryType::Other(name) => name,
        }
    }
}

#[derive(Clone, Debug)]
enum Content {
    Hdf5 { dataset: Box<Dataset>, big_endian: bool },
    Array(Array),
}

impl Entry {
    /// Number of rows: the first axis, or one for a scalar.
    pub fn rows(&self) -> usize {
        self.shape.first().copied().unwrap_or(1)
    }

    /// Rows that are read together at the least cost.
    pub fn rows_together(&self) -> usize {
        match &self.content {
            Content::Hdf5 { dataset, .. } => dataset.rows_together(),
            Content::Array(_) => self.rows().max(1),
        }
    }

    /// Trial and key, for messages.
    pub fn path(&self) -> String {
        format!("{}/{}", self.trial, self.key)
    }
}

impl TraceReader {
    /// Opens a recording, an HDF5 file or a numpy archive by what it begins with.
    ///
    /// # Errors
    /// The file cannot be read, is neither, or is damaged.
    pub fn open(path: &Path) -> Result<Self, TraceError> {
        if is_npz(path) {
            return Self::npz(path, NpzReader::open(path)?);
        }
        Self::hdf5(Hdf5Reader::open(path)?)
    }

    /// Reads a recording in memory; `name` stands for its path in messages.
    ///
    /// # Errors
    /// The bytes are neither an HDF5 file nor a numpy archive, or are damaged.
    pub fn memory(name: &str, bytes: Vec<u8>) -> Result<Self, TraceError> {
        let path = Path::new(name);
        let named = |e: TraceError| TraceError { path: path.to_owned(), ..e };
        if bytes.starts_with(b"PK") {
            let archive = NpzReader::read(Cursor::new(bytes)).map_err(|e| named(e.into()))?;
            return Self::npz(path, archive);
        }
        let reader = Hdf5Reader::memory(bytes).map_err(TraceError::from).and_then(Self::hdf5);
        reader.map(|reader| TraceReader { path: path.to_owned(), ..reader }).map_err(named)
    }

    fn npz(path: &Path, archive: NpzReader) -> Result<Self, TraceError> {
        let mut trials: Vec<String> = archive
            .names()
            .map(|name| name.split_once('/').map(|(trial, _)| trial.to_owned()))
            .collect::<Option<_>>()
            .ok_or_else(|| {
                TraceError::new(path, "", "no recording: its arrays have no trial/ before their names")
            })?;
        trials.dedup();
        trials.sort_by(|a, b| natural(a).cmp(&natural(b)));
        Ok(TraceReader { path: path.to_owned(), store: Store::Npz(archive), trials })
    }

    /// The recording in an open file.
    ///
    /// # Errors
    /// The file is damaged.
    pub(super) fn hdf5(file: Hdf5Reader) -> Result<Self, TraceError> {
        let members: BTreeMap<String, Member> = file.members("")?.into_iter().collect();
        let mut trials: Vec<String> = members.keys().cloned().collect();
        trials.sort_by(|a, b| natural(a).cmp(&natural(b)));
        let path = file.path().to_owned();
        Ok(TraceReader { path, store: Store::Hdf5 { file: Box::new(file), members }, trials })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the trials; `Trial2` stands before `Trial10`.
    pub fn trials(&self) -> &[String] {
        &self.trials
    }

    /// Texts that describe the file.
    ///
    /// # Errors
    /// The file is damaged.
    pub fn attributes(&self) -> Result<Vec<(String, String)>, TraceError> {
        match &self.store {
            Store::Hdf5 { file, .. } => Ok(file.attributes()?),
            Store::Npz(_) => Ok(Vec::new()),
        }
    }

    /// Integers that are attributes of a trial's group.
    ///
    /// # Errors
    /// There is no such trial, or the file is damaged.
    pub fn integers(&self, trial: &str) -> Result<Vec<(String, i64)>, TraceError> {
        match &self.store {
            Store::Hdf5 { file, .. } => Ok(file.integers(trial)?),
            Store::Npz(_) => Ok(Vec::new()),
        }
    }

    /// The datasets of a trial, sorted by key.
    ///
    /// # Errors
    /// There is no such trial, or the file is damaged.
    pub fn entries(&self, trial: &str) -> Result<Vec<Entry>, TraceError> {
        let mut out = Vec::new();
        for (key, place) in self.places(trial)? {
            out.push(self.at(trial, key, place)?);
        }
        Ok(out)
    }

    /// A dataset of a trial.
    ///
    /// # Errors
    /// There is no such dataset, or the file is damaged.
    pub fn entry(&self, trial: &str, key: &str) -> Result<Entry, TraceError> {
        let places = self.places(trial)?;
        let found = places.into_iter().find(|(found, _)| found == key);
        let (key, place) = found.ok_or_else(|| {
            TraceError::new(&self.path, format!("{trial}/{key}"), "the recording has no such dataset")
        })?;
        self.at(trial, key, place)
    }

    /// The layout of a trial, if it is one of the two.
    ///
    /// # Errors
    /// There is no such trial, or the file is damaged.
    pub fn layout(&self, trial: &str) -> Result<Option<Layout>, TraceError> {
        let places = self.places(trial)?;
        Ok(Layout::of(places.iter().map(|(key, _)| &key[..])))
    }

    /// Keys of a trial, sorted, and where the datasets are: in HDF5 an address.
    fn places(&self, trial: &str) -> Result<Vec<(String, u64)>, TraceError> {
        let missing = || TraceError::new(&self.path, trial, "the recording has no such trial");
        let mut out = match &self.store {
            Store::Hdf5 { file, members } => file.walk(trial, members.get(trial).ok_or_else(missing)?)?,
            Store::Npz(archive) => {
                let key = |name: &str| Some((name.strip_prefix(trial)?.strip_prefix('/')?.to_owned(), 0));
                archive.names().filter_map(key).collect()
            }
        };
        if out.is_empty() && !self.trials.iter().any(|name| name == trial) {
            return Err(missing());
        }
        out.sort();
        Ok(out)
    }

    fn at(&self, trial: &str, key: String, place: u64) -> Result<Entry, TraceError> {
        let path = format!("{trial}/{key}");
        let (shape, kind, content) = match &self.store {
            Store::Npz(archive) => {
                let array = archive.require(&path)?;
                (array.shape.clone(), EntryType::Number(array.values.dtype()), Content::Array(array))
            }
            Store::Hdf5 { file, .. } => {
                let dataset = Box::new(file.dataset(&path, place)?);
                let (kind, big_endian) = match &dataset.datatype {
                    Datatype::Number { dtype, big_endian } => (EntryType::Number(*dtype), *big_endian),
                    Datatype::FixedText(_) | Datatype::Text => (EntryType::Text, false),
                    Datatype::Other(name) => (EntryType::Other(name.clone()), false),
                };
                (dataset.shape.clone(), kind, Content::Hdf5 { dataset, big_endian })
            }
        };
        Ok(Entry { trial: trial.to_owned(), key, shape, kind, content })
    }

    /// All of a dataset.
    ///
    /// # Errors
    /// It holds no numbers, is longer than 4 GiB, or the file is damaged.
    pub fn read(&self, entry: &Entry) -> Result<Array, TraceError> {
        if let Content::Hdf5 { dataset, .. } = &entry.content
            && dataset.rows().saturating_mul(dataset.row_bytes()) as u64 > MAX_BYTES
        {
            let message = format!("more than {MAX_BYTES} bytes: read it row by row");
            return Err(TraceError::new(&self.path, entry.path(), message));
        }
        let array = self.rows(entry, 0..entry.rows())?;
        Ok(Array { shape: entry.shape.clone(), ..array })
    }

    /// Some rows of a dataset; of a scalar, row 0.
    ///
    /// # Errors
    /// It holds no numbers, has no such rows, or the file is damaged.
    pub fn rows(&self, entry: &Entry, rows: Range<usize>) -> Result<Array, TraceError> {
        let fail = |message: String| TraceError::new(&self.path, entry.path(), message);
        let EntryType::Number(dtype) = entry.kind else {
            return Err(fail(format!("its elements are of type {}, no numbers", entry.kind.name())));
        };
        let row = entry.shape.get(1..).unwrap_or_default();
        let shape = [&[rows.len()], row].concat();
        let mut bytes = match (&entry.content, &self.store) {
            (Content::Hdf5 { dataset, .. }, Store::Hdf5 { file, .. }) => {
                file.rows(&entry.path(), dataset, rows)?
            }
            (Content::Array(array), _) => {
                let mut all = Vec::new();
                array.values.put_bytes(&mut all);
                let width = row.iter().product::<usize>() * dtype.bytes();
                let some = all.get(rows.start * width..rows.end * width);
                some.ok_or_else(|| fail(format!("rows {rows:?} of {} are asked for", entry.rows())))?.to_vec()
            }
            _ => return Err(fail("the dataset belongs to another recording".into())),
        };
        if let Content::Hdf5 { big_endian: true, .. } = entry.content {
            bytes.chunks_exact_mut(dtype.bytes()).for_each(<[u8]>::reverse);
        }
        Ok(Array { shape, values: Values::from_bytes(dtype, &bytes) })
    }

    /// The texts of a dataset.
    ///
    /// # Errors
    /// It holds no texts, or the file is damaged.
    pub fn texts(&self, entry: &Entry) -> Result<Vec<String>, TraceError> {
        match (&entry.content, &self.store) {
            (Content::Hdf5 { dataset, .. }, Store::Hdf5 { file, .. }) => {
                Ok(file.texts(&entry.path(), dataset)?)
            }
            _ => Err(TraceError::new(&self.path, entry.path(), "its elements are no texts")),
        }
    }
}

/// A name with the number at its end as a number.
fn natural(name: &str) -> (&str, u64, &str) {
    let start = name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    (&name[..start], name[start..].parse().unwrap_or(0), name)
}
