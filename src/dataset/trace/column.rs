//! Rows of one name of a trial, on their way to the file.

use crate::hdf5::append::Appender;
use crate::hdf5::encode::{self, Element, Stored};
use crate::hdf5::filter::Packer;
use crate::npy::Dtype;
use std::io::Result;

/// Bytes of a chunk, unless a single row has more.
const CHUNK: usize = 1 << 16;

/// Rows of one name: whole chunks are in the file, the rest is in memory.
pub struct Column {
    /// Name inside of the trial.
    pub key: String,
    /// Type in which scalars are kept.
    pub dtype: Dtype,
    /// Shape of a row.
    pub row: Vec<usize>,
    /// Rows so far.
    pub rows: usize,
    /// Bytes that are in no chunk yet.
    held: Vec<u8>,
    chunk_rows: usize,
    chunks: Vec<Stored>,
}

impl Column {
    /// One without rows.
    pub fn new(key: String, dtype: Dtype, row: Vec<usize>) -> Self {
        let bytes = dtype.bytes() * row.iter().product::<usize>();
        let chunk_rows = (CHUNK / bytes.max(1)).max(1);
        Column { key, dtype, row, rows: 0, held: Vec::new(), chunk_rows, chunks: Vec::new() }
    }

    /// Bytes of a row.
    pub fn row_bytes(&self) -> usize {
        self.dtype.bytes() * self.row.iter().product::<usize>()
    }

    /// Adds whole rows, in memory.
    pub fn hold(&mut self, rows: usize, bytes: &[u8]) {
        self.held.extend_from_slice(bytes);
        self.rows += rows;
    }

    /// Writes the chunks that are complete.
    ///
    /// # Errors
    /// Writing fails.
    pub fn flush(&mut self, out: &mut Appender, packer: &mut Packer) -> Result<()> {
        let chunk = self.chunk_rows * self.row_bytes();
        if self.held.len() < chunk || chunk == 0 {
            return Ok(());
        }
        let whole = self.held.len() / chunk * chunk;
        for bytes in self.held[..whole].chunks_exact(chunk) {
            self.chunks.push(store(bytes, self.dtype, out, packer)?);
        }
        self.held.drain(..whole);
        Ok(())
    }

    /// Writes the rest and the header of the dataset, whose address is returned.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(mut self, out: &mut Appender, packer: &mut Packer) -> Result<u64> {
        let shape = [&[self.rows], &self.row[..]].concat();
        if self.chunks.is_empty() && self.held.is_empty() {
            return out.write(&encode::whole_dataset(Element::Number(self.dtype), &shape, 0));
        }
        if self.chunks.is_empty() {
            // A single chunk is as long as the dataset.
            self.chunk_rows = self.rows;
        }
        if !self.held.is_empty() {
            self.held.resize(self.chunk_rows * self.row_bytes(), 0);
            self.chunks.push(store(&self.held, self.dtype, out, packer)?);
        }
        let (bytes, start) =
            encode::chunked_dataset(self.dtype, &shape, self.chunk_rows, &self.chunks, out.end());
        Ok(out.write(&bytes)? + start as u64)
    }

    /// All bytes, where no chunk was written.
    pub fn into_bytes(self) -> Vec<u8> {
        self.held
    }
}

fn store(bytes: &[u8], dtype: Dtype, out: &mut Appender, packer: &mut Packer) -> Result<Stored> {
    let packed = packer.pack(bytes, dtype.bytes())?;
    Ok(Stored { address: out.write(packed)?, bytes: packed.len() as u64 })
}
