//! Small fixed-size algebra: vectors, quaternions, rotations, spatial vectors. Arrays by value, no allocation.
//!
//! ```
//! use robohive_physics::math::{distance, quat_from_axis_angle, quat_to_mat, mul_mat_vec};
//!
//! let quarter = quat_from_axis_angle([0.0, 0.0, 1.0], std::f64::consts::FRAC_PI_2);
//! let turned = mul_mat_vec(&quat_to_mat(quarter), [1.0, 0.0, 0.0]);
//! assert!(distance(turned, [0.0, 1.0, 0.0]) < 1e-15);
//! ```

#[cfg_attr(system_math, allow(dead_code))]
mod arc;
pub(crate) mod bit_set;
pub(crate) mod cholesky;
#[doc(hidden)]
pub mod dense;
#[cfg_attr(system_math, allow(dead_code))]
mod double_double;
mod eigen;
mod legible;
pub mod ops;
mod polynomial;
mod quat;
#[cfg_attr(system_math, allow(dead_code))]
mod sine;
mod sparse;
mod spatial;
mod symmetric;
mod vector;

pub use eigen::{principal_axes, principal_axes_by};
pub use legible::Legible;
pub use polynomial::Polynomial;
pub use quat::*;
pub use sparse::*;
pub use spatial::*;
pub use symmetric::diagonalize;
pub use vector::*;

/// Smallest value a denominator may take (documentation: `mjMINVAL`).
pub const MINVAL: f64 = 1e-15;

/// A vector in space.
pub type Vec3 = [f64; 3];
/// A quaternion, w-x-y-z.
pub type Quat = [f64; 4];
/// A 3x3 matrix, row-major.
pub type Mat3 = [f64; 9];
/// A motion or force vector, rotation first.
pub type Spatial = [f64; 6];
