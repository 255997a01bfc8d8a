//! Which muscles pull: the activations that make given torques with the least sum of squares (Crowninshield and Brand, A physiologically
//! based criterion of muscle force prediction in locomotion, Journal of Biomechanics 14, 1981, with squares for their cubes).

use super::NoSolution;
use super::box_program::{Convex, least};
use nalgebra::{DMatrix, DVector};

/// Weight of the squared torques that are missed, over that of the squared activations, once `strength` is scaled to one.
const EXACTNESS: f64 = 1e4;

/// Activations, within `bounds`, of muscles whose full activations make the torques `strength` (joints by muscles), so that they make
/// `torques` (joints) as nearly as they can, and pull as little as that allows. Those of muscles are 0 to 1; motors may push too.
///
/// # Errors
/// Lengths that differ, or muscles without any strength.
pub fn activations(
    strength: &DMatrix<f64>,
    torques: &DVector<f64>,
    bounds: &[[f64; 2]],
) -> Result<DVector<f64>, NoSolution> {
    activations_to(EXACTNESS, strength, torques, bounds)
}

/// The same with another weight of the squared torques that are missed.
///
/// # Errors
/// As [`activations`].
pub fn activations_to(
    exactness: f64,
    strength: &DMatrix<f64>,
    torques: &DVector<f64>,
    bounds: &[[f64; 2]],
) -> Result<DVector<f64>, NoSolution> {
    let wrong = |message: &str| NoSolution::new("static optimisation", message);
    if strength.nrows() != torques.len() || strength.ncols() != bounds.len() {
        return Err(wrong("there is a torque for each joint, and a range for each muscle"));
    }
    let scale = strength.norm();
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(wrong("no muscle makes a torque"));
    }
    let missed = Missed { strength: strength / scale, torques: torques / scale, effort: 1.0 / exactness };
    least(&missed, bounds).ok_or_else(|| wrong("the muscles' strengths are not finite"))
}

/// Half the square of the torques that activations miss, and of the activations with the weight `effort`.
struct Missed {
    strength: DMatrix<f64>,
    torques: DVector<f64>,
    effort: f64,
}

impl Missed {
    fn rest(&self, x: &DVector<f64>) -> DVector<f64> {
        &self.torques - &self.strength * x
    }
}

impl Convex for Missed {
    fn value(&self, x: &DVector<f64>) -> f64 {
        0.5 * (self.rest(x).norm_squared() + self.effort * x.norm_squared())
    }

    fn slope(&self, x: &DVector<f64>) -> DVector<f64> {
        x * self.effort - self.strength.tr_mul(&self.rest(x))
    }

    /// There are more muscles than joints: the equations are as many as joints.
    fn target(&self, free: &[usize], x: &DVector<f64>) -> Option<DVector<f64>> {
        let strength = self.strength.select_columns(free);
        let left = self.rest(x) + &strength * x.select_rows(free);
        let mut square = &strength * strength.transpose();
        for joint in 0..square.nrows() {
            square[(joint, joint)] += self.effort;
        }
        Some(strength.tr_mul(&square.cholesky()?.solve(&left)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two equal muscles share a torque; the one that pulls the other way rests.
    #[test]
    fn equal_muscles_share_and_opponents_rest() {
        let found =
            activations(&dmatrix![2.0, 2.0, -2.0], &DVector::from_vec(vec![1.0]), &[[0.0, 1.0]; 3]).unwrap();
        assert!(
            (found[0] - 0.25).abs() < 1e-3 && (found[1] - 0.25).abs() < 1e-3 && found[2].abs() < 1e-12,
            "{found}"
        );
    }

    /// Of unequal ones each pulls in proportion to its arm, which makes the sum of squares least.
    #[test]
    fn stronger_muscles_pull_in_proportion() {
        let found =
            activations(&dmatrix![3.0, 1.0], &DVector::from_vec(vec![1.0]), &[[0.0, 1.0]; 2]).unwrap();
        assert!((found[0] / found[1] - 3.0).abs() < 1e-6 && (3.0 * found[0] + found[1] - 1.0).abs() < 1e-2);
    }

    #[test]
    fn what_cannot_be_made_is_approached_within_bounds() {
        let found =
            activations(&dmatrix![2.0, -1.0], &DVector::from_vec(vec![5.0]), &[[0.0, 1.0]; 2]).unwrap();
        assert!((found[0] - 1.0).abs() < 1e-9 && found[1].abs() < 1e-12);
        let error = activations(&dmatrix![0.0, 0.0], &DVector::from_vec(vec![5.0]), &[[0.0, 1.0]; 2])
            .unwrap_err()
            .to_string();
        assert_eq!(error, "static optimisation: no muscle makes a torque");
    }
}
