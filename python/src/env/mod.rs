//! One environment, as Python holds it.

mod class;
mod live;

pub use class::PyEnv;
