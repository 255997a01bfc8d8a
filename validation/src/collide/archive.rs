//! Archives in a stream, and the arrays in them.

use crate::reference::ReferenceError;
use dataset::{NpzError, NpzReader};
use std::io::Read;

/// Largest archive in a stream: 1 GiB.
const LARGEST: u64 = 1 << 30;

/// The next archive, after its length in eight bytes; `None` at the end.
///
/// # Errors
/// The stream ends early or holds what is no archive.
pub fn next_archive(source: &mut impl Read) -> Result<Option<NpzReader>, NpzError> {
    let fail = |message: &str| NpzError {
        path: "stream".into(),
        member: String::new(),
        message: message.to_owned(),
    };
    let mut length = [0; 8];
    match source.read(&mut length[..1]) {
        Ok(0) => return Ok(None),
        Ok(_) => source.read_exact(&mut length[1..]).map_err(|e| fail(&e.to_string()))?,
        Err(e) => return Err(fail(&e.to_string())),
    }
    let length = u64::from_le_bytes(length);
    if length > LARGEST {
        return Err(fail("an archive of more than 1 GiB"));
    }
    let mut bytes = Vec::new();
    source.take(length).read_to_end(&mut bytes).map_err(|e| fail(&e.to_string()))?;
    NpzReader::read(std::io::Cursor::new(bytes)).map(Some)
}

/// An array as rows of `N` numbers.
pub(crate) fn rows<const N: usize>(archive: &NpzReader, name: &str) -> Result<Vec<[f64; N]>, ReferenceError> {
    let values = archive.require(name)?.values.to_f64();
    let (rows, rest) = values.as_chunks::<N>();
    if rest.is_empty() { Ok(rows.to_vec()) } else { Err(ReferenceError::Shape(name.to_owned())) }
}

/// An array of numbers.
pub(crate) fn numbers(archive: &NpzReader, name: &str) -> Result<Vec<f64>, ReferenceError> {
    Ok(archive.require(name)?.values.to_f64())
}

/// Largest difference of two rows; infinite where one is not a number.
pub(crate) fn largest(a: &[f64], b: &[f64]) -> f64 {
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, |most, e| if e.is_nan() { f64::INFINITY } else { most.max(e) })
}
