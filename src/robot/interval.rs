//! Intervals of numbers as RoboHive computes with them.

/// The nearest number of the interval. A number that is no number stays, and of zeros the sign is numpy's.
pub(crate) fn clip(x: f64, [low, high]: [f64; 2]) -> f64 {
    let x = if x > low || x.is_nan() { x } else { low };
    if x < high || x.is_nan() { x } else { high }
}

/// -1 to 1 stretched over the interval.
pub(crate) fn stretch(x: f64, [low, high]: [f64; 2]) -> f64 {
    (high + low) / 2.0 + x * (high - low) / 2.0
}

/// The interval's middle and half its width.
pub(crate) fn middle_and_half([low, high]: [f64; 2]) -> (f64, f64) {
    ((high + low) / 2.0, (high - low) / 2.0)
}
