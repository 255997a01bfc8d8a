//! Reading datasets: numbers, texts of tasks, and pictures that are in the Parquet files.

use super::features::{Feature, FeatureKind};
use super::series::{CHUNK_FILES, file_name};
use super::table::{Cells, Column};
use crate::json;
use dataset::trace::TraceError;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::file::reader::{FileReader, SerializedFileReader};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Largest number of frames of an episode, of a chunk, and of a file.
const LARGEST: usize = 1 << 28;

/// A dataset.
pub struct LeRobotReader {
    root: PathBuf,
    info: Value,
    features: Vec<Feature>,
    tasks: Vec<(i64, String)>,
    episodes: Vec<Place>,
    /// Files of the table of episodes.
    tables: usize,
}

/// Where the frames of an episode are.
#[derive(Clone, Copy, Debug)]
struct Place {
    chunk: usize,
    file: usize,
    first: usize,
    frames: usize,
}

impl LeRobotReader {
    /// Opens the dataset in a folder.
    ///
    /// # Errors
    /// A file is missing or damaged, or the dataset has another version.
    pub fn open(root: &Path) -> Result<Self, TraceError> {
        let path = root.join("meta/info.json");
        let fail = |message: String| TraceError::new(&path, "", message);
        let info = json::read(&path)?;
        let version = info.get("codebase_version").and_then(Value::as_str).unwrap_or("none");
        if !version.starts_with("v3.") {
            return Err(fail(format!(
                "version {version} is not read: convert the dataset to v3.0 with lerobot's own script"
            )));
        }
        let Some(entries) = info.get("features").and_then(Value::as_object) else {
            return Err(fail("the file has no features".into()));
        };
        let features = entries.iter().filter_map(|(name, entry)| Feature::from_json(name, entry)).collect();
        let mut out = LeRobotReader {
            root: root.to_owned(),
            info,
            features,
            tasks: Vec::new(),
            episodes: Vec::new(),
            tables: 0,
        };
        out.read_tasks()?;
        out.read_episodes()?;
        Ok(out)
    }

    /// What `info.json` says.
    pub fn info(&self) -> &Value {
        &self.info
    }

    /// The features of a frame whose types are known.
    pub fn features(&self) -> &[Feature] {
        &self.features
    }

    /// Number of episodes.
    pub fn episodes(&self) -> usize {
        self.episodes.len()
    }

    /// Texts of the tasks, in the order of their numbers.
    pub(super) fn tasks(&self) -> Vec<String> {
        let mut tasks = self.tasks.clone();
        tasks.sort_by_key(|(index, _)| *index);
        tasks.into_iter().map(|(_, text)| text).collect()
    }

    /// Frames of all episodes, and the numbers of the files that come next: of frames and of the table of episodes.
    pub(super) fn end(&self) -> (usize, usize, usize) {
        let frames = self.episodes.iter().map(|place| place.frames).sum();
        let number = |place: &Place| place.chunk * CHUNK_FILES + place.file + 1;
        let next = self.episodes.iter().map(number).max().unwrap_or(0);
        (frames, next, self.tables)
    }

    /// Paths of the files with frames and videos.
    ///
    /// # Errors
    /// A table of episodes lacks where a video is.
    pub(super) fn files(&self) -> Result<BTreeSet<PathBuf>, TraceError> {
        let mut files: BTreeSet<_> = self.episodes.iter().map(|place| self.root.join(place.path())).collect();
        let videos: Vec<_> = self.features.iter().filter(|f| f.kind == FeatureKind::Video).collect();
        for number in 0..if videos.is_empty() { 0 } else { self.tables } {
            let table = self.table(number)?;
            for Feature { name, .. } in &videos {
                let read = |part: &str| table.counts(&format!("videos/{name}/{part}"));
                for (chunk, file) in read("chunk_index")?.into_iter().zip(read("file_index")?) {
                    let path = format!("videos/{name}/chunk-{chunk:03}/file-{file:03}.mp4");
                    files.insert(self.root.join(path));
                }
            }
        }
        Ok(files)
    }

    /// The text of a task.
    pub fn task(&self, index: i64) -> Option<&str> {
        self.tasks.iter().find(|(known, _)| *known == index).map(|(_, text)| &text[..])
    }

