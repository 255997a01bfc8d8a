//! Which muscles pull: the activations that make given torques with the least sum of squares (Crowninshield and Brand, A physiologically
//! based criterion of muscle force prediction in locomotion, Journal of Biomechanics 14, 1981, with squares for their cubes).

use super::NoSolution;
use super::box_program::minimise;
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
    let wrong = |message: &str| NoSolution::new("static optimisation", message);
    if strength.nrows() != torques.len() || strength.ncols() != bounds.len() {
        return Err(wrong("there is a torque for each joint, and a range for each muscle"));
    }
    let scale = strength.norm();
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(wrong("no muscle makes a torque"));
    }
    let (strength, torques) = (strength / scale, torques / scale);
    let muscles = strength.ncols();
    let curvature = DMatrix::identity(muscles, muscles) + strength.transpose() * &strength * EXACTNESS;
    let slope = -(strength.transpose() * torques * EXACTNESS);
    let found = minimise(&curvature, &slope, bounds);
    found.map(|(activations, _)| activations).ok_or_else(|| wrong("the muscles' strengths are not finite"))
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
