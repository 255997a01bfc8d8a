//! Array files. Numpy archives (`.npz`) carry states, trajectories and compiled models in and out.

pub mod growing;
pub mod npy;
pub mod npz;

pub use growing::GrowingNpz;
pub use npy::{Array, Dtype, Values};
pub use npz::{NpzError, NpzReader, NpzWriter};
