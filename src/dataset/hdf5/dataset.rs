//! A dataset: what its header says, and its rows.

use super::bytes::{Cursor, Source};
use super::datatype::{self, Datatype};
use super::encode::{UNDEFINED, kind};
use super::error::Decoded;
use super::filter::{self, EXPANSION, Filter};
use super::header::Message;
use super::heap;
use super::index::{self, Chunk, Grid, Index};
use crate::expansion;
use std::collections::HashMap;
use std::collections::hash_map::Entry::{Occupied, Vacant};
use std::ops::Range;

/// Axes of a dataset at most.
const MAX_RANK: u8 = 32;

/// Texts of a dataset at most.
const MAX_TEXTS: usize = 1 << 16;

/// A dataset. Only the header and the index of chunks are in memory.
#[derive(Clone, Debug)]
pub struct Dataset {
    /// Lengths of the axes; empty for a scalar.
    pub shape: Vec<usize>,
    /// Type of its elements.
    pub datatype: Datatype,
    /// Bytes of one element as stored.
    element: usize,
    layout: Layout,
}

#[derive(Clone, Debug)]
enum Layout {
    Compact(Vec<u8>),
    Contiguous(u64),
    Chunked { shape: Vec<u64>, filters: Vec<Filter>, chunks: Vec<Chunk> },
}

/// The message of a kind.
fn find(messages: &[Message], kind: u8) -> Option<&[u8]> {
    messages.iter().find(|message| message.kind == kind).map(|message| &message.data[..])
}

impl Dataset {
    /// The dataset whose header holds `messages`; nothing for what is none.
    ///
    /// # Errors
    /// The file is damaged, or the dataset is stored in a way that is not read.
    pub fn decode(source: &Source, messages: &[Message]) -> Decoded<Option<Self>> {
        let [Some(space), Some(datatype), Some(layout)] =
            [kind::DATASPACE, kind::DATATYPE, kind::LAYOUT].map(|kind| find(messages, kind))
        else {
            return Ok(None);
        };
        let shape = dataspace(space)?;
        let element = Cursor(datatype.get(4..).ok_or("a datatype is cut off: the file is damaged")?)
            .number(4)? as usize;
        if element == 0 {
            return Err("the elements have no bytes: the file is damaged".into());
        }
        let filters = find(messages, kind::FILTERS).map_or(Ok(Vec::new()), filter::decode)?;
        let bytes = shape.iter().try_fold(element, |n, &axis| n.checked_mul(axis));
        // No file holds more than its compressed bytes can become.
        let most = source.length().saturating_mul(EXPANSION);
        let bytes = bytes.filter(|&n| n as u64 <= most).ok_or_else(|| {
            format!("shape {shape:?} needs more bytes than the file can hold: it is damaged")
        })?;
        within_expansion(source, &filters, bytes as u64)?;
        let layout = Decoder { source, shape: &shape, element, bytes, filters }.layout(layout)?;
        Ok(Some(Dataset { shape, datatype: datatype::decode(datatype)?, element, layout }))
    }

    /// Number of rows: the first axis, or one for a scalar.
    pub fn rows(&self) -> usize {
        self.shape.first().copied().unwrap_or(1)
    }

    /// Bytes of a row.
    pub fn row_bytes(&self) -> usize {
        self.element * self.shape.iter().skip(1).product::<usize>()
    }

    /// Rows that are read together at the least cost.
    pub fn rows_together(&self) -> usize {
        match &self.layout {
            Layout::Chunked { shape, .. } => shape[0] as usize,
            _ => (1 << 16) / self.row_bytes().max(1) + 1,
        }
    }

