//! Numpy archives whose arrays grow row by row, in memory that does not grow with them.
//!
//! A zip file holds its members one after another, so arrays that grow together first go to files of their own:
//! `FILE.part/NAME.npy` beside the archive `FILE`. Each is a readable numpy array at all times, and holds the rows up to
//! the last [`GrowingNpz::sync`]: that is what a killed process leaves. [`GrowingNpz::finish`] puts the archive together
//! and removes them.
//!
//! ```
//! use robohive_dataset::{Dtype, GrowingNpz, NpzReader};
//!
//! let path = std::env::temp_dir().join(format!("robohive-growing-{}.npz", std::process::id()));
//! let mut archive = GrowingNpz::create(&path)?;
//! let time = archive.column("time", Dtype::F64, &[])?;
//! for step in 0..3 {
//!     archive.append(time, 1, |put| put(&f64::from(step).to_le_bytes()))?;
//! }
//! archive.finish()?;
//! assert_eq!(NpzReader::open(&path)?.require("time")?.shape, [3]);
//! # std::fs::remove_file(&path)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::npy::{Dtype, header};
use crate::npz::NpzWriter;
use std::ffi::OsString;
use std::fs::{File, TryLockError};
use std::io::{BufReader, BufWriter, Error, ErrorKind, Result, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Bytes of an array that are held back in memory at most.
const BUFFER: usize = 1 << 16;

/// Time between two moments at which arrays are brought up to date.
const PERIOD: Duration = Duration::from_secs(1);

/// An archive that is being written.
pub struct GrowingNpz {
    archive: File,
    folder: PathBuf,
    columns: Vec<Column>,
    synced: Instant,
}

/// An array of a [`GrowingNpz`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColumnId(usize);

struct Column {
    name: String,
    path: PathBuf,
    file: BufWriter<File>,
    dtype: Dtype,
    /// Rows, then the axes of a row.
    shape: Vec<usize>,
    /// Bytes of scalars so far.
    bytes: usize,
    /// Bytes of the header, whatever the number of rows grows to.
    room: usize,
}

impl GrowingNpz {
    /// Opens the archive at `path`, whose content stays until [`GrowingNpz::finish`], and its folder of arrays, emptied
    /// of what a killed process left.
    ///
    /// # Errors
    /// The file cannot be written or is not a regular one, another process is writing it, or the folder cannot be made.
    pub fn create(path: &Path) -> Result<Self> {
        let archive = File::options().read(true).write(true).create(true).truncate(false).open(path)?;
        if !archive.metadata()?.is_file() {
            return Err(Error::new(ErrorKind::InvalidInput, "an archive must be a regular file"));
        }
        match archive.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(Error::new(ErrorKind::ResourceBusy, "another process is writing this file"));
            }
            // Without locks in the file system, two processes are not kept apart.
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(error),
        }
        let mut folder = OsString::from(path);
        folder.push(".part");
        let folder = PathBuf::from(folder);
        if folder.is_dir() {
            remove_arrays(&folder)?;
        } else {
            std::fs::create_dir(&folder).map_err(|e| named(&folder, &e))?;
        }
        Ok(GrowingNpz { archive, folder, columns: Vec::new(), synced: Instant::now() })
    }

    /// The folder of the arrays, while the archive is not finished.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Adds an array without rows; `row` is the shape of one.
    ///
    /// # Errors
    /// The array's file cannot be made.
    pub fn column(&mut self, name: &str, dtype: Dtype, row: &[usize]) -> Result<ColumnId> {
        let path = self.folder.join(format!("{name}.npy"));
        let file = File::create(&path).map_err(|e| named(&path, &e))?;
        let file = BufWriter::with_capacity(BUFFER, file);
        let room = header(dtype, &[&[usize::MAX], row].concat(), 0).len();
        let shape = [&[0], row].concat();
        let mut column = Column { name: name.to_owned(), path, file, dtype, shape, bytes: 0, room };
        column.sync()?;
        self.columns.push(column);
        Ok(ColumnId(self.columns.len() - 1))
    }

    /// Appends `rows` rows to an array: `scalars` hands their bytes, little-endian, to the function it is given.
    ///
    /// # Errors
    /// Writing fails, or the bytes do not fill the rows.
    pub fn append(
        &mut self,
        column: ColumnId,
        rows: usize,
        scalars: impl FnOnce(&mut dyn FnMut(&[u8])),
    ) -> Result<()> {
        let Column { name, path, file, dtype, shape, bytes, .. } = &mut self.columns[column.0];
        let mut written = Ok(());
        let mut count = 0;
        scalars(&mut |piece| {
            count += piece.len();
            if written.is_ok() {
                written = file.write_all(piece);
            }
        });
        written.map_err(|e| named(path, &e))?;
        *bytes += count;
        shape[0] += rows;
        if *bytes == shape.iter().product::<usize>() * dtype.bytes() {
            return Ok(());
        }
        let message = format!("{count} bytes do not fill {rows} rows of array {name:?}");
        Err(Error::new(ErrorKind::InvalidData, message))
    }

    /// Brings every array's file up to date: what a killed process leaves is what was appended until here.
    ///
    /// # Errors
    /// Writing fails.
    pub fn sync(&mut self) -> Result<()> {
        self.synced = Instant::now();
        self.columns.iter_mut().try_for_each(Column::sync)
    }

    /// [`GrowingNpz::sync`], if the last one was a second ago: to be called after every row.
    ///
    /// # Errors
    /// Writing fails.
    pub fn sync_if_due(&mut self) -> Result<()> {
        if self.synced.elapsed() < PERIOD { Ok(()) } else { self.sync() }
    }

    /// Writes the archive, arrays in the order they were added, and removes their files.
    ///
    /// # Errors
    /// Reading or writing fails; the arrays' files stay.
    pub fn finish(mut self) -> Result<()> {
        self.sync()?;
        self.archive.set_len(0)?;
        let mut writer = NpzWriter::new(BufWriter::with_capacity(BUFFER, &self.archive));
        for Column { name, path, .. } in &self.columns {
            let file = File::open(path).map_err(|e| named(path, &e))?;
            writer.add_npy(name, &mut BufReader::with_capacity(BUFFER, file))?;
        }
        writer.finish()?;
        remove_arrays(&self.folder)?;
        // A folder in which somebody keeps other files stays.
        match std::fs::remove_dir(&self.folder) {
            Err(error) if error.kind() != ErrorKind::DirectoryNotEmpty => Err(named(&self.folder, &error)),
            _ => Ok(()),
        }
    }
}

