//! Models and environments that a command line names.

pub mod actor;
pub mod library;
pub mod loading;
pub mod policy;
pub mod solver;
pub mod source;
