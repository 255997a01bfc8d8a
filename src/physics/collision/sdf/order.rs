//! The larger and the smaller of two numbers, with MuJoCo's choice among equal ones.

/// The larger number; the first of equal ones.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a >= b { a } else { b }
}

/// The smaller number; the first of equal ones.
pub(super) fn smaller(a: f64, b: f64) -> f64 {
    if a <= b { a } else { b }
}
