//! Arms at a table with things on it.

pub mod insert;
pub mod stack;
pub mod zip;
