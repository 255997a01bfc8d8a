//! Comparison of two arrays: the worst component, where it stands and how far apart it is.

use crate::tolerance::{COMPILE_ABSOLUTE, COMPILE_RELATIVE, NOISE_FLOOR};
use std::fmt;

/// The worst component of one compared field.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// Name of the field.
    pub field: String,
    /// Flat index of the component; 0 for a difference in length.
    pub index: usize,
    /// Our value, or our length.
    pub ours: f64,
    /// MuJoCo's value, or its length.
    pub theirs: f64,
    /// Error in the measure of the comparison; infinite for lengths and non-finite values.
    pub error: f64,
}

impl fmt::Display for Worst {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}] {:e} (MuJoCo {:e})", self.field, self.index, self.ours, self.theirs)
    }
}

/// How one component is judged; `scale` is the largest magnitude of MuJoCo's field, or the component's own scale.
type Measure = fn(ours: f64, theirs: f64, scale: f64) -> f64;

/// Relative error, floored at a share of the field's largest component.
pub fn relative(ours: f64, theirs: f64, scale: f64) -> f64 {
    let difference = (ours - theirs).abs();
    if difference == 0.0 { 0.0 } else { difference / theirs.abs().max(NOISE_FLOOR * scale) }
}

/// Error in units of the field's largest component.
pub fn of_largest(ours: f64, theirs: f64, scale: f64) -> f64 {
    let difference = (ours - theirs).abs();
    if difference == 0.0 { 0.0 } else { difference / scale }
}

/// Plain difference.
pub fn absolute(ours: f64, theirs: f64, _scale: f64) -> f64 {
    (ours - theirs).abs()
}

/// Error of a compiled number as a multiple of what is allowed: above one it counts as a difference.
pub fn compiled(ours: f64, theirs: f64, _scale: f64) -> f64 {
    (ours - theirs).abs() / COMPILE_ABSOLUTE.max(COMPILE_RELATIVE * theirs.abs())
}

/// Zero for equal values, infinite for others.
pub fn exact(ours: f64, theirs: f64, _scale: f64) -> f64 {
    if ours == theirs { 0.0 } else { f64::INFINITY }
}

/// Compares two fields number by number; `measure` is given the field's largest magnitude as scale.
pub fn compare(field: &str, ours: &[f64], theirs: &[f64], measure: Measure) -> Worst {
    let scale = theirs.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
    compare_scaled(field, ours, theirs, measure, |_| scale)
}

/// Compares two fields component by component, each measured against its own scale.
pub fn compare_scaled(
    field: &str,
    ours: &[f64],
    theirs: &[f64],
    measure: Measure,
    scale: impl Fn(usize) -> f64,
) -> Worst {
    let worst = |index, ours, theirs, error| Worst { field: field.to_owned(), index, ours, theirs, error };
    if ours.len() != theirs.len() {
        return worst(0, ours.len() as f64, theirs.len() as f64, f64::INFINITY);
    }
    let mut result = worst(0, 0.0, 0.0, 0.0);
    for (index, (&a, &b)) in ours.iter().zip(theirs).enumerate() {
        let error =
            if a.is_finite() && b.is_finite() { measure(a, b, scale(index)) } else { exact(a, b, 0.0) };
        if error > result.error || index == 0 {
            result = worst(index, a, b, error);
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_component_is_found_and_lengths_count() {
        let w = compare("x", &[1.0, 2.0, 3.0], &[1.0, 2.5, 3.0], absolute);
        assert_eq!((w.index, w.error), (1, 0.5));
        assert_eq!(compare("x", &[1.0], &[1.0, 2.0], absolute).error, f64::INFINITY);
        assert_eq!(compare("x", &[f64::NAN], &[1.0], absolute).error, f64::INFINITY);
    }

    #[test]
    fn small_components_are_measured_against_the_field() {
        assert_eq!(relative(1e-9, 0.0, 1.0), 1e-6);
        assert!(relative(1.0 + 1e-9, 1.0, 1.0) < 1.1e-9);
        assert!(compiled(1.0 + 2e-9, 1.0, 1.0) > 1.0 && compiled(1e-13, 0.0, 1.0) < 1.0);
    }
}
