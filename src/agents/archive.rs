//! Named numbers in a safetensors file, with a card in its metadata that says what they are.
//!
//! What is kept lists its parts once, as [`Entry`]s that borrow the numbers in their places; writing reads there, and reading fills them.

use crate::error::PolicyError;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::Deserialize;
use std::collections::HashMap;
use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

/// Most bytes of a file: of policies and demonstrations, and of checkpoints with all the steps that are learnt from again.
pub(crate) const MAX_BYTES: u64 = 64 << 20;
pub(crate) const MAX_CHECKPOINT_BYTES: u64 = 4 << 30;
/// Most bytes of a header, which names tensors and holds a card.
const MAX_HEADER_BYTES: u64 = 1 << 20;
/// The card's name in the metadata. One name alone, as metadata have no order and equal numbers are to make equal files.
const CARD: &str = "robohive";

/// Numbers in their place.
pub(crate) enum Numbers<'a> {
    F32(&'a mut [f32]),
    F64(&'a mut [f64]),
    U64(&'a mut [u64]),
}

/// Numbers with their name and shape.
pub(crate) struct Entry<'a> {
    name: String,
    shape: Vec<usize>,
    numbers: Numbers<'a>,
}

impl<'a> Entry<'a> {
    /// A vector.
    pub fn new(name: impl Into<String>, numbers: Numbers<'a>) -> Self {
        let shape = vec![numbers.len()];
        Entry { name: name.into(), shape, numbers }
    }

    /// A matrix with `rows` rows, stored row by row.
    pub fn matrix(name: impl Into<String>, rows: usize, numbers: Numbers<'a>) -> Self {
        let shape = vec![rows, numbers.len() / rows];
        Entry { name: name.into(), shape, numbers }
    }

    /// The same as a part of something.
    #[must_use]
    pub fn of(mut self, whole: &str) -> Self {
        self.name = format!("{whole}.{}", self.name);
        self
    }
}

impl Numbers<'_> {
    fn len(&self) -> usize {
        match self {
            Numbers::F32(numbers) => numbers.len(),
            Numbers::F64(numbers) => numbers.len(),
            Numbers::U64(numbers) => numbers.len(),
        }
    }

    fn kind(&self) -> Dtype {
        match self {
            Numbers::F32(_) => Dtype::F32,
            Numbers::F64(_) => Dtype::F64,
            Numbers::U64(_) => Dtype::U64,
        }
    }

    fn bytes(&self) -> Vec<u8> {
        match self {
            Numbers::F32(numbers) => numbers.iter().flat_map(|x| x.to_le_bytes()).collect(),
            Numbers::F64(numbers) => numbers.iter().flat_map(|x| x.to_le_bytes()).collect(),
            Numbers::U64(numbers) => numbers.iter().flat_map(|x| x.to_le_bytes()).collect(),
        }
    }

    /// Takes as many numbers as there are; whether all are finite.
    fn fill(&mut self, bytes: &[u8]) -> bool {
        match self {
            Numbers::F32(numbers) => {
                let (words, _) = bytes.as_chunks();
                numbers.iter_mut().zip(words).for_each(|(x, word)| *x = f32::from_le_bytes(*word));
                numbers.iter().all(|x| x.is_finite())
            }
            Numbers::F64(numbers) => {
                let (words, _) = bytes.as_chunks();
                numbers.iter_mut().zip(words).for_each(|(x, word)| *x = f64::from_le_bytes(*word));
                numbers.iter().all(|x| x.is_finite())
            }
            Numbers::U64(numbers) => {
                let (words, _) = bytes.as_chunks();
                numbers.iter_mut().zip(words).for_each(|(x, word)| *x = u64::from_le_bytes(*word));
                true
            }
        }
    }
}

