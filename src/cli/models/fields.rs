//! Fields by name: from `Data` into arrays shaped as MuJoCo's Python bindings shape them.

use crate::failure::{Failure, unwritable};
use crate::terminal::listed;
use dataset::growing::ColumnId;
use dataset::{Array, Dtype, GrowingNpz, Values};
use mjcf::diagnostic::Diagnostics;
use physics::table::Slice;
use physics::{Data, Model};
use std::path::{Path, PathBuf};

/// Copies reflected scalars into an array.
pub fn array(shape: Vec<usize>, values: Slice<'_>) -> Array {
    let values = match values {
        Slice::Bool(v) => Values::Bool(v.to_vec()),
        Slice::U8(v) => Values::U8(v.to_vec()),
        Slice::I32(v) => Values::I32(v.to_vec()),
        Slice::I64(v) => Values::I64(v.to_vec()),
        Slice::F32(v) => Values::F32(v.to_vec()),
        Slice::F64(v) => Values::F64(v.to_vec()),
    };
    Array { shape, values }
}

fn dtype(values: Slice<'_>) -> Dtype {
    match values {
        Slice::Bool(_) => Dtype::Bool,
        Slice::U8(_) => Dtype::U8,
        Slice::I32(_) => Dtype::I32,
        Slice::I64(_) => Dtype::I64,
        Slice::F32(_) => Dtype::F32,
        Slice::F64(_) => Dtype::F64,
    }
}

/// True for fields with one row a contact or constraint row.
pub fn is_ragged(name: &str) -> bool {
    name.starts_with("contact.") || (name.starts_with("efc_") && name != "efc_J_colind")
}

/// How a field becomes rows of an array.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    /// One row each time.
    One,
    /// As many as it has contacts or constraint rows.
    All,
    /// The constraint Jacobian, stored sparse: as many, with all columns.
    Jacobian,
}

/// Rows of the chosen fields, written step by step or state by state to an archive.
pub struct Recorder {
    out: GrowingNpz,
    path: PathBuf,
    /// Of each field, in the order in which `Data` shows them.
    columns: Vec<Option<(ColumnId, Rows)>>,
}

impl Recorder {
    /// Opens the archive at `path` for the fields `names`; every one must be a field of `Data`.
    ///
    /// # Errors
    /// No field has a name, or the archive cannot be opened.
    pub fn create(path: &Path, m: &Model, d: &Data, names: &[String]) -> Result<Self, Failure> {
        let mut known = Vec::new();
        d.visit(m, &mut |name, shape, values| known.push((name, shape, dtype(values))));
        if let Some(unknown) = names.iter().find(|name| !known.iter().any(|(k, ..)| k == name)) {
            return Err(unknown_field(unknown, &known.iter().map(|&(name, ..)| name).collect::<Vec<_>>()));
        }
        let mut out = GrowingNpz::create(path).map_err(unwritable(path))?;
        let mut columns = Vec::new();
        for (name, shape, dtype) in known {
            if !names.iter().any(|n| n == name) {
                columns.push(None);
                continue;
            }
            let (rows, row) = match name {
                "efc_J" => (Rows::Jacobian, vec![m.nv]),
                _ if is_ragged(name) => (Rows::All, shape[1..].to_vec()),
                _ => (Rows::One, shape),
            };
            columns.push(Some((out.column(name, dtype, &row).map_err(unwritable(path))?, rows)));
        }
        Ok(Recorder { out, path: path.to_owned(), columns })
    }

    /// Appends the current values of every field.
    ///
    /// # Errors
    /// Writing fails.
    pub fn record(&mut self, m: &Model, d: &Data) -> Result<(), Failure> {
        let mut columns = self.columns.iter();
        let mut written = Ok(());
        d.visit(m, &mut |_, shape, values| {
            let Some(&Some((column, rows))) = columns.next() else { return };
            if written.is_err() {
                return;
            }
            written = match rows {
                Rows::One => self.out.append(column, 1, |put| values.pieces(put)),
                Rows::All => self.out.append(column, shape[0], |put| values.pieces(put)),
                Rows::Jacobian => {
                    let dense = d.efc.dense_jacobian(m.nv);
                    self.out.append(column, d.efc.nefc, |put| Slice::F64(&dense).pieces(put))
                }
            };
        });
        written.and_then(|()| self.out.sync_if_due()).map_err(unwritable(&self.path))
    }

    /// Completes the archive: a leading axis of steps, states, contacts or rows.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> Result<(), Failure> {
        self.out.finish().map_err(unwritable(&self.path))
    }
}

fn unknown_field(name: &str, known: &[&str]) -> Failure {
    let like: Vec<_> = known.iter().filter(|k| k.contains(name) || name.contains(**k)).collect();
    let advice = match Diagnostics::default().nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean {near:?}?"),
        None if like.is_empty() => format!("the fields are {}", known.join(", ")),
        None => format!("like it are {}", listed(like, 12)),
    };
    Failure::usage(format!("no field is called {name:?}; {advice}"))
}
