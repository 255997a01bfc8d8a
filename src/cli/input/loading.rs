//! From the arguments to a model, and to the data it starts from.

use crate::failure::Failure;
use crate::input::source::Reading;
use crate::terminal::{listed, note};
use mjcf::diagnostic::Diagnostics;
use mjcf::files::{Disk, FileError, FileProvider, Stamp};
use physics::model::ObjType;
use physics::{Data, Model};
use std::io::{Cursor, IsTerminal, Read};
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// Stands for standard input where a model is asked for.
pub const STANDARD_INPUT: &str = "-";

/// How messages call the model that is read from standard input.
const LABEL: &str = "<stdin>";

/// Most bytes that are read from standard input: as many as from a file.
const MAX_BYTES: u64 = 1 << 30;

/// Most keyframes that a message lists.
const MAX_LISTED: usize = 12;

/// Loads a model and shows its warnings on standard error.
pub fn load(path: &Path, reading: &Reading) -> Result<Model, Failure> {
    let (loader, path) = loader(path, reading)?;
    let loaded = loader.load(path).map_err(Failure::usage)?;
    loaded.warnings.warnings().for_each(|warning| note(&warning.to_string()));
    Ok(loaded.model)
}

/// What reads the model at `path` as the arguments say, and how it calls that path.
pub fn loader<'a>(path: &'a Path, reading: &Reading) -> Result<(mjcf::Loader, &'a Path), Failure> {
    let memory = usize::try_from(u64::from(reading.memory) << 20).unwrap_or(usize::MAX);
    let mut loader = mjcf::Loader::default().limits(mjcf::Limits::default().with_memory(memory));
    let named = std::env::var_os("ROBOHIVE_CACHE").filter(|folder| !folder.is_empty());
    if let Some(folder) = reading.cache.clone().or(named.map(Into::into)) {
        loader = loader.cache(mjcf::Cache::new(folder));
    }
    for define in &reading.defines {
        let (text, value) = define
            .split_once('=')
            .filter(|(text, _)| !text.is_empty())
            .ok_or_else(|| Failure::usage(format!("--define {define:?} is not TEXT=VALUE")))?;
        loader = loader.define(text, value);
    }
    if path == Path::new(STANDARD_INPUT) {
        return Ok((loader.files(DiskAndInput::new()?), Path::new(LABEL)));
    }
    match own(path) {
        Some(own) => Ok((loader.files(::assets::Own), own)),
        None => Ok((loader, path)),
    }
}

/// The place among our own models of a path such as `hive/panda/scene.xml`, where there is such a model.
pub fn own(path: &Path) -> Option<&Path> {
    let own = path.strip_prefix("hive").ok()?;
    ::assets::text(own.to_str()?).map(|_| own)
}

/// The whole disk, and standard input as a file in the working folder.
struct DiskAndInput {
    disk: Disk,
    input: Arc<[u8]>,
}

impl DiskAndInput {
    /// Reads all of standard input; a second model may ask for the same.
    fn new() -> Result<Self, Failure> {
        static INPUT: OnceLock<Arc<[u8]>> = OnceLock::new();
        if INPUT.get().is_none() {
            let stdin = std::io::stdin();
            if stdin.is_terminal() {
                note("robohive: reads a model from standard input; end it with Ctrl-D");
            }
            let mut bytes = Vec::new();
            let read = stdin.lock().take(MAX_BYTES + 1).read_to_end(&mut bytes);
            read.map_err(|e| Failure::usage(format!("standard input: {e}")))?;
            if bytes.len() as u64 > MAX_BYTES {
                return Err(Failure::usage(format!("standard input: more than {MAX_BYTES} bytes")));
            }
            _ = INPUT.set(bytes.into());
        }
        Ok(DiskAndInput { disk: Disk::everywhere(), input: INPUT.get().cloned().unwrap_or_default() })
    }
}

impl FileProvider for DiskAndInput {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        if path == LABEL { Ok(self.input.clone()) } else { self.disk.read(path) }
    }

    fn open(&self, path: &str) -> Result<(Box<dyn Read>, u64), FileError> {
        match path {
            LABEL => Ok((Box::new(Cursor::new(self.input.clone())), self.input.len() as u64)),
            _ => self.disk.open(path),
        }
    }

    fn exists(&self, path: &str) -> bool {
        path == LABEL || self.disk.exists(path)
    }

    fn stamp(&self, path: &str) -> Option<Stamp> {
        if path == LABEL { None } else { self.disk.stamp(path) }
    }
}

/// Data of `m` at keyframe `key`; without one, at keyframe 0 when the model has keyframes, else at `qpos0`.
pub fn start(m: &Model, key: Option<&str>) -> Result<Data, Failure> {
    let mut d = Data::new(m);
    let index = match key {
        None if m.nkey == 0 => return Ok(d),
        None => 0,
        Some(key) => match m.id_of(ObjType::Key, key).or_else(|| key.parse().ok()) {
            Some(index) if index < m.nkey => index,
            _ => return Err(unknown_keyframe(m, key)),
        },
    };
    d.reset_to_key(m, index).map_err(Failure::usage)?;
    Ok(d)
}

fn unknown_keyframe(m: &Model, key: &str) -> Failure {
    let names: Vec<&str> =
        (0..m.nkey).map(|k| m.name_of(ObjType::Key, k)).filter(|name| !name.is_empty()).collect();
    let mut text = format!("the model has no keyframe {key:?}");
    if let Some(name) = Diagnostics::default().nearest(key, names.iter().copied()) {
        text += &format!("; did you mean {name:?}?");
    }
    text += &match (m.nkey, names.len()) {
        (0, _) => "; it has no keyframes".to_owned(),
        (n, 0) => format!("; its keyframes are numbered 0 to {}, without names", n - 1),
        (n, _) => format!("; its keyframes, 0 to {}, include {}", n - 1, listed(names, MAX_LISTED)),
    };
    Failure::usage(text)
}
