//! The relief of a patch of ground: an image of heights, or the hills that make one.

use super::terrain::PATCH;
use crate::assets::{Assets, own_file};
use dataset::Array;
use physics::math::ops;
use serde::Deserialize;

/// A file of hills: for each its place on the patch, its radius, all as shares of the patch's side, and its height over that of others.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Hills {
    hills: Vec<[f64; 4]>,
}

/// Heights of a patch, row by row: of a numpy array, or of the hills in a TOML file.
///
/// # Errors
/// The file is missing or holds neither; a hill has no extent.
pub(super) fn image(path: &str, assets: &dyn Assets) -> Result<Vec<f64>, String> {
    let bytes = own_file(path).map_or_else(|| assets.read(path), Ok)?;
    let wrong = |message: String| format!("{path}: {message}");
    if !path.ends_with(".toml") {
        return Ok(Array::decode(&bytes).map_err(|error| wrong(error.to_string()))?.values.to_f64());
    }
    let text = str::from_utf8(&bytes).map_err(|error| wrong(error.to_string()))?;
    let hills: Hills = toml::from_str(text).map_err(|error| wrong(error.to_string()))?;
    shape(&hills.hills).map_err(wrong)
}

/// The sum of all hills, each a bell.
fn shape(hills: &[[f64; 4]]) -> Result<Vec<f64>, String> {
    let proper = |hill: &[f64; 4]| hill.iter().all(|number| number.is_finite()) && hill[2] > 0.0;
    if let Some(hill) = hills.iter().find(|hill| !proper(hill)) {
        return Err(format!("a hill is x, y, a radius above 0 and a height, and not {hill:?}"));
    }
    let at = |sample: usize| sample as f64 / (PATCH - 1) as f64;
    let height = |sample: usize| {
        let (x, y) = (at(sample % PATCH), at(sample / PATCH));
        let bell = |[along, aside, radius, height]: &[f64; 4]| {
            let far = ((x - along) * (x - along) + (y - aside) * (y - aside)) / (radius * radius);
            height * ops::exp(-0.5 * far)
        };
        hills.iter().map(bell).sum()
    };
    Ok((0..PATCH * PATCH).map(height).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assets::OwnModels;

    #[test]
    fn our_relief_has_hills_and_hollows() {
        let heights = image("hive/myolegs/tasks/relief.toml", &OwnModels).unwrap();
        let range = heights.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
            [low.min(*height), high.max(*height)]
        });
        assert_eq!(heights.len(), PATCH * PATCH);
        assert!(range[1] - range[0] > 0.5, "{range:?}");
    }

    #[test]
    fn a_hill_is_highest_in_its_middle() {
        let heights = shape(&[[0.5, 0.25, 0.1, 2.0]]).unwrap();
        assert_eq!(heights[PATCH / 2 + PATCH * (PATCH / 4)], 2.0);
        assert!(heights[0] < 0.1);
    }

    #[test]
    fn hills_without_extent_are_refused() {
        assert!(shape(&[[0.5, 0.5, 0.0, 1.0]]).unwrap_err().contains("a radius above 0"));
        assert!(image("hive/myolegs/tasks/none.toml", &OwnModels).is_err());
    }
}
