//! Arms at a table with things on it.

pub mod drawer;
pub mod insert;
pub mod stack;
pub mod zip;
