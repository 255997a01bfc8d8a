//! PyTorch tensors in pickles, with the storages in their legacy form: the bytes that `torch.save` wrote before 1.6.

use super::array::scalars;
use super::error::PickleError;
use super::graph::Pickle;
use super::value::Value;
use crate::npy::Array;

/// The integer that legacy streams begin with, in little-endian bytes.
const MAGIC: [u8; 10] = [0x6c, 0xfc, 0x9c, 0x46, 0xf9, 0x20, 0x6a, 0xa8, 0x50, 0x19];
/// The version of legacy streams.
const VERSION: i64 = 1001;

fn wrong(message: impl std::fmt::Display) -> PickleError {
    PickleError::content(format!("a PyTorch tensor: {message}"))
}

impl Value<'_> {
    /// A tensor or parameter, in double precision and row-major.
    ///
    /// # Errors
    /// The value is no tensor, or its storage is of a kind that is not read, or does not hold what the tensor shows.
    pub fn tensor(self) -> Result<Array, PickleError> {
        let inner = self.call("torch._utils", "_rebuild_parameter").and_then(|arguments| arguments.item(0));
        let tensor = inner.unwrap_or(self);
        let arguments = tensor
            .call("torch._utils", "_rebuild_tensor_v2")
            .ok_or_else(|| wrong(format!("{} is something else", tensor.kind())))?;
        let part = |k| arguments.item(k).ok_or_else(|| wrong("arguments are missing"));
        let bytes = part(0)?
            .call("torch.storage", "_load_from_bytes")
            .and_then(|arguments| arguments.item(0)?.bytes())
            .ok_or_else(|| wrong("its storage is not within the pickle"))?;
        let storage = storage(bytes)?;
        let lengths = |value: Value<'_>| value.items().map(Value::count).collect::<Option<Vec<usize>>>();
        let offset = part(1)?.count().ok_or_else(|| wrong("its offset is no count"))?;
        let shape = lengths(part(2)?).ok_or_else(|| wrong("its shape is no tuple of lengths"))?;
        let strides = lengths(part(3)?).ok_or_else(|| wrong("its strides are no tuple of steps"))?;
        let values = gather(&storage, offset, &shape, &strides)?;
        Ok(Array::f64(shape, values))
    }
}

/// The numbers that a tensor shows of its storage, the last axis fastest.
fn gather(
    storage: &[f64],
    offset: usize,
    shape: &[usize],
    strides: &[usize],
) -> Result<Vec<f64>, PickleError> {
    if shape.len() != strides.len() {
        return Err(wrong("it has not one stride for each axis"));
    }
    let count = scalars(shape).ok_or_else(|| wrong("its shape is too large"))?;
    let number = |index: usize| {
        let mut rest = index;
        let mut place = offset;
        for (&axis, &stride) in shape.iter().zip(strides).rev() {
            place = (rest % axis).checked_mul(stride)?.checked_add(place)?;
            rest /= axis;
        }
        storage.get(place).copied()
    };
    let values: Option<Vec<f64>> = (0..count).map(number).collect();
    values.ok_or_else(|| wrong("it shows more than its storage holds"))
}

/// What `torch.save` wrote before 1.6: pickles, then the storages that they refer to.
pub struct LegacyStream<'a> {
    /// What was saved.
    pub object: Pickle<'a>,
    /// A list of the keys of the storages, in the order in which they follow.
    pub keys: Pickle<'a>,
    /// For each storage its length in 8 bytes and its numbers.
    pub storages: &'a [u8],
}

impl<'a> LegacyStream<'a> {
    /// Reads the pickles: magic integer, version, byte order, the object, and the keys of its storages.
    ///
    /// # Errors
    /// A pickle is malformed, or the stream is no such one, of another version or big-endian.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, PickleError> {
        let (magic, rest) = Pickle::parse_prefix(bytes)?;
        if magic.root().long() != Some(&MAGIC) {
            return Err(wrong("its storage does not begin as a legacy stream of PyTorch does"));
        }
        let (version, rest) = Pickle::parse_prefix(rest)?;
        if version.root().int() != Some(VERSION) {
            return Err(wrong(format!("its storage is of another version than {VERSION}")));
        }
        let (system, rest) = Pickle::parse_prefix(rest)?;
        if system.root().get("little_endian").and_then(Value::bool) != Some(true) {
            return Err(wrong("its storage is big-endian, which is not read"));
        }
        let (object, rest) = Pickle::parse_prefix(rest)?;
        let (keys, storages) = Pickle::parse_prefix(rest)?;
        Ok(LegacyStream { object, keys, storages })
    }
}

/// The numbers of a stream with one storage.
fn storage(bytes: &[u8]) -> Result<Vec<f64>, PickleError> {
    let LegacyStream { object, keys, storages } = LegacyStream::parse(bytes)?;
    let kind = object.root().persistent_id().and_then(|id| id.item(1)?.callable());
    if keys.root().len() != Some(1) {
        return Err(wrong("its stream holds more than one storage"));
    }
    let (count, numbers) =
        storages.split_first_chunk::<8>().ok_or_else(|| wrong("the storage is cut off before its length"))?;
    let count =
        usize::try_from(i64::from_le_bytes(*count)).map_err(|_| wrong("its storage has no length"))?;
    let values: Vec<f64> = match kind {
        Some(("torch", "FloatStorage")) => {
            numbers.as_chunks::<4>().0.iter().map(|&number| f32::from_le_bytes(number).into()).collect()
        }
        Some(("torch", "DoubleStorage")) => {
            numbers.as_chunks::<8>().0.iter().map(|&number| f64::from_le_bytes(number)).collect()
        }
        Some((module, name)) => return Err(wrong(format!("{module}.{name} is not read"))),
        None => return Err(wrong("its stream refers to no storage")),
    };
    if values.len() != count {
        return Err(wrong(format!("its storage should hold {count} numbers, and holds {}", values.len())));
    }
    Ok(values)
}
