//! Files that `torch.save` wrote: a zip archive with a pickle and a member for each storage, or, before PyTorch 1.6, pickles
//! followed by the storages.
//!
//! A state dictionary is found at the root or under one of a few keys. Of the names in the pickle only those by which PyTorch
//! rebuilds tensors mean anything; no other is looked up, let alone called.

use super::tensor::{Entry, Kind, Storage, Stream, numbers};
use dataset::pickle::{LegacyStream, Pickle, Value};
use std::collections::{BTreeMap, HashMap};
use std::io::{Read, SeekFrom};
use zip::ZipArchive;

/// Most bytes of a pickle, or of what precedes the storages.
pub const MAX_PICKLE: u64 = 4 << 20;

/// Keys under which checkpoints keep the state dictionary: R3M's, VC-1's and the usual one.
const HOLDERS: [&str; 3] = ["r3m", "model", "state_dict"];

/// Types of storages.
const KINDS: [(&str, Kind); 10] = [
    ("FloatStorage", Kind::F32),
    ("DoubleStorage", Kind::F64),
    ("HalfStorage", Kind::F16),
    ("BFloat16Storage", Kind::Bf16),
    ("LongStorage", Kind::Other(8)),
    ("IntStorage", Kind::Other(4)),
    ("ShortStorage", Kind::Other(2)),
    ("CharStorage", Kind::Other(1)),
    ("ByteStorage", Kind::Other(1)),
    ("BoolStorage", Kind::Other(1)),
];

/// The tensors of an archive.
pub(super) fn index_archive(
    archive: &mut ZipArchive<Box<dyn Stream>>,
) -> Result<BTreeMap<String, Entry>, String> {
    let pickle = archive.file_names().find(|name| *name == "data.pkl" || name.ends_with("/data.pkl"));
    let pickle = pickle.ok_or("the archive has no data.pkl, as those of torch.save have")?.to_owned();
    let folder = pickle.trim_end_matches("data.pkl").to_owned();
    if let Some(index) = archive.index_for_name(&format!("{folder}byteorder"))
        && read_member(archive, index)? != b"little"
    {
        return Err("its numbers are big-endian, which is not read".into());
    }
    let index = archive.index_for_name(&pickle).ok_or("the archive lost its data.pkl")?;
    let bytes = read_member(archive, index)?;
    let parsed = Pickle::parse(&bytes).map_err(|error| error.to_string())?;
    index_dictionary(parsed.root(), |reference| {
        let name = format!("{folder}data/{}", reference.key);
        let index = archive.index_for_name(&name).ok_or_else(|| format!("the archive has no {name}"))?;
        Ok(Storage::Member { index })
    })
}

/// A small member of an archive.
fn read_member(archive: &mut ZipArchive<Box<dyn Stream>>, index: usize) -> Result<Vec<u8>, String> {
    let member = archive.by_index(index).map_err(|error| error.to_string())?;
    let name = member.name().to_owned();
    let mut bytes = Vec::new();
    member.take(MAX_PICKLE + 1).read_to_end(&mut bytes).map_err(|error| format!("{name}: {error}"))?;
    if bytes.len() as u64 > MAX_PICKLE {
        return Err(format!("{name} has more than {MAX_PICKLE} bytes"));
    }
    Ok(bytes)
}

/// The tensors of a file in the form before archives, of `length` bytes.
pub(super) fn index_legacy(file: &mut dyn Stream, length: u64) -> Result<BTreeMap<String, Entry>, String> {
    let mut bytes = Vec::new();
    file.take(MAX_PICKLE).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    let stream = LegacyStream::parse(&bytes).map_err(|error| error.to_string())?;
    let mut kinds = HashMap::new();
    for value in stream.object.persistent() {
        let reference = reference(value)?;
        kinds.insert(reference.key, reference.kind);
    }
    let mut places = HashMap::new();
    let mut offset = (bytes.len() - stream.storages.len()) as u64;
    for key in stream.keys.root().items() {
        let key = key.text().ok_or("the key of a storage is no text")?;
        let kind = kinds.get(key).ok_or_else(|| format!("no tensor refers to the storage {key}"))?;
        let count = read_count(file, offset, length)?;
        let cut = || format!("the file of {length} bytes is cut off within the storage {key}");
        let held = count.checked_mul(kind.bytes() as u64).ok_or_else(cut)?;
        let end = (offset + 8).checked_add(held).filter(|&end| end <= length).ok_or_else(cut)?;
        places.insert(key, Storage::Region { offset: offset + 8, bytes: held });
        offset = end;
    }
    index_dictionary(stream.object.root(), |reference| {
        places.get(reference.key).copied().ok_or_else(|| format!("the file has no storage {}", reference.key))
    })
}

