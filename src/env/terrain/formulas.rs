//! What grounds consist of, those of RoboHive's tasks among them: noise, waves, steps.

use crate::draws::Rng;
use physics::math::ops;
use random::RandomError;
use std::f64::consts::FRAC_PI_2;

/// Moves and scales values to the range from 0 to 1.
pub(crate) fn normalize(values: &mut [f64]) {
    let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    values.iter_mut().for_each(|value| *value = (*value - lowest) / (highest - lowest));
}

/// Independent draws from `-spread` to `spread`, normalized. The spread decides the last bits alone.
///
/// # Errors
/// A spread that cannot be drawn from.
pub(crate) fn noise(values: &mut [f64], spread: f64, rng: &mut Rng) -> Result<(), RandomError> {
    rng.fill_uniform(-spread, spread, values)?;
    normalize(values);
    Ok(())
}

/// A wave that has its crest, 1, at the angle 0 \[rad\].
pub(crate) fn crest(angle: f64) -> f64 {
    ops::sin(angle + FRAC_PI_2)
}

/// The wave from 0 to 1.
pub(crate) fn hill(angle: f64) -> f64 {
    (1.0 + crest(angle)) / 2.0
}

/// From 0 to 1 with level ends, for `t` from 0 to 1; constant beyond.
pub(crate) fn ramp(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
