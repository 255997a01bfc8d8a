//! The header of a safetensors file: its length in 8 bytes, then an object with type, shape and place of each tensor.
//!
//! Source: the format's description, <https://github.com/huggingface/safetensors>.

use super::tensor::{Entry, Kind, Storage, Stream, numbers, row_major};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Most bytes of the header of a safetensors file.
pub const MAX_HEADER: u64 = 4 << 20;

/// What is no tensor in the header: remarks on the file.
const REMARKS: &str = "__metadata__";

/// A tensor as the header describes it.
#[derive(Deserialize)]
struct Described {
    dtype: String,
    shape: Vec<usize>,
    /// First byte and the one after the last, counted from the end of the header.
    data_offsets: [u64; 2],
}

/// The tensors of a file of `length` bytes.
pub(super) fn index(file: &mut dyn Stream, length: u64) -> Result<BTreeMap<String, Entry>, String> {
    let mut size = [0; 8];
    file.read_exact(&mut size).map_err(|error| error.to_string())?;
    let header = u64::from_le_bytes(size);
    if header > MAX_HEADER {
        return Err(format!("its header of {header} bytes is larger than {MAX_HEADER}"));
    }
    let data = 8 + header;
    if data > length {
        return Err(format!("the file ends within its header: {length} bytes are there, {data} announced"));
    }
    let mut text = vec![0; header as usize];
    file.read_exact(&mut text).map_err(|error| error.to_string())?;
    let wrong = |error| format!("its header is not that of a safetensors file: {error}");
    let mut items: BTreeMap<String, serde_json::Value> = serde_json::from_slice(&text).map_err(wrong)?;
    items.remove(REMARKS);
    let entry = |(name, item)| {
        let described = serde_json::from_value(item).map_err(|error| format!("tensor {name}: {error}"))?;
        let entry = entry(described, data, length).map_err(|reason| format!("tensor {name}: {reason}"))?;
        Ok((name, entry))
    };
    items.into_iter().map(entry).collect()
}

fn entry(described: Described, data: u64, length: u64) -> Result<Entry, String> {
    let kind = kind(&described.dtype).ok_or_else(|| format!("its type {} is not read", described.dtype))?;
    let [first, end] = described.data_offsets;
    let bytes = end.checked_sub(first).ok_or("it ends before it begins")?;
    let expected = numbers(&described.shape)? * kind.bytes();
    if bytes != expected as u64 {
        return Err(format!("its shape {:?} needs {expected} bytes, and it has {bytes}", described.shape));
    }
    let offset = data.checked_add(first).ok_or("its place is beyond all files")?;
    if length.checked_sub(bytes).is_none_or(|last| offset > last) {
        return Err(format!("it is cut off: the file has {length} bytes"));
    }
    let strides = row_major(&described.shape);
    Ok(Entry { kind, shape: described.shape, strides, start: 0, storage: Storage::Region { offset, bytes } })
}

fn kind(dtype: &str) -> Option<Kind> {
    Some(match dtype {
        "F16" => Kind::F16,
        "BF16" => Kind::Bf16,
        "F32" => Kind::F32,
        "F64" => Kind::F64,
        "BOOL" | "U8" | "I8" => Kind::Other(1),
        "U16" | "I16" => Kind::Other(2),
        "U32" | "I32" => Kind::Other(4),
        "U64" | "I64" => Kind::Other(8),
        _ => return None,
    })
}