/// Writes a file of at most `most` bytes, which has its name only when it is complete: whatever ends the process, there is the file as it was before or as it is now.
pub(crate) fn write(path: &Path, card: String, entries: &[Entry<'_>], most: u64) -> Result<(), PolicyError> {
    let parts: Vec<_> = entries.iter().map(|entry| (entry, entry.numbers.bytes())).collect();
    let content = |error: safetensors::SafeTensorError| PolicyError::content(error.to_string()).within(path);
    let views = parts.iter().map(|(entry, bytes)| {
        let view = TensorView::new(entry.numbers.kind(), entry.shape.clone(), bytes)?;
        Ok((&entry.name[..], view))
    });
    let views = views.collect::<Result<Vec<_>, _>>().map_err(content)?;
    let metadata = HashMap::from([(CARD.to_owned(), card)]);
    let bytes = safetensors::serialize(views, Some(metadata)).map_err(content)?;
    if bytes.len() as u64 > most {
        let message = format!(
            "it would have more than {} MiB: make hidden layers narrower, or ask for fewer demonstrations",
            most >> 20
        );
        return Err(PolicyError::content(message).within(path));
    }
    let unfinished = path.with_extension("unfinished");
    let keep = || {
        let mut file = File::create(&unfinished)?;
        file.write_all(&bytes)?;
        file.sync_all()?;
        std::fs::rename(&unfinished, path)
    };
    keep().map_err(|error| PolicyError::File { path: path.into(), error })
}

/// The bytes of a file that has at most `most`.
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>, PolicyError> {
    let fail = |error| PolicyError::File { path: path.into(), error };
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(fail)?;
    file.take(most + 1).read_to_end(&mut bytes).map_err(fail)?;
    if bytes.len() as u64 > most {
        let message = format!("it has more than {} MiB, and no file of its kind has", most >> 20);
        return Err(PolicyError::content(message).within(path));
    }
    Ok(bytes)
}

/// The card of a file, and how many bytes the file has: only its header is read.
pub(crate) fn read_card(path: &Path) -> Result<(String, u64), PolicyError> {
    let fail = |error| PolicyError::File { path: path.into(), error };
    let wrong = |message: String| PolicyError::content(message).within(path);
    let mut file = File::open(path).map_err(fail)?;
    let (size, mut length) = (file.metadata().map_err(fail)?.len(), [0; 8]);
    file.read_exact(&mut length).map_err(fail)?;
    let length = u64::from_le_bytes(length);
    if length > MAX_HEADER_BYTES.min(size) {
        return Err(wrong("it is no safetensors file: its header is longer than any".into()));
    }
    let mut header = Vec::new();
    file.take(length).read_to_end(&mut header).map_err(fail)?;
    let header: Header = serde_json::from_slice(&header).map_err(|error| {
        wrong(format!("it is no safetensors file: its header is not understood: {error}"))
    })?;
    let card = header.metadata.get(CARD).cloned();
    card.map(|card| (card, size)).ok_or_else(|| wrong(no_card()))
}

/// Why a file of something else is refused.
fn no_card() -> String {
    format!("its metadata have no {CARD:?}: it was not written by `train`")
}

/// What a header says beside its tensors.
#[derive(Deserialize)]
struct Header {
    #[serde(rename = "__metadata__", default)]
    metadata: HashMap<String, String>,
}

/// Whether bytes are those of a safetensors file: the length of a header, and JSON.
pub(crate) fn is_archive(bytes: &[u8]) -> bool {
    let length = bytes.first_chunk().map_or(u64::MAX, |word| u64::from_le_bytes(*word));
    length <= bytes.len() as u64 && bytes.get(8) == Some(&b'{')
}

/// The contents of a file.
pub(crate) struct Archive<'a> {
    tensors: SafeTensors<'a>,
    card: String,
    /// Bytes of the file.
    pub size: usize,
}

impl<'a> Archive<'a> {
    /// Reads the header.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, PolicyError> {
        let content = |error: safetensors::SafeTensorError| {
            PolicyError::content(format!("it is no safetensors file: {error}"))
        };
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(content)?;
        let tensors = SafeTensors::deserialize(bytes).map_err(content)?;
        let card = header.metadata().as_ref().and_then(|names| names.get(CARD)).cloned();
        let card = card.ok_or_else(|| PolicyError::content(no_card()))?;
        Ok(Archive { tensors, card, size: bytes.len() })
    }

    /// What the card says.
    pub fn card(&self) -> &str {
        &self.card
    }

    /// How many numbers a tensor has.
    pub fn numbers(&self, name: &str) -> Result<usize, PolicyError> {
        Ok(self.tensor(name)?.shape().iter().product())
    }

    fn tensor(&self, name: &str) -> Result<TensorView<'_>, PolicyError> {
        self.tensors.tensor(name).map_err(|_| PolicyError::content(format!("it has no tensor {name:?}")))
    }

    /// Fills all entries.
    pub fn fill(&self, entries: Vec<Entry<'_>>) -> Result<(), PolicyError> {
        for Entry { name, shape, mut numbers } in entries {
            let tensor = self.tensor(&name)?;
            if tensor.shape() != shape || tensor.dtype() != numbers.kind() {
                let message = format!(
                    "the tensor {name:?} is {:?} of {:?}, and {:?} of {shape:?} is needed",
                    tensor.dtype(),
                    tensor.shape(),
                    numbers.kind(),
                );
                return Err(PolicyError::content(message));
            }
            if !numbers.fill(tensor.data()) {
                return Err(PolicyError::content(format!("the tensor {name:?} holds NaN or infinities")));
            }
        }
        Ok(())
    }
}
