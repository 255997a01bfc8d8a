//! Angles of directions, arc cosine and tangent, correctly rounded in nearly all calls (counted by `examples/sines.rs`): a
//! result near by is corrected by the sine and cosine of the angle, which are known with some fifteen bits more than an f64
//! has.

use super::double_double::Double;
use super::sine::{LARGEST, precise_sincos};

/// A number as a sum.
const fn exact(value: f64) -> Double {
    Double { head: value, tail: 0.0 }
}

/// Angle of the direction `(x, y)`, like `atan2`.
pub fn angle(y: f64, x: f64) -> f64 {
    corrected(libm::atan2(y, x), exact(y), x)
}

/// Angle between zero and π of the cosine `x`.
pub fn arc_cosine(x: f64) -> f64 {
    let sine = exact(1.0).plus(exact(-x)).times(exact(1.0).plus(exact(x))).sqrt();
    corrected(libm::acos(x), sine, x)
}

/// Sine by cosine.
pub fn tangent(x: f64) -> f64 {
    if x.is_nan() || x.abs() > LARGEST {
        return libm::tan(x);
    }
    let [sine, cosine] = precise_sincos(x).map(|value| exact(0.0).plus(value));
    let near = sine.head / cosine.head;
    let rest = sine.plus(cosine.times(exact(near)).negated());
    near + rest.round() / cosine.head
}

/// The angle of the direction `(x, y)`, from one within a few units of the last place: how far the direction is from
/// that, its sine and cosine tell.
fn corrected(near: f64, y: Double, x: f64) -> f64 {
    let [sine, cosine] = precise_sincos(near).map(|value| exact(0.0).plus(value));
    let across = y.times(cosine).plus(exact(x).times(sine).negated());
    let correction = across.round() / (x * cosine.head + y.head * sine.head);
    // Neither the origin nor what overflows has a correction.
    if correction.is_finite() { near + correction } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANGLES: [(f64, f64, f64); 6] = [
        (0.926382097656547, -0.3765849295198305, 1.9569033885741183),
        (0.7251141180144316, -0.6886287213412994, 2.3303925559899983),
        (0.5999338227741013, -0.8000496286429069, 2.498174263763066),
        (0.17981439312709627, -0.9837005560760521, 2.960794887887597),
        (0.729186712346657, -0.6843147949131845, 2.3244599268045247),
        (0.24160859833971193, -0.9703737863361312, 2.8975694337463045),
    ];

    /// Values computed with 300 bits and rounded.
    #[test]
    fn angles_are_correctly_rounded() {
        for (y, x, expected) in ANGLES {
            assert_eq!(angle(y, x), expected, "{y} {x}");
        }
    }

    /// Values computed with 60 digits and rounded, that lie almost in the middle between two numbers.
    #[test]
    fn hard_values_are_correctly_rounded() {
        for (x, expected) in [
            (-0.15987857737802336, 1.7313639736491724),
            (0.6535794044873089, 0.8584921955272039),
            (-0.6684040306783756, 2.3028573384328594),
            (0.9994396436120281, 0.03347861194873474),
            (0.9999999990686774, 4.315837287850502e-05),
            (-0.9999999, 3.141145439990684),
        ] {
            assert_eq!(arc_cosine(x), expected, "{x}");
        }
        for (x, expected) in [
            (0.31379569603807633, 0.32451779133718134),
            (0.6751952934349212, 0.8007454069791884),
            (0.7050917580323182, 0.8510300509829203),
            (1.3148484161914205, 3.821354073212533),
        ] {
            assert_eq!([tangent(x), tangent(-x)], [expected, -expected], "{x}");
        }
    }

    #[test]
    fn ends_of_the_domains() {
        use std::f64::consts::{FRAC_PI_2, PI};
        assert_eq!([arc_cosine(1.0), arc_cosine(0.0), arc_cosine(-1.0)], [0.0, FRAC_PI_2, PI]);
        assert!(arc_cosine(1.0 + f64::EPSILON).is_nan() && tangent(f64::INFINITY).is_nan());
        assert_eq!([angle(0.0, 0.0), angle(0.0, -1.0), angle(-1e-300, 0.0)], [0.0, PI, -FRAC_PI_2]);
        assert_eq!((tangent(0.0), angle(f64::INFINITY, 1.0)), (0.0, FRAC_PI_2));
        assert!((tangent(3.0e4) / 3.0e4_f64.tan() - 1.0).abs() < 1e-15);
    }
}
