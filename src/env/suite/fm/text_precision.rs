//! Frames as the original has them after it wrote the assembled model as text and read that.

use crate::error::EnvError;
use crate::scene::Scene;
use physics::math::ops;

/// Digits that the text keeps after the first one.
const DIGITS: usize = 5;

/// Rounds the frames of bodies and sites and the axes of joints to the digits that the original's text of a model keeps.
///
/// # Errors
/// The model or physics refuses the rounded numbers.
pub fn round_frames(scene: &mut Scene) -> Result<(), EnvError> {
    scene.overwrite(|m| {
        for place in [&mut m.body_pos[..], &mut m.site_pos[..], &mut m.jnt_pos[..]] {
            place.iter_mut().for_each(|pos| *pos = pos.map(round));
        }
        for turns in [&mut m.body_quat[..], &mut m.site_quat[..]] {
            turns.iter_mut().for_each(|quat| *quat = unit(quat.map(round)));
        }
        m.jnt_axis.iter_mut().for_each(|axis| *axis = unit(axis.map(round)));
    })?;
    Ok(scene.forward()?)
}

fn round(value: f64) -> f64 {
    format!("{value:.DIGITS$e}").parse().unwrap_or(value)
}

fn unit<const N: usize>(values: [f64; N]) -> [f64; N] {
    let norm = ops::sqrt(values.iter().map(|x| x * x).sum());
    values.map(|x| x / norm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_are_kept() {
        assert_eq!(round(0.030_601_123_456), 0.030_601_1);
        assert_eq!(round(-1234.5678), -1234.57);
        assert_eq!(round(0.0), 0.0);
    }

    #[test]
    fn rounded_turns_are_of_unit_length() {
        let quat = unit([0.8, 0.0, -0.8, 0.0]);
        assert!((quat.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-15);
        assert_eq!(quat[0], -quat[2]);
    }
}
