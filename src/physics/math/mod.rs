//! Small fixed-size algebra: vectors, quaternions, rotations, spatial vectors. Arrays by value, no allocation.

pub mod bit_set;
pub mod cholesky;
pub mod dense;
#[cfg_attr(system_math, allow(dead_code))]
mod double_double;
mod eigen;
pub mod ops;
mod quat;
#[cfg_attr(system_math, allow(dead_code))]
mod sine;
mod sparse;
mod spatial;
mod vector;

pub use eigen::{principal_axes, principal_axes_by};
pub use quat::*;
pub use sparse::*;
pub use spatial::*;
pub use vector::*;

/// A vector in space.
pub type Vec3 = [f64; 3];
/// A quaternion, w-x-y-z.
pub type Quat = [f64; 4];
/// A 3x3 matrix, row-major.
pub type Mat3 = [f64; 9];
/// A motion or force vector, rotation first.
pub type Spatial = [f64; 6];
