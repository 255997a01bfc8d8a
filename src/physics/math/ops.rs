//! Transcendental functions with the same bits on every target.
//!
//! Compiled with `--cfg system_math` they come from the C library of the system instead: for comparison with a MuJoCo
//! that uses the same library, not for simulation. No feature does that, since features must not change results.
//!
//! ```
//! use robohive_physics::math::ops;
//!
//! assert_eq!(ops::sin(1.0).to_bits(), 0x3fea_ed54_8f09_0cee);
//! ```

#[cfg(not(system_math))]
pub use portable::*;
#[cfg(system_math)]
pub use system::*;

/// Square root; IEEE 754 fixes its bits.
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// Third power of a number below 1e100, within a hair of correctly rounded.
pub fn cube(x: f64) -> f64 {
    let x = super::double_double::Double { head: x, tail: 0.0 };
    x.times(x).times(x).round()
}

/// Sine and cosine are correctly rounded but for six calls in a million, `angle`, `arc_cosine` and `tangent` in nearly all,
/// the others within one unit of the last place.
#[cfg(not(system_math))]
mod portable {
    pub use crate::math::arc::{angle, arc_cosine, tangent};
    pub use crate::math::sine::sincos;
    pub use libm::{acos, asin, atan, atan2, atan2f as atan2_single, exp, log, pow, tan, tanh};

    /// Sine.
    pub fn sin(x: f64) -> f64 {
        sincos(x).0
    }

    /// Cosine.
    pub fn cos(x: f64) -> f64 {
        sincos(x).1
    }
}

#[cfg(system_math)]
#[allow(missing_docs)]
mod system {
    macro_rules! forward {
        ($($name:ident($($x:ident),+) = $method:ident),*) => {
            $(pub fn $name($($x: f64),+) -> f64 { f64::$method($($x),+) })*
        };
    }
    forward!(acos(x) = acos, asin(x) = asin, atan(x) = atan, atan2(y, x) = atan2, cos(x) = cos, exp(x) = exp);
    forward!(log(x) = ln, pow(x, y) = powf, sin(x) = sin, tan(x) = tan, tanh(x) = tanh);

    pub fn angle(y: f64, x: f64) -> f64 {
        y.atan2(x)
    }

    pub fn arc_cosine(x: f64) -> f64 {
        x.acos()
    }

    pub fn tangent(x: f64) -> f64 {
        x.tan()
    }

    pub fn atan2_single(y: f32, x: f32) -> f32 {
        y.atan2(x)
    }

    pub fn sincos(x: f64) -> (f64, f64) {
        (x.sin(), x.cos())
    }
}