/// How many numbers follow: 8 bytes.
fn read_count(file: &mut dyn Stream, offset: u64, length: u64) -> Result<u64, String> {
    if offset + 8 > length {
        return Err(format!("the file of {length} bytes is cut off before its last storage"));
    }
    let mut count = [0; 8];
    file.seek(SeekFrom::Start(offset)).map_err(|error| error.to_string())?;
    file.read_exact(&mut count).map_err(|error| error.to_string())?;
    u64::try_from(i64::from_le_bytes(count)).map_err(|_| "the length of a storage is negative".into())
}

/// What stands for a storage in the pickle.
struct Reference<'p> {
    kind: Kind,
    key: &'p str,
}

/// Reads `("storage", torch.FloatStorage, key, device, length)`.
fn reference(value: Value<'_>) -> Result<Reference<'_>, String> {
    let id = value.persistent_id().ok_or("its storage is not referred to by a key")?;
    if id.item(0).and_then(Value::text) != Some("storage") {
        return Err("it refers to something that is no storage".into());
    }
    let (module, name) = id.item(1).and_then(Value::callable).ok_or("its storage has no type")?;
    let kind = KINDS.iter().find(|(known, _)| *known == name && module == "torch");
    let kind = kind.ok_or_else(|| format!("its storage is a {module}.{name}, which is not read"))?.1;
    let key = id.item(2).and_then(Value::text).ok_or("its storage has no key")?;
    if id.item(5).is_some_and(|view| !view.is_none()) {
        return Err("its storage is a view of another, which is not read".into());
    }
    Ok(Reference { kind, key })
}

/// The tensors of the state dictionary below `root`.
fn index_dictionary(
    root: Value<'_>,
    place: impl Fn(&Reference<'_>) -> Result<Storage, String>,
) -> Result<BTreeMap<String, Entry>, String> {
    let held = HOLDERS.iter().find_map(|key| root.get(key).filter(|value| value.entries().next().is_some()));
    let dictionary = held.unwrap_or(root);
    let class = dictionary.callable().filter(|class| *class != ("collections", "OrderedDict"));
    if let Some((module, name)) = class {
        return Err(format!(
            "it holds a {module}.{name} and not a dictionary of tensors: save model.state_dict()"
        ));
    }
    let mut entries = BTreeMap::new();
    for (key, value) in dictionary.entries() {
        let name =
            key.text().ok_or_else(|| format!("{} is the name of a tensor, and no text", key.kind()))?;
        let entry = tensor(value, &place).map_err(|reason| format!("tensor {name}: {reason}"))?;
        entries.insert(name.to_owned(), entry);
    }
    if entries.is_empty() {
        return Err(format!("it holds {} without tensors", root.kind()));
    }
    Ok(entries)
}

fn tensor(
    value: Value<'_>,
    place: impl Fn(&Reference<'_>) -> Result<Storage, String>,
) -> Result<Entry, String> {
    let inner = value.call("torch._utils", "_rebuild_parameter").and_then(|arguments| arguments.item(0));
    let value = inner.unwrap_or(value);
    let arguments = value
        .call("torch._utils", "_rebuild_tensor_v2")
        .ok_or_else(|| format!("it is {}, and no tensor", value.kind()))?;
    let part = |k| arguments.item(k).ok_or("arguments are missing");
    let lengths = |value: Value<'_>| value.items().map(Value::count).collect::<Option<Vec<usize>>>();
    let reference = reference(part(0)?)?;
    let start = part(1)?.count().ok_or("its offset is no count")?;
    let shape = lengths(part(2)?).ok_or("its shape is no tuple of lengths")?;
    let strides = lengths(part(3)?).ok_or("its strides are no tuple of steps")?;
    if shape.len() != strides.len() {
        return Err("it has not one stride for each axis".into());
    }
    numbers(&shape)?;
    Ok(Entry { kind: reference.kind, shape, strides, start, storage: place(&reference)? })
}
