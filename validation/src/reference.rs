//! Recorded MuJoCo runs (`reference/record.py`), read back as a `Model`, states and expected outputs.

use dataset::{Array, NpzError, NpzReader};
use physics::model::Arrays;
use physics::plugin::Registry;
use physics::{Data, Model};
use std::fmt;
use std::path::{Path, PathBuf};

/// A recorded model: compiled arrays, forward passes of independent states, a rollout and its twin.
pub struct Reference {
    archive: NpzReader,
}

/// Why a reference cannot be used.
#[derive(Debug)]
pub enum ReferenceError {
    /// The archive is damaged or lacks an array.
    Archive(NpzError),
    /// An array does not fit the model.
    Shape(String),
    /// A plugin of the model cannot be started.
    Plugin(String),
}

impl fmt::Display for ReferenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ReferenceError::Archive(error) => error.fmt(f),
            ReferenceError::Shape(name) => write!(f, "array {name:?} does not fit the model"),
            ReferenceError::Plugin(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for ReferenceError {}

impl From<NpzError> for ReferenceError {
    fn from(error: NpzError) -> Self {
        ReferenceError::Archive(error)
    }
}

impl Reference {
    /// Reads an archive written by `record.py`.
    ///
    /// # Errors
    /// The file is missing or no archive.
    pub fn open(path: &Path) -> Result<Self, ReferenceError> {
        Ok(Self::new(NpzReader::open(path)?))
    }

    /// An archive already read.
    pub fn new(archive: NpzReader) -> Self {
        Reference { archive }
    }

    /// The archive itself.
    pub fn archive(&self) -> &NpzReader {
        &self.archive
    }

    /// The model as MuJoCo compiled it.
    ///
    /// # Errors
    /// An array is missing or of the wrong size.
    pub fn model(&self) -> Result<Model, ReferenceError> {
        let mut m = Arrays::default();
        for name in self.archive.names() {
            if let Some(size) = name.strip_prefix("size.") {
                let value = self.archive.require(name)?.values.to_f64()[0];
                match size {
                    "flg_gravcomp" => m.flg_gravcomp = value != 0.0,
                    "flg_surfacevel" => m.flg_surfacevel = value != 0.0,
                    "flg_adhesion" => m.flg_adhesion = value != 0.0,
                    _ => _ = m.set_size(size, value as usize),
                }
            }
        }
        m.allocate();
        // Arrays of features that are not simulated (flex, skin) are recorded too; `Model` lacks them.
        let mut arrays = Vec::new();
        m.visit(&mut |name, _, _| arrays.push(name));
        for name in self.archive.names() {
            let Some((group, field)) = name.split_once('.') else { continue };
            if !(matches!(group, "opt" | "stat") || group == "model" && arrays.contains(&field)) {
                continue;
            }
            let values = self.archive.require(name)?.values.to_f64();
            let fits = match group {
                "model" => m.assign(field, &values),
                "opt" => m.opt.assign(field, &values),
                _ => m.stat.assign(field, &values),
            };
            if fits == Some(false) {
                return Err(ReferenceError::Shape(name.to_owned()));
            }
        }
        let mut m = Model::unchecked(m);
        m.start_plugins(&Registry::default()).map_err(|e| ReferenceError::Plugin(e.to_string()))?;
        Ok(m)
    }

    /// A size of the recorded model.
    ///
    /// # Errors
    /// The archive does not tell it.
    pub fn size(&self, name: &str) -> Result<usize, ReferenceError> {
        let name = format!("size.{name}");
        let value = self.archive.require(&name)?.values.to_f64();
        value.first().map(|&n| n as usize).ok_or(ReferenceError::Shape(name))
    }

    /// An array with `width` numbers in each of its rows, flat, and the number of rows.
    ///
    /// # Errors
    /// The array is missing, or its rows are not of that width.
    pub fn rows(&self, name: &str, width: usize) -> Result<(Vec<f64>, usize), ReferenceError> {
        let array = self.archive.require(name)?;
        let (values, rows) = (array.values.to_f64(), array.rows());
        if rows.checked_mul(width) == Some(values.len()) {
            Ok((values, rows))
        } else {
            Err(ReferenceError::Shape(name.to_owned()))
        }
    }

    /// Number of recorded independent states.
    ///
    /// # Errors
    /// The archive has no states.
    pub fn states(&self) -> Result<usize, ReferenceError> {
        Ok(self.archive.require("state.time")?.rows())
    }

    /// Sets the state and inputs of `d` to recorded row `row`.
    ///
    /// # Errors
    /// An array is missing or of the wrong size.
    pub fn set_state(&self, d: &mut Data, m: &Model, row: usize) -> Result<(), ReferenceError> {
        d.reset(m);
        for name in self.archive.names().filter_map(|n| n.strip_prefix("state.")) {
            let values = self.state_row("state", name, row)?;
            if d.assign(name, &values) == Some(false) {
                return Err(ReferenceError::Shape(format!("state.{name}")));
            }
        }
        Ok(())
    }

    /// Number of rows of an array.
    ///
    /// # Errors
    /// The array is missing.
    pub fn row_count(&self, name: &str) -> Result<usize, ReferenceError> {
        Ok(self.archive.require(name)?.rows())
    }

    /// Row `row` of a stacked array `group.name`.
    ///
    /// # Errors
    /// The array is missing or has no such row.
    pub fn state_row(&self, group: &str, name: &str, row: usize) -> Result<Vec<f64>, ReferenceError> {
        let array = self.archive.require(&format!("{group}.{name}"))?;
        row_of(&array, row..row + 1).ok_or_else(|| ReferenceError::Shape(format!("{group}.{name}")))
    }

    /// Forward output `name` of state `row`: fixed-size, or cut out of a concatenation by `ncon` or `nefc`.
    ///
    /// # Errors
    /// The array is missing or has no such row.
    pub fn forward(&self, name: &str, row: usize) -> Result<Vec<f64>, ReferenceError> {
        let counter = match name {
            _ if name.starts_with("contact.") => "ncon",
            _ if name.starts_with("efc_") => "nefc",
            _ => return self.state_row("forward", name, row),
        };
        let misfit = || ReferenceError::Shape(format!("forward.{name}"));
        let counts = self.archive.require(&format!("forward.{counter}"))?.values.to_f64();
        let count = *counts.get(row).ok_or_else(misfit)?;
        let start: f64 = counts[..row].iter().sum();
        let array = self.archive.require(&format!("forward.{name}"))?;
        row_of(&array, start as usize..(start + count) as usize).ok_or_else(misfit)
    }

    /// Injects the listed forward outputs of state `row` into `d`, contacts and rows included.
    ///
    /// # Errors
    /// An array is missing or of the wrong size.
    pub fn inject(&self, d: &mut Data, names: &[&str], row: usize) -> Result<(), ReferenceError> {
        if names.iter().any(|n| n.starts_with("contact.")) {
            d.con.contact.clear();
        }
        for name in names {
            let values = self.forward(name, row)?;
            if d.assign(name, &values) != Some(true) {
                return Err(ReferenceError::Shape(format!("forward.{name}")));
            }
        }
        Ok(())
    }
}

/// Recorded models: this repository's, and those in the folder that `ROBOHIVE_REFERENCES` names.
///
/// # Errors
/// A folder cannot be read, or holds what is no archive.
pub fn recorded() -> Result<Vec<(PathBuf, Reference)>, Box<dyn std::error::Error>> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/own");
    let other = std::env::var_os("ROBOHIVE_REFERENCES").map(PathBuf::from);
    let mut paths = Vec::new();
    for folder in std::iter::once(own).chain(other) {
        for file in std::fs::read_dir(folder)? {
            paths.push(file?.path());
        }
    }
    paths.sort();
    paths.into_iter().map(|path| Ok((path.clone(), Reference::open(&path)?))).collect()
}

