//! One environment, as Python holds it.

mod class;
mod team;

pub use class::PyEnv;
