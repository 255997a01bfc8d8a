//! Transcendental functions with the same bits on every target.

pub use libm::{acos, asin, atan, atan2, cos, exp, log, pow, sin, tan, tanh};

/// Square root; IEEE 754 fixes its bits.
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// Sine and cosine of one angle.
pub fn sincos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}
