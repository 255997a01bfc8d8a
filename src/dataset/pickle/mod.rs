//! Python pickles, read without being executed (Python documentation: `pickle`, `pickletools`; protocols 2 to 5).
//!
//! A pickle is a program that builds objects. Here it builds a graph of inert [`Value`]s: a class or function that it names
//! stays a name, and what it would call or instantiate becomes an object with that name, its arguments and its state.
//! Nothing is looked up, imported or called, so a pickle from anywhere is as safe to read as any other file. Memory is
//! proportional to the input, and nothing recurses, so neither depth nor cycles can exhaust the stack.
//!
//! ```
//! use robohive_dataset::pickle::Pickle;
//! // pickle.dumps({"n": [1, 2.5]}, protocol=2)
//! let bytes = b"\x80\x02}X\x01\x00\x00\x00n](K\x01G@\x04\x00\x00\x00\x00\x00\x00es.";
//! let pickle = Pickle::parse(bytes)?;
//! let numbers = pickle.root().get("n").unwrap();
//! assert_eq!(numbers.item(0).unwrap().int(), Some(1));
//! assert_eq!(numbers.item(1).unwrap().float(), Some(2.5));
//! # Ok::<(), robohive_dataset::pickle::PickleError>(())
//! ```

mod array;
mod input;
mod machine;
mod torch;
mod value;

pub use torch::LegacyStream;
pub use value::Value;

use std::fmt;
use std::ops::Range;

/// Most values that a pickle may build.
pub const MAX_VALUES: usize = 1 << 24;

/// What is wrong with a pickle, or with what it holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PickleError {
    /// The byte at which reading stopped, where the pickle itself is malformed.
    pub offset: Option<usize>,
    /// A sentence.
    pub message: String,
}

impl PickleError {
    fn at(offset: usize, message: impl Into<String>) -> Self {
        PickleError { offset: Some(offset), message: message.into() }
    }

    fn content(message: impl Into<String>) -> Self {
        PickleError { offset: None, message: message.into() }
    }
}

impl fmt::Display for PickleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.offset {
            Some(offset) => write!(f, "byte {offset} of the pickle: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl std::error::Error for PickleError {}

/// A value's place among all values of a pickle.
type Id = u32;

/// A value; bytes and text stand in the input.
#[derive(Clone, Debug)]
enum Node {
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
struct Object {
    callable: Id,
    arguments: Id,
    state: Option<Id>,
    /// Appended to it, if it is a list.
    items: Vec<Id>,
    /// Set in it, if it is a dictionary.
    entries: Vec<[Id; 2]>,
}

/// The values of a pickle.
#[derive(Clone, Debug)]
pub struct Pickle<'a> {
    input: &'a [u8],
    nodes: Vec<Node>,
    root: Id,
}

impl<'a> Pickle<'a> {
    /// Reads a pickle that fills all of `bytes`.
    ///
    /// # Errors
    /// The pickle is malformed, truncated or too large, or uses a protocol or opcode that is not supported.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, PickleError> {
        let (pickle, rest) = Self::parse_prefix(bytes)?;
        if rest.is_empty() {
            return Ok(pickle);
        }
        let end = bytes.len() - rest.len();
        Err(PickleError::at(end, format!("the pickle ends here, and {} more bytes follow", rest.len())))
    }

    /// Reads the pickle at the beginning of `bytes`, and returns what follows it.
    ///
    /// # Errors
    /// As [`Pickle::parse`], more bytes aside.
    pub fn parse_prefix(bytes: &'a [u8]) -> Result<(Self, &'a [u8]), PickleError> {
        machine::run(bytes)
    }

    /// The value that the pickle stands for.
    pub fn root(&self) -> Value<'_> {
        self.value(self.root)
    }

    /// Everything that refers to a value outside the pickle.
    pub fn persistent(&self) -> impl Iterator<Item = Value<'_>> {
        let references =
            self.nodes.iter().enumerate().filter(|(_, node)| matches!(node, Node::Persistent(_)));
        references.map(|(id, _)| self.value(id as Id))
    }

    fn value(&self, id: Id) -> Value<'_> {
        Value { pickle: self, id }
    }

    fn text(&self, range: &Range<usize>) -> &str {
        // Checked when it was read.
        std::str::from_utf8(&self.input[range.clone()]).unwrap_or_default()
    }
}
