//! The values of a pickle as a graph: what its program leaves behind.

use std::ops::Range;

/// A value's place among all values of a pickle.
pub(super) type Id = u32;

/// A value; bytes and text stand in the input.
#[derive(Clone, Debug)]
pub(super) enum Node {
    None,
    Bool(bool),
    Int(i64),
    /// An integer that i64 does not hold: little-endian two's complement.
    Long(Range<usize>),
    Float(f64),
    Text(Range<usize>),
    Bytes(Range<usize>),
    List(Vec<Id>),
    Tuple(Vec<Id>),
    Set(Vec<Id>),
    Dict(Vec<[Id; 2]>),
    /// A class or function: module and name.
    Global([Range<usize>; 2]),
    Object(Box<Object>),
    /// A value that is kept outside the pickle, by what identifies it there.
    Persistent(Id),
}

/// What the pickle would have called or instantiated.
#[derive(Clone, Debug)]
pub(super) struct Object {
    pub(super) callable: Id,
    pub(super) arguments: Id,
    pub(super) state: Option<Id>,
    /// Appended to it, if it is a list.
    pub(super) items: Vec<Id>,
    /// Set in it, if it is a dictionary.
    pub(super) entries: Vec<[Id; 2]>,
}

/// The values of a pickle.
#[derive(Clone, Debug)]
pub struct Pickle<'a> {
    pub(super) input: &'a [u8],
    pub(super) nodes: Vec<Node>,
    pub(super) root: Id,
}

impl Pickle<'_> {
    pub(super) fn text(&self, range: &Range<usize>) -> &str {
        // Checked when it was read.
        std::str::from_utf8(&self.input[range.clone()]).unwrap_or_default()
    }
}