    /// The frames of an episode: all features but videos.
    ///
    /// # Errors
    /// There is no such episode, or a file is missing or damaged.
    pub fn read(&self, episode: usize) -> Result<Vec<Column>, TraceError> {
        let Some(place) = self.episodes.get(episode) else {
            let message = format!("there is no episode {episode}: the dataset has {}", self.episodes.len());
            return Err(TraceError::new(&self.root, "", message));
        };
        let path = self.root.join(place.path());
        // Frames of the file that belong to episodes before.
        let same = |other: &&Place| (other.chunk, other.file) == (place.chunk, place.file);
        let start = self.episodes.iter().filter(same).map(|other| other.first).min().unwrap_or(0);
        let rows = place.first - start..place.first - start + place.frames;
        let file = Parquet::open(&path)?;
        let wanted = self.features.iter().filter(|feature| feature.kind != FeatureKind::Video);
        wanted.map(|feature| file.column(feature, rows.clone())).collect()
    }

    fn read_tasks(&mut self) -> Result<(), TraceError> {
        let file = Parquet::open(&self.root.join("meta/tasks.parquet"))?;
        let texts = if file.has("__index_level_0__") { "__index_level_0__" } else { "task" };
        let all = 0..file.rows;
        let indices = file.integers("task_index", all.clone())?;
        let texts = file.values(texts, all)?;
        let Cells::Text(texts) = texts else { return Err(file.fail("task", "its elements are no texts")) };
        self.tasks = indices.into_iter().zip(texts).collect();
        Ok(())
    }

    fn read_episodes(&mut self) -> Result<(), TraceError> {
        let total = self.info.get("total_episodes").and_then(Value::as_u64);
        let Some(total) = total else {
            let path = self.root.join("meta/info.json");
            return Err(TraceError::new(&path, "total_episodes", "the number of episodes is missing"));
        };
        let mut number = 0;
        while (self.episodes.len() as u64) < total {
            let file = self.table(number)?;
            let (chunks, files) = (file.counts("data/chunk_index")?, file.counts("data/file_index")?);
            let (firsts, lengths) =
                (file.integers("dataset_from_index", 0..file.rows)?, file.counts("length")?);
            for i in 0..file.rows {
                let Ok(first) = usize::try_from(firsts[i]) else {
                    return Err(file.fail("dataset_from_index", "a number is out of range"));
                };
                self.episodes.push(Place { chunk: chunks[i], file: files[i], first, frames: lengths[i] });
            }
            if file.rows == 0 {
                return Err(
                    file.fail("", format!("{} episodes, info.json says {total}", self.episodes.len()))
                );
            }
            number += 1;
        }
        self.tables = number;
        Ok(())
    }

    /// A file of the table of episodes.
    fn table(&self, number: usize) -> Result<Parquet, TraceError> {
        Parquet::open(&self.root.join(format!("meta/episodes/{}.parquet", file_name(number))))
    }
}

impl Place {
    /// Path of the file with the frames, in the dataset's folder.
    fn path(&self) -> String {
        format!("data/chunk-{:03}/file-{:03}.parquet", self.chunk, self.file)
    }
}

/// A Parquet file that is being read.
struct Parquet {
    path: PathBuf,
    reader: SerializedFileReader<File>,
    rows: usize,
}

impl Parquet {
    fn open(path: &Path) -> Result<Self, TraceError> {
        let file = File::open(path).map_err(|e| TraceError::new(path, "", e))?;
        let reader = SerializedFileReader::new(file)
            .map_err(|e| TraceError::new(path, "", format!("no Parquet file, or a damaged one: {e}")))?;
        let rows = usize::try_from(reader.metadata().file_metadata().num_rows()).unwrap_or(0);
        Ok(Parquet { path: path.to_owned(), reader, rows })
    }

    fn fail(&self, column: &str, message: impl ToString) -> TraceError {
        TraceError::new(&self.path, column, message.to_string())
    }

    /// The number of the leaf of a column; for pictures the leaf with their files.
    fn leaf(&self, name: &str) -> Option<usize> {
        let schema = self.reader.metadata().file_metadata().schema_descr();
        schema.columns().iter().position(|column| column.path().parts()[0] == name)
    }

    fn has(&self, name: &str) -> bool {
        self.leaf(name).is_some()
    }

