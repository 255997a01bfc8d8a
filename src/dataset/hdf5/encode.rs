//! Pieces of an HDF5 file as bytes (HDF5 File Format Specification, version 3.0): superblock 2, object headers 2, layout 4.
//!
//! Readers of HDF5 1.10 and later know them. Offsets and lengths have eight bytes.

use super::checksum::lookup3;
use crate::npy::Dtype;

/// An address that leads nowhere.
pub const UNDEFINED: u64 = u64::MAX;

/// First bytes of every file.
pub const SIGNATURE: &[u8; 8] = b"\x89HDF\r\n\x1a\n";

/// Attribute of the root group that says which program wrote the file.
pub const WRITER: &str = "writer";

/// Bytes of a superblock.
pub const SUPERBLOCK: usize = 48;

/// Level of compression, as in the original.
pub const DEFLATE_LEVEL: u32 = 4;

/// Kinds of messages in object headers.
pub mod kind {
    /// Shape.
    pub const DATASPACE: u8 = 0x01;
    /// Where the links of a group are.
    pub const LINK_INFO: u8 = 0x02;
    /// Type of scalars.
    pub const DATATYPE: u8 = 0x03;
    /// Value of scalars that were never written.
    pub const FILL: u8 = 0x05;
    /// A member of a group.
    pub const LINK: u8 = 0x06;
    /// Where the scalars are.
    pub const LAYOUT: u8 = 0x08;
    /// How a group may grow.
    pub const GROUP_INFO: u8 = 0x0a;
    /// What was done to chunks.
    pub const FILTERS: u8 = 0x0b;
    /// A named value.
    pub const ATTRIBUTE: u8 = 0x0c;
    /// Where the header goes on.
    pub const CONTINUATION: u8 = 0x10;
    /// Members of a group, in the old format.
    pub const SYMBOL_TABLE: u8 = 0x11;
}

/// A chunk of a dataset in the file.
#[derive(Clone, Copy, Debug)]
pub struct Stored {
    /// Where it begins.
    pub address: u64,
    /// Bytes as compressed.
    pub bytes: u64,
}