impl Column {
    /// Writes what is held back, and the number of rows.
    fn sync(&mut self) -> Result<()> {
        let header = header(self.dtype, &self.shape, self.room);
        let write = |file: &mut BufWriter<File>| {
            file.seek(SeekFrom::Start(0))?;
            file.write_all(&header)?;
            file.seek(SeekFrom::End(0))?;
            Ok(())
        };
        write(&mut self.file).map_err(|e: Error| named(&self.path, &e))
    }
}

/// Removes the arrays in a folder.
fn remove_arrays(folder: &Path) -> Result<()> {
    for entry in std::fs::read_dir(folder).map_err(|e| named(folder, &e))? {
        let path = entry?.path();
        if path.extension().is_some_and(|kind| kind == "npy") {
            std::fs::remove_file(&path).map_err(|e| named(&path, &e))?;
        }
    }
    Ok(())
}

/// An error about another file than the archive, which says so.
fn named(path: &Path, error: &Error) -> Error {
    Error::new(error.kind(), format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::npy::Array;
    use crate::npz::NpzReader;

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("robohive-growing-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        folder.join(name)
    }

    fn append(out: &mut GrowingNpz, column: ColumnId, rows: usize, values: &[f64]) -> Result<()> {
        out.append(column, rows, |put| values.iter().for_each(|x| put(&x.to_le_bytes())))
    }

    fn array(path: &Path) -> Array {
        Array::decode(&std::fs::read(path).unwrap()).unwrap()
    }

    #[test]
    fn arrays_are_readable_while_they_grow_and_the_archive_holds_them_all() {
        let path = scratch("rows.npz");
        std::fs::write(&path, "before").unwrap();
        let mut out = GrowingNpz::create(&path).unwrap();
        let folder = out.folder().to_owned();
        let x = out.column("x", Dtype::F64, &[2]).unwrap();
        let empty = out.column("empty", Dtype::F64, &[0]).unwrap();
        for row in 0..20_000 {
            append(&mut out, x, 1, &[f64::from(row), 0.5]).unwrap();
            append(&mut out, empty, 1, &[]).unwrap();
            if row == 11_000 {
                out.sync().unwrap();
                assert_eq!(array(&folder.join("x.npy")).shape, [11_001, 2]);
                assert_eq!(std::fs::read(&path).unwrap(), b"before");
            }
        }
        assert!(append(&mut out, x, 1, &[1.0]).is_err());
        drop(out);
        let mut out = GrowingNpz::create(&path).unwrap();
        let y = out.column("y", Dtype::F64, &[]).unwrap();
        append(&mut out, y, 3, &[1.0, 2.0, 3.0]).unwrap();
        out.finish().unwrap();
        let archive = NpzReader::open(&path).unwrap();
        assert_eq!(archive.names().collect::<Vec<_>>(), ["y"]);
        assert_eq!(archive.require("y").unwrap(), Array::f64(vec![3], vec![1.0, 2.0, 3.0]));
        assert!(!folder.exists());
    }

    #[test]
    fn two_writers_of_one_file_are_kept_apart() {
        let path = scratch("busy.npz");
        let first = GrowingNpz::create(&path).unwrap();
        let error = GrowingNpz::create(&path).err().unwrap();
        assert_eq!(error.kind(), ErrorKind::ResourceBusy);
        first.finish().unwrap();
        assert_eq!(NpzReader::open(&path).unwrap().names().count(), 0);
    }
}
