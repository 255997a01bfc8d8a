//! Real numbers in an interval.

use crate::{BitGenerator, RandomError};

/// An interval of finite length.
#[derive(Clone, Copy)]
pub(crate) struct Interval {
    low: f64,
    length: f64,
}

impl Interval {
    /// The interval from `low` to `high`, in either order.
    pub fn between(low: f64, high: f64) -> Result<Self, RandomError> {
        let length = high - low;
        if length.is_finite() {
            Ok(Interval { low, length })
        } else {
            Err(RandomError::UnboundedInterval { low, high })
        }
    }

    /// The interval from `low` up to `high`.
    pub fn upward(low: f64, high: f64) -> Result<Self, RandomError> {
        let interval = Interval::between(low, high)?;
        if interval.length.is_sign_negative() {
            Err(RandomError::ReversedInterval { low, high })
        } else {
            Ok(interval)
        }
    }

    #[inline]
    pub fn draw(self, source: &mut impl BitGenerator) -> f64 {
        self.low + self.length * source.next_f64()
    }
}

/// Fills `out`, each number within its own interval, which `interval` makes of two ends. All are made before
/// the first draw.
pub(crate) fn fill_each(
    source: &mut impl BitGenerator,
    interval: impl Fn(f64, f64) -> Result<Interval, RandomError>,
    [low, high]: [&[f64]; 2],
    out: &mut [f64],
) -> Result<(), RandomError> {
    if let Some(found) = [low.len(), high.len()].into_iter().find(|&length| length != out.len()) {
        return Err(RandomError::LengthMismatch { expected: out.len(), found });
    }
    let ends = || low.iter().zip(high);
    ends().try_for_each(|(&low, &high)| interval(low, high).map(drop))?;
    for (slot, (&low, &high)) in out.iter_mut().zip(ends()) {
        *slot = interval(low, high)?.draw(source);
    }
    Ok(())
}
