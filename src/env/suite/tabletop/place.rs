//! Places on a table, drawn so that things do not stand in each other.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;

/// Least and greatest x and y \[m\].
pub type Area = [[f64; 2]; 2];

/// Whether two places that are `apart` \[m\] can be drawn in an area without many draws.
pub fn fits(area: &Area, apart: f64) -> bool {
    area.iter().any(|[low, high]| high - low > 1.5 * apart)
}

/// A place in an area.
///
/// # Errors
/// The area is none.
pub fn draw(rng: &mut Rng, [x, y]: &Area) -> Result<[f64; 2], EnvError> {
    Ok([rng.uniform(x[0], x[1])?, rng.uniform(y[0], y[1])?])
}

/// Two places in an area, at least `apart` \[m\] from each other. [`fits`] says whether there are such.
///
/// # Errors
/// The area is none.
pub fn apart(rng: &mut Rng, area: &Area, apart: f64) -> Result<[[f64; 2]; 2], EnvError> {
    loop {
        let [a, b] = [draw(rng, area)?, draw(rng, area)?];
        if norm(&[a[0] - b[0], a[1] - b[1]]) > apart {
            return Ok([a, b]);
        }
    }
}
