//! What arrays must satisfy, and the one that does not.

use crate::table::{Field, Slice};
use std::fmt;

/// An array that contradicts another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inconsistent {
    /// Name of the array.
    pub array: &'static str,
    /// Place in it, rows flattened.
    pub index: usize,
    /// What it should be.
    pub expected: &'static str,
}

impl fmt::Display for Inconsistent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}] is not {}", self.array, self.index, self.expected)
    }
}

impl std::error::Error for Inconsistent {}

/// Refuses unless `holds`.
pub(super) fn require(
    holds: bool,
    array: &'static str,
    index: usize,
    expected: &'static str,
) -> Result<(), Inconsistent> {
    if holds { Ok(()) } else { Err(Inconsistent { array, index, expected }) }
}

/// Every value is at least `least` and below `end`.
pub(super) fn within(
    array: &'static str,
    field: &impl Field,
    least: i32,
    end: usize,
) -> Result<(), Inconsistent> {
    let Slice::I32(values) = field.scalars() else { return Ok(()) };
    match values.iter().position(|&x| x < least || (x >= 0 && x as usize >= end)) {
        Some(index) => Err(Inconsistent { array, index, expected: "a reference to an element" }),
        None => Ok(()),
    }
}

/// Every range of `count` items from `first` lies in an array of `total`. An empty range may begin at -1.
pub(super) fn spans(
    array: &'static str,
    first: &[i32],
    count: impl Fn(usize) -> i64,
    total: usize,
) -> Result<(), Inconsistent> {
    for (index, &first) in first.iter().enumerate() {
        let count = count(index);
        let fits = first >= 0 && count >= 0 && count <= total as i64 - i64::from(first);
        require(fits || (first == -1 && count == 0), array, index, "the address of a range in its array")?;
    }
    Ok(())
}

/// [`within`] for fields by name.
macro_rules! references {
    ($m:ident: $($field:ident $least:literal $end:expr;)*) => {
        $(within(stringify!($field), &$m.$field, $least, $end)?;)*
    };
}

/// [`spans`] for fields by name.
macro_rules! ranges {
    ($m:ident: $($first:ident $count:ident $total:expr;)*) => {
        $(spans(stringify!($first), &$m.$first, |i| i64::from($m.$count[i]), $total)?;)*
    };
}

pub(super) use {ranges, references};
