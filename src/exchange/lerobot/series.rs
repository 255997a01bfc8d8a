//! Tables that are too long for one file: `chunk-000/file-000.parquet`, `file-001.parquet` …

use super::table::{Column, Table};
use parquet::errors::Result;
use std::path::PathBuf;

/// Files of a chunk.
pub const CHUNK_FILES: usize = 1000;
/// Megabytes of a file, from which on the next one is begun.
pub const FILE_MEGABYTES: usize = 100;
/// Bytes in memory from which on rows go to the file.
const ROW_GROUP: usize = 4 << 20;

/// Chunk and file of a number.
pub fn place(number: usize) -> (usize, usize) {
    (number / CHUNK_FILES, number % CHUNK_FILES)
}

/// The path of a file of a number, without its ending.
pub fn file_name(number: usize) -> String {
    let (chunk, file) = place(number);
    format!("chunk-{chunk:03}/file-{file:03}")
}

/// A table in files.
pub struct Series {
    folder: PathBuf,
    /// Number of the current file.
    number: usize,
    table: Option<Table>,
    /// Rows that are in no file yet.
    held: Vec<Column>,
}

impl Series {
    /// One whose next rows go to the file of a number.
    pub fn new(folder: PathBuf, number: usize) -> Self {
        Series { folder, number, table: None, held: Vec::new() }
    }

    /// Number of the current file.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Number of the file that the next rows go to; a full one is completed first.
    ///
    /// # Errors
    /// Writing fails.
    pub fn next_file(&mut self) -> Result<usize> {
        let written = self.table.as_ref().map_or(0, Table::bytes);
        if written + self.held_bytes() >= FILE_MEGABYTES << 20 {
            self.complete()?;
            self.number += 1;
        }
        Ok(self.number)
    }

    /// Adds rows, of the same columns every time.
    ///
    /// # Errors
    /// Writing fails.
    pub fn add(&mut self, columns: Vec<Column>) -> Result<()> {
        if self.held.is_empty() {
            self.held = columns;
        } else {
            self.held.iter_mut().zip(columns).for_each(|(held, new)| held.append(new));
        }
        if self.held_bytes() >= ROW_GROUP { self.flush() } else { Ok(()) }
    }

    /// Completes the current file.
    ///
    /// # Errors
    /// Writing fails.
    pub fn complete(&mut self) -> Result<()> {
        self.flush()?;
        self.table.take().map_or(Ok(()), Table::close)
    }

    fn held_bytes(&self) -> usize {
        self.held.iter().map(Column::bytes).sum()
    }

    fn flush(&mut self) -> Result<()> {
        if self.held.is_empty() {
            return Ok(());
        }
        let held = std::mem::take(&mut self.held);
        if self.table.is_none() {
            let path = self.folder.join(file_name(self.number)).with_extension("parquet");
            path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
            self.table = Some(Table::create(&path, &held, &[])?);
        }
        self.table.as_mut().map_or(Ok(()), |table| table.write(&held))
    }
}
