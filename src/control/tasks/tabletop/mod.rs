//! Arms at a table with things on it.

pub mod stack;
