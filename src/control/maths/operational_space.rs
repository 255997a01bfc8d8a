//! Forces at a point of a robot as torques of its joints, with the freedom that is left used for another wish (Khatib, A unified approach
//! for motion and force control of robot manipulators: the operational space formulation, IEEE Journal on Robotics and Automation 3,
//! 1987).

use super::NoSolution;
use nalgebra::{DMatrix, DVector};

/// Smallest inertia of a direction that counts as movable, as a share of the largest mobility.
const MOVABLE: f64 = 1e-9;

/// The torques by which a point accelerates as asked, while the joints accelerate as wished as far as that does not move the point.
///
/// `inertia` is the joint-space inertia (nv x nv), `jacobian` that of the coordinates of the point (k x nv), `acceleration` what they are
/// to do beyond what velocities bring about (k), `wish` accelerations of the joints (nv), `bias` the forces of gravity and velocities (nv).
///
/// # Errors
/// Shapes that do not fit; an inertia that is not positive; coordinates that cannot be moved one by one.
pub fn operational_torques(
    inertia: &DMatrix<f64>,
    jacobian: &DMatrix<f64>,
    acceleration: &DVector<f64>,
    wish: &DVector<f64>,
    bias: &DVector<f64>,
) -> Result<DVector<f64>, NoSolution> {
    let wrong = |message: &str| NoSolution::new("operational space", message);
    let (k, n) = jacobian.shape();
    if inertia.shape() != (n, n) || acceleration.len() != k || wish.len() != n || bias.len() != n {
        return Err(wrong("inertia, Jacobian, accelerations and bias have lengths that differ"));
    }
    let factor = inertia.clone().cholesky().ok_or_else(|| wrong("the inertia is not positive"))?;
    // How each coordinate accelerates under a force at each.
    let mobility = jacobian * factor.solve(&jacobian.transpose());
    let most = mobility.diagonal().max();
    let damped = &mobility + DMatrix::identity(k, k) * (MOVABLE * most);
    let apparent = damped.try_inverse().ok_or_else(|| wrong("the point cannot be moved"))?;
    // What the wish does at the point is taken back by the force there.
    let force = apparent * (acceleration - jacobian * wish);
    Ok(jacobian.transpose() * force + inertia * wish + bias)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three joints, two coordinates: the point accelerates as asked whatever is wished, and the wish is met where it does not matter.
    #[test]
    fn the_point_does_what_is_asked_and_the_rest_what_is_wished() {
        let inertia = dmatrix![3.0, 1.0, 0.5; 1.0, 2.0, 0.4; 0.5, 0.4, 1.0];
        let jacobian = dmatrix![0.3, 0.8, 0.1; -0.5, 0.2, 0.4];
        let (asked, bias) = (DVector::from_vec(vec![1.0, -2.0]), DVector::from_vec(vec![0.1, 0.2, 0.3]));
        let free = nalgebra::Vector3::new(0.3, 0.8, 0.1).cross(&nalgebra::Vector3::new(-0.5, 0.2, 0.4));
        let along = |wish: &DVector<f64>| {
            let torques = operational_torques(&inertia, &jacobian, &asked, wish, &bias).unwrap();
            let joints = inertia.clone().cholesky().unwrap().solve(&(torques - &bias));
            assert!((&jacobian * &joints - &asked).norm() < 1e-6);
            joints
        };
        let rest = along(&DVector::zeros(3));
        let wish = DVector::from_column_slice(free.as_slice());
        assert!((along(&wish) - rest - &wish).norm() < 1e-6, "the wish moves the joints alone");
    }

    #[test]
    fn lengths_that_differ_are_refused() {
        let (one, two) = (DVector::zeros(1), DVector::zeros(2));
        let error = operational_torques(&DMatrix::identity(2, 2), &dmatrix![1.0, 0.0], &one, &one, &two);
        assert!(error.unwrap_err().to_string().contains("lengths that differ"));
    }
}
