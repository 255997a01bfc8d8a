//! Modes of a finite element, which strain constraints hold: eigenvectors of its stiffness, scaled by the root of their
//! eigenvalues, and the twist of a square of the surface.

use super::elasticity::Material;
use crate::vector::sub;
use physics::math::{Vec3, diagonalize};

/// Root of the sum of squares off the diagonal at which eigenvalues count as found.
const TOLERANCE: f64 = 1e-12;
/// Eigenvalues below this share of the largest are motions of the whole.
const LEAST: f64 = 1e-8;

/// The number of modes, then the modes, in place of a stiffness matrix of the same size.
///
/// With eigenvalues `λ` and eigenvectors `u` of the stiffness `K`, the energy `½ xᵀ K x` of a displacement `x` is
/// `½ Σ (√λ u · x)²`, so that `√λ u · x` is what a constraint holds at zero. Rigid motions have `λ = 0` and are left out. One row
/// of the matrix is taken by the number, so there is room for all modes but one.
pub(super) fn pack(stiffness: &[f64], width: usize) -> (usize, Vec<f64>) {
    // Stiffness is stored negative, and so are its eigenvalues.
    let (mut diagonal, mut vectors) = (stiffness.to_vec(), vec![0.0; stiffness.len()]);
    diagonalize(&mut diagonal, &mut vectors, width, TOLERANCE);
    let values = || diagonal.iter().step_by(width + 1).map(|value| -value);
    let least = LEAST * values().fold(0.0, |most: f64, value| most.max(value.abs()));
    let strained = values().enumerate().filter(|&(_, value)| value > least).take(width - 1);
    let mut packed = vec![0.0];
    for (column, value) in strained {
        let scale = value.sqrt();
        packed.extend(vectors.iter().skip(column).step_by(width).map(|x| scale * x));
    }
    let count = (packed.len() - 1) / width;
    packed[0] = count as f64;
    packed.resize(stiffness.len(), 0.0);
    (count, packed)
}

/// Adds the twist of a square to its packed modes, as stiff as a bent plate; `x` are its nodes, `across` the axis across it.
pub(super) fn add_twist(
    (count, packed): (usize, &mut [f64]),
    x: &[Vec3],
    across: usize,
    material: Material,
    thickness: f64,
) {
    let Material { young, poisson } = material;
    let extent = |axis: usize| (x[x.len() - 1][axis] - x[0][axis]).abs();
    let [d0, d1] = [extent((across + 1) % 3), extent((across + 2) % 3)];
    if d0 < 1e-30 || d1 < 1e-30 {
        return;
    }
    let plate = young * thickness * thickness * thickness / (12.0 * (1.0 - poisson * poisson));
    let stiffness = plate * (1.0 - poisson) * 4.0 / (d0 * d1);
    let room = packed.get_mut(1 + count * 3 * x.len()..).and_then(|rest| rest.get_mut(..3 * x.len()));
    if let (true, Some(mode)) = (stiffness > 0.0, room) {
        let scale = stiffness.sqrt();
        mode.iter_mut().zip(twist(x, across)).for_each(|(to, from)| *to = from * scale);
        packed[0] = (count + 1) as f64;
    }
}

/// The displacement that lifts two opposite corners of a square, without any motion of the whole, of unit length.
fn twist(x: &[Vec3], across: usize) -> Vec<f64> {
    let side = x.len().isqrt();
    let mut mode = vec![0.0; 3 * x.len()];
    for i in 0..side {
        for j in 0..side {
            let [s, t] = [i, j].map(|k| k as f64 / (side - 1) as f64);
            mode[3 * (i * side + j) + across] = (1.0 - 2.0 * s) * (1.0 - 2.0 * t);
        }
    }
    for rigid in rigid_modes(x) {
        let share = product(&mode, &rigid);
        subtract(&mut mode, share, &rigid);
    }
    normalize(&mut mode);
    mode
}

/// Orthonormal translations and rotations.
fn rigid_modes(x: &[Vec3]) -> Vec<Vec<f64>> {
    let n = x.len();
    let mut centre = [0.0; 3];
    x.iter().for_each(|p| (0..3).for_each(|k| centre[k] += p[k]));
    centre = centre.map(|c| c / n as f64);
    let arms: Vec<Vec3> = x.iter().map(|&p| sub(p, centre)).collect();
    let mode = |of: &dyn Fn(Vec3) -> Vec3| -> Vec<f64> { arms.iter().flat_map(|&arm| of(arm)).collect() };
    let mut modes = vec![
        mode(&|_| [1.0, 0.0, 0.0]),
        mode(&|_| [0.0, 1.0, 0.0]),
        mode(&|_| [0.0, 0.0, 1.0]),
        mode(&|[_, y, z]| [0.0, -z, y]),
        mode(&|[x, _, z]| [z, 0.0, -x]),
        mode(&|[x, y, _]| [-y, x, 0.0]),
    ];
    for i in 0..modes.len() {
        let (before, rest) = modes.split_at_mut(i);
        for other in before {
            let share = product(&rest[0], other);
            subtract(&mut rest[0], share, other);
        }
        normalize(&mut rest[0]);
    }
    modes
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (x, y)| sum + x * y)
}

fn subtract(from: &mut [f64], share: f64, other: &[f64]) {
    from.iter_mut().zip(other).for_each(|(x, y)| *x -= share * y);
}

fn normalize(mode: &mut [f64]) {
    let squared = product(mode, mode);
    if squared > 1e-20 {
        let inverse = 1.0 / squared.sqrt();
        mode.iter_mut().for_each(|x| *x *= inverse);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_rebuild_the_matrix() {
        let matrix = [-2.0, 1.0, 0.0, 1.0, -2.0, 1.0, 0.0, 1.0, -2.0];
        let (count, packed) = pack(&matrix, 3);
        assert_eq!((count, packed[0]), (2, 2.0), "two modes have room");
    }

    #[test]
    fn a_square_twists_in_one_way() {
        let x = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]];
        let mode = twist(&x, 2);
        assert_eq!(mode, [0.0, 0.0, 0.5, 0.0, 0.0, -0.5, 0.0, 0.0, -0.5, 0.0, 0.0, 0.5]);
    }
}
