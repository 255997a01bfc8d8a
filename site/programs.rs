//! The programs in Rust of the pages, which are compiled and run as tests of documentation.

/// The programs of the first steps.
#[cfg(doctest)]
#[doc = include_str!("pages/first_steps.md")]
pub struct FirstSteps;

/// The programs of the page about programs in Rust.
#[cfg(doctest)]
#[doc = include_str!("pages/rust.md")]
pub struct Rust;

/// The programs of the page about edits of models.
#[cfg(doctest)]
#[doc = include_str!("pages/models/edit.md")]
pub struct Edit;