/// True for a reference of this repository.
pub fn is_own(path: &Path) -> bool {
    path.parent().is_some_and(|folder| folder.ends_with("reference/own"))
}

/// A model of our own.
pub struct Own {
    /// Its name.
    pub name: &'static str,
    /// As we compile it.
    pub model: Model,
    /// What MuJoCo made of it.
    pub reference: Reference,
}

/// Every own model, in the order of their names.
///
/// # Errors
/// A model cannot be read, or has no reference.
pub fn own_models() -> Result<Vec<Own>, Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/own");
    let mut models: Vec<_> = assets::models().collect();
    models.sort_unstable();
    let with_reference = |(name, path)| {
        let file = folder.join(format!("{name}.npz"));
        let reference = Reference::open(&file).map_err(|e| format!("{}: {e}", file.display()))?;
        let model = mjcf::Loader::default().files(assets::Own).load(path)?.model;
        Ok(Own { name, model, reference })
    };
    models.into_iter().map(with_reference).collect()
}

/// Rows of a stacked array, flat.
fn row_of(array: &Array, rows: std::ops::Range<usize>) -> Option<Vec<f64>> {
    let width = array.shape.iter().skip(1).product();
    let values = array.values.to_f64();
    values.get(rows.start.checked_mul(width)?..rows.end.checked_mul(width)?).map(<[f64]>::to_vec)
}