    /// Some rows of a feature.
    fn column(&self, feature: &Feature, rows: std::ops::Range<usize>) -> Result<Column, TraceError> {
        let count = rows.len();
        let cells = self.values(&feature.name, rows)?;
        let length = cells.len();
        let row = if feature.shape == [1] || feature.kind.is_picture() {
            Vec::new()
        } else {
            feature.shape.clone()
        };
        let width: usize = row.iter().product();
        if length != count * width {
            let message = format!(
                "{length} values, where {count} frames of shape {:?} need {}",
                feature.shape,
                count * width
            );
            return Err(self.fail(&feature.name, message));
        }
        Ok(Column { name: feature.name.clone(), row, cells })
    }

    fn integers(&self, name: &str, rows: std::ops::Range<usize>) -> Result<Vec<i64>, TraceError> {
        let count = rows.len();
        match self.values(name, rows)? {
            Cells::I64(values) if values.len() == count => Ok(values),
            _ => Err(self.fail(name, "its elements are no integers, or some are missing")),
        }
    }

    /// A column of numbers of frames or files.
    fn counts(&self, name: &str) -> Result<Vec<usize>, TraceError> {
        let count = |n: i64| usize::try_from(n).ok().filter(|&n| n <= LARGEST);
        let counts = self.integers(name, 0..self.rows)?.into_iter().map(count).collect::<Option<_>>();
        counts.ok_or_else(|| self.fail(name, "a number is out of range"))
    }

    /// The scalars of some rows.
    fn values(&self, name: &str, rows: std::ops::Range<usize>) -> Result<Cells, TraceError> {
        let Some(leaf) = self.leaf(name) else { return Err(self.fail(name, "the file has no such column")) };
        let mut out = None;
        let mut start = 0;
        for group in 0..self.reader.num_row_groups() {
            let read = || -> parquet::errors::Result<(usize, Option<Cells>)> {
                let group = self.reader.get_row_group(group)?;
                let held = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
                let (low, high) = (rows.start.max(start), rows.end.min(start + held));
                if low >= high {
                    return Ok((held, None));
                }
                let picture =
                    group.metadata().column(leaf).column_path().parts().last().is_some_and(|p| p == "bytes");
                let reader = group.get_column_reader(leaf)?;
                cells_of(reader, low - start, high - low, picture).map(|cells| (held, Some(cells)))
            };
            let (held, cells) = read().map_err(|e| self.fail(name, e))?;
            start += held;
            out = match (out, cells) {
                (None, cells) => cells,
                (Some(all), None) => Some(all),
                (Some(all), Some(more)) => {
                    let mut all = Column::scalars(name, all);
                    all.append(Column::scalars(name, more));
                    Some(all.cells)
                }
            };
        }
        out.ok_or_else(|| {
            self.fail(name, format!("rows {rows:?} are not in the file, which has {}", self.rows))
        })
    }
}

fn cells_of(reader: ColumnReader, skip: usize, rows: usize, picture: bool) -> parquet::errors::Result<Cells> {
    Ok(match reader {
        ColumnReader::BoolColumnReader(r) => Cells::Bool(records(r, skip, rows)?),
        ColumnReader::Int32ColumnReader(r) => {
            Cells::I64(records(r, skip, rows)?.into_iter().map(i64::from).collect())
        }
        ColumnReader::Int64ColumnReader(r) => Cells::I64(records(r, skip, rows)?),
        ColumnReader::FloatColumnReader(r) => Cells::F32(records(r, skip, rows)?),
        ColumnReader::DoubleColumnReader(r) => Cells::F64(records(r, skip, rows)?),
        ColumnReader::ByteArrayColumnReader(r) => {
            let values: Vec<ByteArray> = records(r, skip, rows)?;
            if picture {
                Cells::Png(values.into_iter().map(|value| value.data().to_vec()).collect())
            } else {
                let text = |value: ByteArray| String::from_utf8_lossy(value.data()).into_owned();
                Cells::Text(values.into_iter().map(text).collect())
            }
        }
        _ => return Err(parquet::errors::ParquetError::General("elements of this type are not read".into())),
    })
}

/// The scalars of rows.
fn records<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    skip: usize,
    rows: usize,
) -> parquet::errors::Result<Vec<T::T>> {
    reader.skip_records(skip)?;
    let (mut values, mut defined, mut nested) = (Vec::new(), Vec::new(), Vec::new());
    let mut left = rows;
    while left > 0 {
        let (read, ..) = reader.read_records(left, Some(&mut defined), Some(&mut nested), &mut values)?;
        if read == 0 {
            break;
        }
        left -= read;
    }
    Ok(values)
}
