//! An episode in memory, until it is over and a file takes it.

use crate::SEED;
use crate::error::RecordError;
use crate::row::{Sink, push_row, set_drawn};
use dataset::trace::{TraceError, Trial};
use dataset::{Array, Dtype, Scalar, Values};
use env::Env;
use std::collections::BTreeMap;
use std::path::Path;

/// Rows of an episode, without images, as they will stand in a recording.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    seed: u64,
    rows: usize,
    columns: BTreeMap<String, Column>,
    whole: Vec<(String, Array)>,
}

#[derive(Clone, Debug)]
struct Column {
    dtype: Dtype,
    shape: Vec<usize>,
    rows: usize,
    bytes: Vec<u8>,
}

impl Kept {
    /// An episode that starts from the reset with `seed`.
    pub fn new(seed: u64) -> Self {
        Kept { seed, ..Kept::default() }
    }

    /// Seed of its reset.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Adds the row of the current state and of the action that is taken in it; in the last state of an episode, a NaN
    /// action.
    ///
    /// # Errors
    /// The environment's rows changed their shape.
    pub fn row(&mut self, env: &Env, action: &[f64]) -> Result<(), RecordError> {
        if self.rows == 0 {
            set_drawn(self, env)?;
        }
        self.rows += 1;
        Ok(push_row(self, env, action)?)
    }

    /// Adds a boolean to the last added row.
    ///
    /// # Errors
    /// The name has rows of another kind.
    pub fn flag(&mut self, key: &str, flag: bool) -> Result<(), RecordError> {
        Ok(self.push(key, &[], &[flag])?)
    }

    /// Forgets all rows but the first few, as if the episode had not gone further.
    pub fn truncate(&mut self, rows: usize) {
        for column in self.columns.values_mut() {
            // Every row of an episode has the same columns.
            let row = column.bytes.len().checked_div(column.rows).unwrap_or(0);
            column.rows = column.rows.min(rows);
            column.bytes.truncate(column.rows * row);
        }
        self.rows = self.rows.min(rows);
        if self.rows == 0 {
            // The first row brings what was drawn.
            self.whole.clear();
        }
    }

    /// Adds a number about the whole episode, which takes the place of a former one of that name.
    pub fn note(&mut self, key: &str, number: u8) {
        self.whole.retain(|(known, _)| known != key);
        self.whole.push((key.to_owned(), Array { shape: Vec::new(), values: Values::U8(vec![number]) }));
    }

    /// All that a trial of it would hold: names, and arrays whose first axis counts rows, or numbers about the whole episode.
    pub fn arrays(&self) -> Vec<(String, Array)> {
        let seed = (SEED.to_owned(), Array { shape: Vec::new(), values: Values::U64(vec![self.seed]) });
        let columns = self.columns.iter().map(|(key, column)| (key.clone(), column.array()));
        columns.chain(self.whole.iter().cloned()).chain([seed]).collect()
    }

    /// Hands all rows to a trial.
    pub(crate) fn write(&self, trial: &mut Trial<'_>) -> Result<(), TraceError> {
        for (key, array) in &self.whole {
            trial.set(key, array)?;
        }
        for (key, column) in &self.columns {
            trial.push_rows(key, &column.array())?;
        }
        Ok(())
    }
}

impl Column {
    fn array(&self) -> Array {
        let shape = [&[self.rows][..], &self.shape].concat();
        Array { shape, values: Values::from_bytes(self.dtype, &self.bytes) }
    }
}

impl Sink for Kept {
    fn push<T: Scalar>(&mut self, key: &str, shape: &[usize], row: &[T]) -> Result<(), TraceError> {
        let column = self.columns.entry(key.to_owned()).or_insert_with(|| Column {
            dtype: T::DTYPE,
            shape: shape.to_vec(),
            rows: 0,
            bytes: Vec::new(),
        });
        if column.dtype != T::DTYPE || column.shape != shape {
            let message = format!("a row of shape {shape:?} after rows of shape {:?}", column.shape);
            return Err(TraceError::new(Path::new(""), key, message));
        }
        column.rows += 1;
        row.iter().for_each(|&scalar| scalar.put(&mut column.bytes));
        Ok(())
    }

    fn set(&mut self, key: &str, array: &Array) -> Result<(), TraceError> {
        self.whole.push((key.to_owned(), array.clone()));
        Ok(())
    }
}
