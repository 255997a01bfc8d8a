//! Models and environments that a command line names.

pub mod library;
pub mod loading;
pub mod source;
