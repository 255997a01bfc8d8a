//! Array files. Numpy archives (`.npz`) carry states, trajectories and compiled models in and out.

pub mod npy;
pub mod npz;

pub use npy::{Array, Values};
pub use npz::{NpzError, NpzReader, NpzWriter};
