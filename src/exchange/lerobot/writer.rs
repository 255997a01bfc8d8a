//! Writing a dataset, episode by episode.

use super::features::{Feature, FeatureKind, NUMBERING};
use super::frames::{Frames, Pictures, numbers};
use super::series::{CHUNK_FILES, FILE_MEGABYTES, Series, file_name, place};
use super::stats::Stats;
use super::table::{Cells, Column, Table};
use crate::json;
use dataset::Array;
use dataset::trace::TraceError;
use serde_json::{Map, Value, json};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use video::{Frame, VideoWriter, png_bytes};

/// Settings of a dataset.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Settings {
    /// Frames a second.
    pub frames_per_second: f64,
    /// The robot, in a word.
    pub robot: Option<String>,
    /// Where pictures are kept.
    pub pictures: Pictures,
}

impl Settings {
    /// A dataset of an unnamed robot at this many frames a second, its pictures in videos.
    pub fn new(frames_per_second: f64) -> Self {
        Settings { frames_per_second, robot: None, pictures: Pictures::default() }
    }

    /// A dataset whose frames are this far apart \[s\].
    pub fn of_period(seconds: f64) -> Self {
        Settings::new(whole_rate(1.0 / seconds))
    }

    /// The robot, in a word.
    #[must_use]
    pub fn with_robot(mut self, robot: Option<String>) -> Self {
        self.robot = robot;
        self
    }

    /// Where pictures are kept.
    #[must_use]
    pub fn with_pictures(mut self, pictures: Pictures) -> Self {
        self.pictures = pictures;
        self
    }
}

/// Frames a second, without what rounding has left of them.
pub(super) fn whole_rate(rate: f64) -> f64 {
    let whole = rate.round();
    if (rate - whole).abs() < 1e-6 * rate { whole } else { (rate * 1e6).round() / 1e6 }
}

/// A dataset that is being written, in a hidden folder beside its final place. It is moved there by
/// [`LeRobotWriter::finish`], or, for [`LeRobotWriter::grow`], after its first episode.
pub struct LeRobotWriter {
    pub(super) root: PathBuf,
    /// Where the files are until then.
    pub(super) folder: PathBuf,
    pub(super) settings: Settings,
    /// It is complete after every episode.
    pub(super) grows: bool,
    /// Those of the first episode.
    pub(super) features: Vec<Feature>,
    pub(super) tasks: Vec<String>,
    pub(super) stats: Vec<(String, Stats)>,
    pub(super) data: Series,
    pub(super) table: Series,
    pub(super) episodes: usize,
    pub(super) frames: usize,
    /// Keeps others from writing the folder; `None` where folders cannot be locked.
    pub(super) _lock: Option<File>,
}