    /// The bytes of rows, as stored but for filters.
    ///
    /// # Errors
    /// There are no such rows, or the file is damaged.
    pub fn read(&self, source: &Source, rows: Range<usize>) -> Decoded<Vec<u8>> {
        if rows.start > rows.end || rows.end > self.rows() {
            return Err(format!("rows {rows:?} of {} are asked for", self.rows()));
        }
        let (start, count) = (rows.start * self.row_bytes(), rows.len() * self.row_bytes());
        match &self.layout {
            _ if count == 0 => Ok(Vec::new()),
            Layout::Compact(bytes) => Ok(bytes[start..start + count].to_vec()),
            Layout::Contiguous(address) => source.read(address.saturating_add(start as u64), count as u64),
            Layout::Chunked { shape, filters, chunks } => {
                let mut out = vec![0; count];
                let bytes = shape.iter().product::<u64>() * self.element as u64;
                let length = shape[0] as usize;
                let numbers = (rows.start / length) as u64..rows.end.div_ceil(length) as u64;
                for chunk in chunks.iter().filter(|chunk| numbers.contains(&chunk.place[0])) {
                    let stored = source.read(chunk.stored.address, chunk.stored.bytes)?;
                    let bytes = filter::undo(filters, chunk.skipped, stored, bytes)?;
                    self.place(chunk, shape, &bytes, rows.start, &mut out);
                }
                Ok(out)
            }
        }
    }

    /// Copies what a chunk holds of the rows from `first` on, which `out` is for.
    fn place(&self, chunk: &Chunk, lengths: &[u64], bytes: &[u8], first: usize, out: &mut [u8]) {
        let rows = out.len() / self.row_bytes();
        let mut axes = Vec::with_capacity(lengths.len());
        let (mut from_stride, mut to_stride) = (self.element, self.element);
        for axis in (0..lengths.len()).rev() {
            let length = lengths[axis] as usize;
            let start = chunk.place[axis] as usize * length;
            // The window of the dataset that is wanted along this axis.
            let (low, high) = if axis == 0 { (first, first + rows) } else { (0, self.shape[axis]) };
            let (begin, end) = (start.max(low), (start + length).min(high));
            axes.push(Axis {
                count: end.saturating_sub(begin),
                from: (begin.max(start) - start) * from_stride,
                to: (begin - low) * to_stride,
                from_stride,
                to_stride,
            });
            from_stride *= length;
            to_stride *= if axis == 0 { rows } else { self.shape[axis] };
        }
        copy(&axes, bytes, out);
    }

    /// Elements as texts.
    ///
    /// # Errors
    /// They are none, too many, or the file is damaged.
    pub fn texts(&self, source: &Source) -> Decoded<Vec<String>> {
        let count: usize = self.shape.iter().product();
        if count > MAX_TEXTS {
            return Err(format!("{count} texts are more than {MAX_TEXTS}"));
        }
        let bytes = self.read(source, 0..self.rows())?;
        let elements = bytes.chunks_exact(self.element);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim_end_matches('\0').to_owned();
        match self.datatype {
            Datatype::FixedText(_) => Ok(elements.map(text).collect()),
            Datatype::Text => {
                let mut heaps = HashMap::new();
                elements.map(|reference| referred(source, &mut heaps, reference).map(|b| text(&b))).collect()
            }
            _ => Err("the elements are no texts".into()),
        }
    }
}

/// Objects of global heaps, by the address of the heap.
type Heaps = HashMap<u64, HashMap<u64, Vec<u8>>>;

/// What a reference of 16 bytes leads to: its length, the heap, the index.
pub fn referred(source: &Source, heaps: &mut Heaps, reference: &[u8]) -> Decoded<Vec<u8>> {
    let mut at = Cursor(reference);
    let (length, address, index) = (at.number(4)? as usize, at.long()?, at.number(4)?);
    if length == 0 {
        return Ok(Vec::new());
    }
    let heap = match heaps.entry(address) {
        Occupied(known) => known.into_mut(),
        Vacant(new) => new.insert(heap::global(source, address)?),
    };
    let object = heap.get(&index).and_then(|object| object.get(..length));
    let missing =
        || format!("the heap at {address} has no object {index} of {length} bytes: the file is damaged");
    object.map(<[u8]>::to_vec).ok_or_else(missing)
}

/// An axis of a block that is copied.
struct Axis {
    count: usize,
    from: usize,
    to: usize,
    from_stride: usize,
    to_stride: usize,
}