/// Puts the checksum of everything so far behind it.
fn seal(mut bytes: Vec<u8>) -> Vec<u8> {
    let sum = lookup3(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

/// The superblock of a file of `end` bytes whose root group has its header at `root`.
pub fn superblock(root: u64, end: u64) -> Vec<u8> {
    let mut out = SIGNATURE.to_vec();
    out.extend([2, 8, 8, 0]);
    for address in [0, UNDEFINED, end, root] {
        out.extend(address.to_le_bytes());
    }
    seal(out)
}

/// A message of an object header; `constant` is said of what never changes.
pub fn message(kind: u8, constant: bool, data: &[u8]) -> Vec<u8> {
    let mut out = vec![kind];
    out.extend((data.len() as u16).to_le_bytes());
    out.push(u8::from(constant));
    out.extend(data);
    out
}

/// An object header around its messages.
pub fn object_header(messages: &[u8]) -> Vec<u8> {
    let mut out = b"OHDR".to_vec();
    // The number of bytes is given in four.
    out.extend([2, 2]);
    out.extend((messages.len() as u32).to_le_bytes());
    out.extend(messages);
    seal(out)
}

/// Further messages of an object header, which a message of kind continuation leads to.
pub fn header_block(messages: &[u8]) -> Vec<u8> {
    let mut out = b"OCHK".to_vec();
    out.extend(messages);
    seal(out)
}

/// The message that leads to a [`header_block`].
pub fn continuation(address: u64, bytes: u64) -> Vec<u8> {
    message(kind::CONTINUATION, false, &[address.to_le_bytes(), bytes.to_le_bytes()].concat())
}

/// What the header of every group begins with: its links are messages of the header.
pub fn group_info() -> Vec<u8> {
    let mut links = vec![0, 0];
    links.extend(UNDEFINED.to_le_bytes());
    links.extend(UNDEFINED.to_le_bytes());
    [message(kind::LINK_INFO, false, &links), message(kind::GROUP_INFO, false, &[0, 0])].concat()
}

/// A member of a group: an object whose header is at `address`. Names have at most [`MAX_NAME`] bytes.
pub fn link(name: &str, address: u64) -> Vec<u8> {
    // The length has two bytes, the character set is given: UTF-8.
    let mut data = vec![1, 0b1_0001, 1];
    data.extend((name.len() as u16).to_le_bytes());
    data.extend(name.bytes());
    data.extend(address.to_le_bytes());
    message(kind::LINK, false, &data)
}

/// Bytes of a name at most.
pub const MAX_NAME: usize = 1024;

/// Type of scalars: numbers, or text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// As numpy's.
    Number(Dtype),
    /// UTF-8 of this many bytes at most, zeros behind it.
    Text(u32),
}

impl Element {
    /// Bytes of one.
    pub fn bytes(self) -> usize {
        match self {
            Element::Number(dtype) => dtype.bytes(),
            Element::Text(bytes) => bytes as usize,
        }
    }
}

/// The body of a datatype message.
pub fn datatype(element: Element) -> Vec<u8> {
    let dtype = match element {
        Element::Text(bytes) => return [&[0x13, 0x11, 0, 0][..], &bytes.to_le_bytes()].concat(),
        Element::Number(dtype) => dtype,
    };
    match dtype {
        Dtype::U8 | Dtype::U16 | Dtype::U32 | Dtype::U64 => integer(dtype.bytes(), false),
        Dtype::I8 | Dtype::I16 | Dtype::I32 | Dtype::I64 => integer(dtype.bytes(), true),
        Dtype::F16 => float(2, 10, 15),
        Dtype::F32 => float(4, 23, 127),
        Dtype::F64 => float(8, 52, 1023),
        // As h5py writes numpy's bool: an enumeration over one byte, names padded to eight.
        Dtype::Bool => {
            let mut out = vec![0x18, 2, 0, 0];
            out.extend(1u32.to_le_bytes());
            out.extend(integer(1, true));
            out.extend(b"FALSE\0\0\0TRUE\0\0\0\0\x00\x01");
            out
        }
    }
}

fn integer(bytes: usize, signed: bool) -> Vec<u8> {
    let mut out = vec![0x10, u8::from(signed) << 3, 0, 0];
    out.extend((bytes as u32).to_le_bytes());
    out.extend([0, 0]);
    out.extend((8 * bytes as u16).to_le_bytes());
    out
}

/// IEEE 754 with `fraction` bits of fraction; the sign is the highest bit.
pub fn float(bytes: usize, fraction: u8, bias: u32) -> Vec<u8> {
    let bits = 8 * bytes as u8;
    let mut out = vec![0x11, 0x20, bits - 1, 0];
    out.extend((bytes as u32).to_le_bytes());
    out.extend([0, 0, bits, 0, fraction, bits - 1 - fraction, 0, fraction]);
    out.extend(bias.to_le_bytes());
    out
}

fn dataspace(shape: &[usize]) -> Vec<u8> {
    let mut out = vec![2, shape.len() as u8, 0, u8::from(!shape.is_empty())];
    shape.iter().for_each(|&n| out.extend((n as u64).to_le_bytes()));
    out
}

/// The filters of every chunk: bytes of equal significance together, then deflate.
fn filters(element: usize) -> Vec<u8> {
    let mut out = vec![2, 2];
    for (id, parameter) in [(2u16, element as u32), (1, DEFLATE_LEVEL)] {
        out.extend(id.to_le_bytes());
        // Required; one parameter.
        out.extend([0, 0, 1, 0]);
        out.extend(parameter.to_le_bytes());
    }
    out
}

/// What the headers of all datasets have: shape, type, and zero where nothing was written.
fn dataset_start(element: Element, shape: &[usize]) -> Vec<u8> {
    let space = message(kind::DATASPACE, false, &dataspace(shape));
    let datatype = message(kind::DATATYPE, true, &datatype(element));
    let fill = message(kind::FILL, true, &[3, 0x0b]);
    [space, datatype, fill].concat()
}

/// Header of a dataset whose scalars stand together at `address`, uncompressed.
pub fn whole_dataset(element: Element, shape: &[usize], address: u64) -> Vec<u8> {
    let bytes = element.bytes() * shape.iter().product::<usize>();
    let mut layout = vec![3, 1];
    layout.extend(if bytes == 0 { UNDEFINED } else { address }.to_le_bytes());
    layout.extend((bytes as u64).to_le_bytes());
    let messages = [dataset_start(element, shape), message(kind::LAYOUT, false, &layout)].concat();
    object_header(&messages)
}

/// Header of a dataset of compressed chunks, each `chunk_rows` whole rows, and the index of its chunks, which will stand
/// at `address` with the header behind it. Returns both, and where in them the header begins.
pub fn chunked_dataset(
    dtype: Dtype,
    shape: &[usize],
    chunk_rows: usize,
    chunks: &[Stored],
    address: u64,
) -> (Vec<u8>, usize) {
    let mut layout = vec![4, 2];
    // Flags: a single chunk gives its size in the layout.
    layout.push(if chunks.len() == 1 { 2 } else { 0 });
    let lengths = [&[chunk_rows], &shape[1..], &[dtype.bytes()]].concat();
    // The library wants lengths in as few bytes as the longest needs.
    let width = lengths.iter().map(|length| length.ilog2() as usize / 8 + 1).max().unwrap_or(1);
    layout.extend([lengths.len() as u8, width as u8]);
    lengths.iter().for_each(|length| layout.extend(&length.to_le_bytes()[..width]));
    let mut out = Vec::new();
    if let [only] = chunks {
        layout.push(1);
        layout.extend(only.bytes.to_le_bytes());
        layout.extend([0; 4]);
        layout.extend(only.address.to_le_bytes());
    } else {
        let bits = page_bits(chunks.len());
        layout.extend([3, bits]);
        layout.extend(address.to_le_bytes());
        let chunk = chunk_rows * shape[1..].iter().product::<usize>() * dtype.bytes();
        out = fixed_array(chunks, chunk, bits, address);
        out.resize(out.len().next_multiple_of(8), 0);
    }
    let start = out.len();
    let messages = [
        dataset_start(Element::Number(dtype), shape),
        message(kind::LAYOUT, false, &layout),
        message(kind::FILTERS, true, &filters(dtype.bytes())),
    ];
    out.extend(object_header(&messages.concat()));
    (out, start)
}

/// Bits of the number of chunks that one page of an index holds: all of them.
fn page_bits(chunks: usize) -> u8 {
    chunks.next_power_of_two().trailing_zeros().max(10) as u8
}

/// An index of chunks, header and elements, that begins at `address`. `chunk` is the number of bytes before compression.
fn fixed_array(chunks: &[Stored], chunk: usize, page_bits: u8, address: u64) -> Vec<u8> {
    // Bytes of the size of a compressed chunk, by the rule of the library.
    let width = (1 + (chunk.ilog2() as usize + 8) / 8).min(8);
    let mut head = b"FAHD\0\x01".to_vec();
    head.extend([(8 + width + 4) as u8, page_bits]);
    head.extend((chunks.len() as u64).to_le_bytes());
    // The elements follow behind this address and the checksum.
    let elements = address + head.len() as u64 + 12;
    head.extend(elements.to_le_bytes());
    let mut block = b"FADB\0\x01".to_vec();
    block.extend(address.to_le_bytes());
    for stored in chunks {
        block.extend(stored.address.to_le_bytes());
        block.extend(&stored.bytes.to_le_bytes()[..width]);
        block.extend([0; 4]);
    }
    [seal(head), seal(block)].concat()
}

/// A heap with one text after another, each found by its index from 1 on.
pub fn global_heap(texts: &[String]) -> Vec<u8> {
    /// The library reads no smaller one.
    const LEAST: usize = 4096;
    let mut objects = Vec::new();
    for (i, text) in texts.iter().enumerate() {
        objects.extend((i as u16 + 1).to_le_bytes());
        // One reference, and padding.
        objects.extend([1, 0, 0, 0, 0, 0]);
        objects.extend((text.len() as u64).to_le_bytes());
        objects.extend(text.bytes());
        objects.resize(objects.len().next_multiple_of(8), 0);
    }
    let bytes = (16 + objects.len() + 16).max(LEAST);
    let mut out = b"GCOL\x01\0\0\0".to_vec();
    out.extend((bytes as u64).to_le_bytes());
    out.extend(objects);
    let free = (bytes - out.len()) as u64;
    out.extend([0; 8]);
    out.extend(free.to_le_bytes());
    out.resize(bytes, 0);
    out
}

/// A text by the name of `name`: object `index` of the heap at `heap`.
pub fn text_attribute(name: &str, text: &str, heap: u64, index: u32) -> Vec<u8> {
    // Text of any length, UTF-8, made of bytes.
    let mut datatype = vec![0x19, 0x01, 0x01, 0];
    datatype.extend(16u32.to_le_bytes());
    datatype.extend(integer(1, false));
    let mut value = (text.len() as u32).to_le_bytes().to_vec();
    value.extend(heap.to_le_bytes());
    value.extend(index.to_le_bytes());
    attribute(name, &datatype, &value)
}

/// An integer by the name of `name`.
pub fn integer_attribute(name: &str, value: i64) -> Vec<u8> {
    attribute(name, &integer(8, true), &value.to_le_bytes())
}

/// A single value of this type by the name of `name`.
fn attribute(name: &str, datatype: &[u8], value: &[u8]) -> Vec<u8> {
    let space = dataspace(&[]);
    let mut data = vec![3, 0];
    for length in [name.len() + 1, datatype.len(), space.len()] {
        data.extend((length as u16).to_le_bytes());
    }
    data.push(1);
    data.extend(name.bytes().chain([0]));
    data.extend(datatype);
    data.extend(space);
    data.extend(value);
    message(kind::ATTRIBUTE, false, &data)
}
