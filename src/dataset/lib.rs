//! Array files. Numpy archives (`.npz`) carry states, trajectories and compiled models in and out; recordings of episodes
//! (feature `hdf5`) are HDF5 files in the layouts of RoboHive and RoboSet; pickles of
//! arrays and models are read without being executed.
//!
//! ```
//! use robohive_dataset::Array;
//!
//! let array = Array::f64(vec![2, 2], vec![1.0, 0.0, 0.0, 1.0]);
//! assert_eq!(Array::decode(&array.encode())?.shape, [2, 2]);
//! # Ok::<(), robohive_dataset::NpyError>(())
//! ```

mod expansion;
pub mod growing;
pub mod half;
#[cfg(feature = "hdf5")]
mod hdf5;
pub mod npy;
pub mod npz;
pub mod pickle;
#[cfg(feature = "hdf5")]
pub mod trace;

pub use growing::GrowingNpz;
pub use half::F16;
pub use npy::{Array, Dtype, NpyError, Scalar, Values};
pub use npz::{NpzError, NpzReader, NpzWriter};