/// Keeps others from writing a folder, also under the name that it gets later, for as long as the file is open. `None` where
/// folders cannot be locked, as on Windows and on some network file systems.
///
/// # Errors
/// Another process writes it.
pub(super) fn lock(folder: &Path) -> Result<Option<File>, TraceError> {
    let Ok(file) = File::open(folder) else { return Ok(None) };
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Err(TraceError::new(
            folder,
            "",
            "another session is writing this dataset: end it, or choose another folder",
        )),
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// Makes the folder of an unfinished dataset, locked and without the files of a process that was killed.
///
/// # Errors
/// Another process writes it, or may write it; it cannot be made.
fn begin(folder: &Path) -> Result<Option<File>, TraceError> {
    let io = |e: std::io::Error| TraceError::new(folder, "", e);
    std::fs::create_dir_all(folder).map_err(io)?;
    // The lock comes first: it tells a process that was killed from one that is writing.
    let lock = lock(folder)?;
    for entry in std::fs::read_dir(folder).map_err(io)? {
        let path = entry.map_err(io)?.path();
        if lock.is_none() {
            let message = "an unfinished dataset, which another session may be writing, since this file system has no locks: \
                delete the folder if none is";
            return Err(TraceError::new(folder, "", message));
        }
        if path.is_dir() { std::fs::remove_dir_all(&path) } else { std::fs::remove_file(&path) }
            .map_err(io)?;
    }
    std::fs::create_dir(folder.join("meta")).map_err(io)?;
    Ok(lock)
}

/// A feature of an episode, ready for the files.
struct Part {
    /// Nothing for videos.
    column: Option<Column>,
    stats: Stats,
}

impl LeRobotWriter {
    /// Begins a dataset that will be at `root`.
    ///
    /// # Errors
    /// The folder exists, or cannot be written, or another process writes it; the number of frames a second is not positive.
    pub fn create(root: &Path, settings: Settings) -> Result<Self, TraceError> {
        let fail = |message: &str| TraceError::new(root, "", message);
        if root.exists() {
            return Err(fail("the folder exists: delete it, or choose another one"));
        }
        if !(settings.frames_per_second > 0.0 && settings.frames_per_second.is_finite()) {
            return Err(fail("frames a second must be a positive number"));
        }
        let Some(name) = root.file_name() else { return Err(fail("the path has no folder name")) };
        let folder = root.with_file_name(format!(".{}.unfinished", name.to_string_lossy()));
        let _lock = begin(&folder)?;
        Ok(LeRobotWriter {
            root: root.to_owned(),
            data: Series::new(folder.join("data"), 0),
            table: Series::new(folder.join("meta/episodes"), 0),
            grows: false,
            folder,
            settings,
            features: Vec::new(),
            tasks: Vec::new(),
            stats: Vec::new(),
            episodes: 0,
            frames: 0,
            _lock,
        })
    }

    /// Number of added episodes.
    pub fn episodes(&self) -> usize {
        self.episodes
    }

    /// Adds an episode.
    ///
    /// # Errors
    /// It has no frames, its features differ from the first episode's, or writing fails.
    pub fn add(&mut self, frames: &Frames) -> Result<(), TraceError> {
        let count = self.check(frames)?;
        if self.episodes == 0 {
            self.features = frames.forms(self.settings.pictures);
        }
        let (mut columns, mut described) = (Vec::new(), Vec::new());
        for feature in &self.features {
            let given = frames.features.iter().find(|(name, _)| *name == feature.name);
            let Some((_, array)) = given else { continue };
            let part = self.part(feature, array)?;
            columns.extend(part.column);
            described.push((feature.name.clone(), part.stats));
        }
        let task = self.task(&frames.task);
        for (column, stats) in self.numbering(count, task) {
            described.push((column.name.clone(), stats));
            columns.push(column);
        }
        let mut row = Vec::new();
        for (name, stats) in described {
            note(&mut self.stats, &name, &stats);
            row.extend(stats.columns(&name));
        }
        let written = self.write(columns, row, &frames.task, count);
        written.map_err(|e| self.fail("", e))?;
        self.episodes += 1;
        self.frames += count;
        if self.grows { self.publish() } else { Ok(()) }
    }

    /// Checks that an episode fits the dataset, and returns its number of frames. Writes nothing.
    ///
    /// # Errors
    /// It has no frames, or its features differ from the first episode's.
    pub fn check(&self, frames: &Frames) -> Result<usize, TraceError> {
        let count = frames.count().map_err(|(feature, message)| self.fail(&feature, message))?;
        if self.episodes > 0 {
            self.compare(&frames.forms(self.settings.pictures))?;
        }
        Ok(count)
    }

    /// Completes the dataset and gives it its name; one that grows is complete.
    ///
    /// # Errors
    /// It has no episodes, or writing fails.
    pub fn finish(mut self) -> Result<(), TraceError> {
        match (self.grows, self.episodes) {
            (true, _) => Ok(()),
            (false, 0) => Err(self.fail("", "a dataset needs at least one episode")),
            (false, _) => self.publish(),
        }
    }

    /// Completes all files; what counts the episodes comes last. Then the dataset has its name.
    fn publish(&mut self) -> Result<(), TraceError> {
        let completed = self.data.complete().and_then(|()| self.table.complete());
        completed.and_then(|()| self.write_tasks()).map_err(|e| self.fail("", e))?;
        let stats: Map<String, Value> =
            self.stats.iter().map(|(name, stats)| (name.clone(), stats.to_json())).collect();
        json::write(&self.folder.join("meta/stats.json"), &Value::Object(stats))?;
        json::write(&self.folder.join("meta/info.json"), &self.info())?;
        if self.folder != self.root {
            std::fs::rename(&self.folder, &self.root).map_err(|e| self.fail("", e))?;
            self.folder.clone_from(&self.root);
        }
        self.data = Series::new(self.folder.join("data"), self.data.number() + 1);
        self.table = Series::new(self.folder.join("meta/episodes"), self.table.number() + 1);
        Ok(())
    }

    pub(super) fn fail(&self, feature: &str, message: impl ToString) -> TraceError {
        let episode = format!("episode {}", self.episodes);
        let object = if feature.is_empty() { episode } else { format!("{episode}, {feature}") };
        TraceError::new(&self.root, object, message.to_string())
    }

    fn compare(&self, forms: &[Feature]) -> Result<(), TraceError> {
        for form in forms {
            let Some(first) = self.features.iter().find(|feature| feature.name == form.name) else {
                return Err(self.fail(&form.name, "the first episode does not have it"));
            };
            if first != form {
                let describe = |f: &Feature| format!("{} of shape {:?}", f.kind.name(), f.shape);
                let message = format!("{}, {} in the first episode", describe(form), describe(first));
                return Err(self.fail(&form.name, message));
            }
        }
        let lacking = |feature: &&Feature| forms.iter().all(|form| form.name != feature.name);
        match self.features.iter().find(lacking) {
            Some(feature) => Err(self.fail(&feature.name, "missing, but the first episode has it")),
            None => Ok(()),
        }
    }

    /// A feature's column and statistics; a video is written.
    fn part(&self, feature: &Feature, array: &Array) -> Result<Part, TraceError> {
        let (dataset::Values::U8(rgb), true) = (&array.values, feature.kind.is_picture()) else {
            let (column, stats) = numbers(feature, array);
            return Ok(Part { column: Some(column), stats });
        };
        let stats = Stats::of_pictures(rgb, array.rows());
        let size = (feature.shape[1] as u32, feature.shape[0] as u32);
        let pictures = rgb.chunks_exact(feature.shape.iter().product());
        let pictures = pictures.map(|rgb| Frame::new(size.0, size.1, rgb));
        if feature.kind == FeatureKind::Video {
            self.write_video(feature, size, pictures).map_err(|e| self.fail(&feature.name, e))?;
            return Ok(Part { column: None, stats });
        }
        let files: Result<Vec<_>, _> = pictures.map(|picture| picture.map(|p| png_bytes(&p))).collect();
        let cells = Cells::Png(files.map_err(|e| self.fail(&feature.name, e))?);
        Ok(Part { column: Some(Column::scalars(&feature.name, cells)), stats })
    }

    fn write_video<'a>(
        &self,
        feature: &Feature,
        size: (u32, u32),
        pictures: impl Iterator<Item = Result<Frame<'a>, video::VideoError>>,
    ) -> Result<(), String> {
        if size.0 % 2 + size.1 % 2 != 0 {
            return Err(format!(
                "{} x {} pixels: the sides of videos must be even; store the pictures as PNG",
                size.0, size.1
            ));
        }
        let folder = self.folder.join("videos").join(&feature.name);
        let path = folder.join(file_name(self.episodes)).with_extension("mp4");
        path.parent().map_or(Ok(()), std::fs::create_dir_all).map_err(|e| e.to_string())?;
        let text = |e: video::VideoError| e.to_string();
        let mut video = VideoWriter::create(&path, size, self.settings.frames_per_second).map_err(text)?;
        for picture in pictures {
            video.push(&picture.map_err(text)?).map_err(text)?;
        }
        video.finish().map_err(text)
    }

    /// The number of a task.
    fn task(&mut self, task: &str) -> usize {
        self.tasks.iter().position(|known| known == task).unwrap_or_else(|| {
            self.tasks.push(task.to_owned());
            self.tasks.len() - 1
        })
    }

    /// The columns that number the frames of this episode.
    fn numbering(&self, count: usize, task: usize) -> Vec<(Column, Stats)> {
        let column = |(name, _): &(&str, FeatureKind)| {
            let values: Vec<f64> = match *name {
                "timestamp" => (0..count).map(|i| i as f64 / self.settings.frames_per_second).collect(),
                "frame_index" => (0..count).map(|i| i as f64).collect(),
                "episode_index" => vec![self.episodes as f64; count],
                "index" => (self.frames..self.frames + count).map(|i| i as f64).collect(),
                _ => vec![task as f64; count],
            };
            let stats = Stats::of_rows(&values, &[1]);
            let cells = match *name {
                "timestamp" => Cells::F32(values.into_iter().map(|x| x as f32).collect()),
                _ => Cells::I64(values.into_iter().map(|x| x as i64).collect()),
            };
            (Column::scalars(name, cells), stats)
        };
        NUMBERING.iter().map(column).collect()
    }

    /// Adds the frames, and the row of the episode.
    fn write(
        &mut self,
        columns: Vec<Column>,
        stats: Vec<Column>,
        task: &str,
        count: usize,
    ) -> parquet::errors::Result<()> {
        let (chunk, file) = place(self.data.next_file()?);
        self.data.add(columns)?;
        let (own_chunk, own_file) = place(self.table.next_file()?);
        let integer = |name: &str, value: usize| Column::scalars(name, Cells::I64(vec![value as i64]));
        let mut row = vec![
            integer("episode_index", self.episodes),
            Column { name: "tasks".into(), row: vec![1], cells: Cells::Text(vec![task.to_owned()]) },
            integer("length", count),
            integer("data/chunk_index", chunk),
            integer("data/file_index", file),
            integer("dataset_from_index", self.frames),
            integer("dataset_to_index", self.frames + count),
            integer("meta/episodes/chunk_index", own_chunk),
            integer("meta/episodes/file_index", own_file),
        ];
        for feature in self.features.iter().filter(|feature| feature.kind == FeatureKind::Video) {
            let (chunk, file) = place(self.episodes);
            let key = |part: &str| format!("videos/{}/{part}", feature.name);
            let seconds = |part: &str, value| Column::scalars(&key(part), Cells::F64(vec![value]));
            row.push(integer(&key("chunk_index"), chunk));
            row.push(integer(&key("file_index"), file));
            row.push(seconds("from_timestamp", 0.0));
            row.push(seconds("to_timestamp", count as f64 / self.settings.frames_per_second));
        }
        row.extend(stats);
        self.table.add(row)
    }

    /// The table of tasks, whose texts pandas takes for the names of its rows.
    fn write_tasks(&self) -> parquet::errors::Result<()> {
        let columns = [
            Column::scalars("task_index", Cells::I64((0..self.tasks.len() as i64).collect())),
            Column::scalars("__index_level_0__", Cells::Text(self.tasks.clone())),
        ];
        let described = |name: Value, field: &str, pandas: &str, numpy: &str| json!({ "name": name, "field_name": field, "pandas_type": pandas, "numpy_type": numpy, "metadata": null });
        let pandas = json!({
            "index_columns": ["__index_level_0__"],
            "column_indexes": [],
            "columns": [
                described("task_index".into(), "task_index", "int64", "int64"),
                described(Value::Null, "__index_level_0__", "unicode", "object"),
            ],
            "creator": { "library": "robohive", "version": env!("CARGO_PKG_VERSION") },
            "pandas_version": "2.0.0",
        });
        let path = self.folder.join("meta/tasks.parquet");
        let mut table = Table::create(&path, &columns, &[("pandas", pandas.to_string())])?;
        table.write(&columns)?;
        table.close()
    }

    fn info(&self) -> Value {
        let rate = self.settings.frames_per_second;
        let fps: Value = if rate.fract() == 0.0 { (rate as u64).into() } else { rate.into() };
        let numbering = NUMBERING.map(|(name, kind)| Feature { name: name.into(), kind, shape: vec![1] });
        let features: Map<String, Value> = self
            .features
            .iter()
            .chain(&numbering)
            .map(|feature| (feature.name.clone(), feature.to_json(&fps)))
            .collect();
        let videos = self.features.iter().any(|feature| feature.kind == FeatureKind::Video);
        json!({
            "codebase_version": "v3.0",
            "robot_type": self.settings.robot,
            "total_episodes": self.episodes,
            "total_frames": self.frames,
            "total_tasks": self.tasks.len(),
            "chunks_size": CHUNK_FILES,
            "data_files_size_in_mb": FILE_MEGABYTES,
            "video_files_size_in_mb": 200,
            "fps": fps,
            "splits": { "train": format!("0:{}", self.episodes) },
            "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
            "video_path": videos.then_some("videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"),
            "features": features,
        })
    }
}

impl Drop for LeRobotWriter {
    fn drop(&mut self) {
        if self.folder != self.root {
            _ = std::fs::remove_dir_all(&self.folder);
        }
    }
}

/// Takes in the statistics of a feature of an episode.
fn note(stats: &mut Vec<(String, Stats)>, name: &str, new: &Stats) {
    match stats.iter_mut().find(|(known, _)| known == name) {
        Some((_, stats)) => stats.merge(new),
        None => stats.push((name.to_owned(), new.clone())),
    }
}