/// Copies a block; the last axis comes first.
fn copy(axes: &[Axis], from: &[u8], to: &mut [u8]) {
    let Some((axis, inner)) = axes.split_last() else {
        return;
    };
    let end = to.len();
    let (from, to) = (&from[axis.from.min(from.len())..], &mut to[axis.to.min(end)..]);
    if inner.is_empty() {
        let bytes = axis.count * axis.from_stride;
        to[..bytes].copy_from_slice(&from[..bytes]);
        return;
    }
    for i in 0..axis.count {
        copy(inner, &from[i * axis.from_stride..], &mut to[i * axis.to_stride..]);
    }
}

fn dataspace(body: &[u8]) -> Decoded<Vec<usize>> {
    let mut at = Cursor(body);
    let (version, rank, _flags, class) = (at.byte()?, at.byte()?, at.byte()?, at.byte()?);
    if rank > MAX_RANK || !(1..=2).contains(&version) {
        return Err("the shape is unreadable: the file is damaged".into());
    }
    // The first version has five reserved bytes where the second has the class; 2 is a dataspace without elements.
    at.take(if version == 1 { 4 } else { 0 })?;
    if version == 2 && class == 2 {
        return Ok(vec![0]);
    }
    let axis = |_| usize::try_from(at.long()?).map_err(|e| e.to_string());
    (0..rank).map(axis).collect()
}

/// Refuses filtered bytes that are more than a file of this length may become.
fn within_expansion(source: &Source, filters: &[Filter], bytes: u64) -> Decoded<()> {
    let length = source.length();
    if filters.is_empty() || bytes <= expansion::most(length) {
        return Ok(());
    }
    Err(format!(
        "{bytes} bytes are deflated into a file of {length}: write it without compression, or in parts"
    ))
}

/// What a layout is read with.
struct Decoder<'a> {
    source: &'a Source,
    shape: &'a [usize],
    element: usize,
    /// Of the whole dataset.
    bytes: usize,
    filters: Vec<Filter>,
}

impl Decoder<'_> {
    fn layout(self, body: &[u8]) -> Decoded<Layout> {
        let mut at = Cursor(body);
        let (version, class) = (at.byte()?, at.byte()?);
        match (version, class) {
            (3..=5, 0) => {
                let length = at.short()?;
                let bytes = at.take(length)?;
                let fits = bytes.len() >= self.bytes;
                fits.then(|| Layout::Compact(bytes.to_vec()))
                    .ok_or_else(|| "a compact dataset is cut off: the file is damaged".into())
            }
            (3..=5, 1) => {
                let address = at.long()?;
                if self.bytes > 0 {
                    let missing = "the dataset was never written";
                    (address != UNDEFINED).then_some(()).ok_or(missing)?;
                    let last = address.saturating_add(self.bytes as u64 - 1);
                    self.source.read(last, 1)?;
                }
                Ok(Layout::Contiguous(address))
            }
            (3, 2) => {
                let rank = usize::from(at.byte()?);
                let address = at.long()?;
                let lengths = (0..rank).map(|_| at.number(4)).collect::<Decoded<Vec<u64>>>()?;
                self.chunked(lengths, Index::Tree(address))
            }
            (4..=5, 2) => {
                let (flags, rank, width) = (at.byte()?, at.byte()?, at.byte()?);
                if !(1..=8).contains(&width) {
                    return Err("a shape of chunks is unreadable: the file is damaged".into());
                }
                let lengths = (0..rank).map(|_| at.number(width.into())).collect::<Decoded<Vec<u64>>>()?;
                let index = chunk_index(&mut at, flags)?;
                self.chunked(lengths, index)
            }
            (..=2, _) => Err(format!("layout version {version} (HDF5 before 1.6.3) is not read")),
            (_, 3) => Err("virtual datasets are not read".into()),
            _ => Err(format!("layout version {version}, class {class} is unknown")),
        }
    }

    fn chunked(self, mut lengths: Vec<u64>, index: Index) -> Decoded<Layout> {
        // The last length is the size of an element.
        let element = lengths.pop();
        let product = lengths.iter().try_fold(self.element as u64, |n, &length| n.checked_mul(length));
        let most = self.source.length().saturating_mul(EXPANSION);
        let fits = element == Some(self.element as u64)
            && lengths.len() == self.shape.len()
            && !lengths.is_empty()
            && product.is_some_and(|n| n > 0 && n <= most);
        let bytes = product.filter(|_| fits).ok_or("the chunks do not fit the shape: the file is damaged")?;
        let counts: Vec<u64> =
            self.shape.iter().zip(&lengths).map(|(&axis, &length)| (axis as u64).div_ceil(length)).collect();
        // A chunk may be larger than the dataset.
        within_expansion(self.source, &self.filters, bytes)?;
        let filtered = !self.filters.is_empty();
        let grid = Grid { counts: &counts, chunk: &lengths, bytes, filtered };
        let chunks = if self.bytes == 0 { Vec::new() } else { index::chunks(self.source, &index, &grid)? };
        check(&chunks, &counts, self.source)?;
        Ok(Layout::Chunked { shape: lengths, filters: self.filters, chunks })
    }
}

