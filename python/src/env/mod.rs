//! One environment, as Python holds it.

mod class;

pub use class::PyEnv;
