//! Places on a table, drawn so that things do not stand in each other.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;

/// Least and greatest x and y \[m\].
pub type Area = [[f64; 2]; 2];

/// Whether places of two areas that are `apart` \[m\] can be drawn without many draws.
pub fn fits([first, second]: [&Area; 2], apart: f64) -> bool {
    let farthest = |[[low, high], [least, most]]: [[f64; 2]; 2]| (high - least).max(most - low);
    first.iter().zip(second).any(|(a, b)| farthest([*a, *b]) > 1.5 * apart)
}

/// A place in an area.
///
/// # Errors
/// The area is none.
pub fn draw(rng: &mut Rng, [x, y]: &Area) -> Result<[f64; 2], EnvError> {
    Ok([rng.uniform(x[0], x[1])?, rng.uniform(y[0], y[1])?])
}

/// A place in each of two areas, at least `apart` \[m\] from each other. [`fits`] says whether there are such.
///
/// # Errors
/// An area is none.
pub fn apart(rng: &mut Rng, areas: [&Area; 2], apart: f64) -> Result<[[f64; 2]; 2], EnvError> {
    loop {
        let [a, b] = [draw(rng, areas[0])?, draw(rng, areas[1])?];
        if norm(&[a[0] - b[0], a[1] - b[1]]) > apart {
            return Ok([a, b]);
        }
    }
}