fn chunk_index(at: &mut Cursor<'_>, flags: u8) -> Decoded<Index> {
    match at.byte()? {
        1 => {
            let (bytes, skipped) = if flags & 2 == 0 { (None, 0) } else { (Some(at.long()?), at.number(4)?) };
            Ok(Index::Single { address: at.long()?, bytes, skipped })
        }
        2 => Ok(Index::Implicit(at.long()?)),
        3 => {
            at.byte()?;
            Ok(Index::FixedArray(at.long()?))
        }
        other => {
            let name = if other == 4 { "extensible array" } else { "tree of version 2" };
            Err(format!(
                "chunks of a dataset without fixed length under libver=\"latest\" ({name}) are not read: write the file \
                with h5py's default libver"
            ))
        }
    }
}

/// Every chunk of the grid must be there, once, and together they must fit into the file.
fn check(chunks: &[Chunk], counts: &[u64], source: &Source) -> Decoded<()> {
    let needed: u64 = counts.iter().try_fold(1u64, |n, &count| n.checked_mul(count)).unwrap_or(u64::MAX);
    let inside: Vec<&Chunk> = chunks
        .iter()
        .filter(|chunk| chunk.place.iter().zip(counts).all(|(place, count)| place < count))
        .collect();
    let mut places: Vec<&[u64]> = inside.iter().map(|chunk| &chunk.place[..]).collect();
    places.sort_unstable();
    places.dedup();
    if places.len() as u64 != needed || inside.len() != places.len() {
        let found = places.len();
        return Err(format!(
            "{found} of {needed} chunks are in the file: it is damaged, or the dataset was never completed"
        ));
    }
    let stored = inside.iter().try_fold(0u64, |sum, chunk| sum.checked_add(chunk.stored.bytes));
    if stored.is_none_or(|sum| sum > source.length()) {
        return Err("the chunks have more bytes than the file: it is damaged".into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is wrong with deflated bytes, `rows` in chunks of `chunk`, in a file of 300 KB.
    fn refusal(rows: u64, chunk: u32) -> String {
        let message = |kind, data: Vec<u8>| Message { kind, data };
        let space = [&[2, 1, 0, 1][..], &rows.to_le_bytes()].concat();
        let datatype = [&[0x10, 0, 0, 0][..], &1_u32.to_le_bytes(), &[0, 0, 8, 0]].concat();
        let layout = [&[3, 2, 2][..], &[0; 8], &chunk.to_le_bytes(), &1_u32.to_le_bytes()].concat();
        let messages = [
            message(kind::DATASPACE, space),
            message(kind::DATATYPE, datatype),
            message(kind::LAYOUT, layout),
            message(kind::FILTERS, vec![2, 1, 1, 0, 0, 0, 1, 0, 6, 0, 0, 0]),
        ];
        Dataset::decode(&Source::memory(vec![0; 300_000]), &messages).unwrap_err()
    }

    /// Neither the dataset nor a chunk of it is inflated.
    #[test]
    fn what_a_small_file_inflates_to_is_bounded() {
        let deflated = |bytes: u64| format!("{bytes} bytes are deflated into a file of 300000");
        assert!(refusal(300_000_000, 1000).starts_with(&deflated(300_000_000)));
        assert!(refusal(10, 300_000_000).starts_with(&deflated(300_000_000)));
        assert!(refusal(u64::MAX, 1000).contains("more bytes than the file can hold"));
        assert!(!refusal(1000, 100).contains("deflated"));
    }
}
