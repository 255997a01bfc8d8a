//! Values that many elements have: lengths, limits that may be left to the range, user data.

use crate::spec::Limited;
use physics::math::Legible;

/// Largest length a file may ask for without giving the data.
const MAX_LENGTH: i64 = 1 << 24;

/// A length from the file: not negative, and not a way to use up the memory.
pub(super) fn bounded(length: i64, what: &str) -> Result<usize, String> {
    match length {
        0..=MAX_LENGTH => Ok(length as usize),
        _ => Err(format!("{what} must be between 0 and {MAX_LENGTH}, is {length}")),
    }
}

/// Whether limits are active; an error when `autolimits` is off and the file leaves it open.
pub(super) fn resolve_limited(
    limited: Limited,
    range: [f64; 2],
    autolimits: bool,
    which: &str,
) -> Result<bool, String> {
    match limited {
        Limited::False => Ok(false),
        Limited::True => Ok(true),
        Limited::Auto if !autolimits && range != [0.0, 0.0] => Err(format!(
            "`{which}range` without `{which}limited`: set it, or turn on `autolimits` of the compiler"
        )),
        Limited::Auto => Ok(range[0] < range[1]),
    }
}

/// What is wrong with a range that ends where it begins, or below.
pub(super) fn rising(attribute: &str, [low, high]: [f64; 2]) -> String {
    let (low, high) = (Legible(low), Legible(high));
    format!("attribute '{attribute}' goes from {low} to {high}: set the second number above the first")
}

/// Appends user data padded to the width of the model.
pub(super) fn push_user(
    array: &mut Vec<f64>,
    values: &[f64],
    width: usize,
    size: &str,
) -> Result<(), String> {
    if values.len() > width {
        return Err(format!("user has {} values, {size} is {width}", values.len()));
    }
    array.extend_from_slice(values);
    array.resize(array.len() + width - values.len(), 0.0);
    Ok(())
}
