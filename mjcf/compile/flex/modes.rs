//! Modes of a finite element, which strain constraints hold: eigenvectors of its stiffness, scaled by the root of their
//! eigenvalues, and the twist of a square of the surface.

use super::elasticity::Material;
use crate::vector::sub;
use physics::math::Vec3;

/// Sweeps after which the iteration gives up.
const SWEEPS: usize = 200;
/// Size of the entries off the diagonal at which it ends.
const TOLERANCE: f64 = 1e-12;
/// Eigenvalues below this share of the largest are motions of the whole.
const LEAST: f64 = 1e-8;

/// The number of modes, then the modes, in place of a stiffness matrix of the same size.
pub(super) fn pack(matrix: &[f64], width: usize) -> (usize, Vec<f64>) {
    let (values, vectors) = eigen(matrix.to_vec(), width);
    let largest = values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut packed = vec![0.0; matrix.len()];
    let mut count = 0;
    for (column, value) in values.iter().enumerate() {
        // Stiffness is stored negative.
        let has_room = (count + 1) * width < packed.len();
        if -value > largest * LEAST && has_room {
            let scale = (-value).sqrt();
            let mode = &mut packed[1 + count * width..][..width];
            mode.iter_mut().enumerate().for_each(|(row, x)| *x = scale * vectors[row * width + column]);
            count += 1;
        }
    }
    packed[0] = count as f64;
    (count, packed)
}

/// Eigenvalues and, in columns, eigenvectors of a symmetric matrix, by Jacobi's rotations.
fn eigen(mut a: Vec<f64>, n: usize) -> (Vec<f64>, Vec<f64>) {
    let mut vectors: Vec<f64> = (0..n * n).map(|k| if k / n == k % n { 1.0 } else { 0.0 }).collect();
    for _ in 0..SWEEPS {
        let mut off = 0.0;
        for p in 0..n {
            off = a[p * n + p + 1..(p + 1) * n].iter().fold(off, |sum, x| sum + x * x);
        }
        if off < TOLERANCE * TOLERANCE {
            break;
        }
        for p in 0..n {
            for q in p + 1..n {
                if a[p * n + q].abs() >= TOLERANCE * 1e-3 {
                    rotate(&mut a, &mut vectors, n, [p, q]);
                }
            }
        }
    }
    ((0..n).map(|i| a[i * n + i]).collect(), vectors)
}

/// Makes entry `p`, `q` zero.
fn rotate(a: &mut [f64], vectors: &mut [f64], n: usize, [p, q]: [usize; 2]) {
    let entry = a[p * n + q];
    let tau = (a[q * n + q] - a[p * n + p]) / (2.0 * entry);
    let sign = if tau >= 0.0 { 1.0 } else { -1.0 };
    let t = sign / (tau.abs() + (1.0 + tau * tau).sqrt());
    let c = 1.0 / (1.0 + t * t).sqrt();
    let s = t * c;
    let turned = |x: f64, y: f64| (c * x - s * y, s * x + c * y);
    a[p * n + p] -= t * entry;
    a[q * n + q] += t * entry;
    (a[p * n + q], a[q * n + p]) = (0.0, 0.0);
    for r in (0..n).filter(|&r| r != p && r != q) {
        let (x, y) = turned(a[r * n + p], a[r * n + q]);
        (a[r * n + p], a[p * n + r]) = (x, x);
        (a[r * n + q], a[q * n + r]) = (y, y);
    }
    for row in vectors.chunks_exact_mut(n) {
        (row[p], row[q]) = turned(row[p], row[q]);
    }
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
