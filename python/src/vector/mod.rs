//! Many environments of one id, as Python holds them.

mod arrays;
mod class;
mod infos;
mod state;

pub use class::PyVecEnv;
