//! Eigenvalues and eigenvectors of symmetric matrices of any size, by cyclic Jacobi rotations (Golub and Van Loan, "Matrix
//! Computations", 4th edition, section 8.5).
//!
//! A rotation `J` in the plane of two axes `p` and `q` makes the entry `a_pq` of `Jᵀ A J` zero. With the tangent `t` of its
//! angle the condition is `t² + 2τt − 1 = 0`, where `τ = (a_qq − a_pp) / 2a_pq`; the smaller root, `±1 / (|τ| + √(1 + τ²))`,
//! turns by at most 45°, for which the method converges (8.5.2). Each rotation moves `2a_pq²` from the squares off the diagonal
//! onto it (8.5.1), and sweeps over all pairs, row by row, converge quadratically (8.5.3).

/// Sweeps after which rounding is all that is left; fewer than ten are usual.
const MAX_SWEEPS: usize = 200;

/// A rotation in the plane of two axes, which `of` finds for a matrix.
struct Rotation {
    axes: [usize; 2],
    tangent: f64,
    cosine: f64,
    sine: f64,
}

impl Rotation {
    /// The one that makes the entry `p`, `q` of `a` zero, which is not zero yet.
    fn of(a: &[f64], n: usize, [p, q]: [usize; 2]) -> Self {
        let tau = (a[q * n + q] - a[p * n + p]) / (2.0 * a[p * n + q]);
        let size = 1.0 / (tau.abs() + (1.0 + tau * tau).sqrt());
        let tangent = if tau < 0.0 { -size } else { size };
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        Rotation { axes: [p, q], tangent, cosine, sine: tangent * cosine }
    }

    /// Turns the two components of `row`.
    fn turn(&self, row: &mut [f64]) {
        let [p, q] = self.axes;
        let (x, y) = (row[p], row[q]);
        row[p] = self.cosine * x - self.sine * y;
        row[q] = self.sine * x + self.cosine * y;
    }

    /// `Jᵀ A J`. On the diagonal it is `a_pp − t a_pq` and `a_qq + t a_pq`; elsewhere rows and columns are equal, so
    /// rows are turned and then copied.
    fn apply(&self, a: &mut [f64], n: usize) {
        let [p, q] = self.axes;
        let moved = self.tangent * a[p * n + q];
        let diagonal = [a[p * n + p] - moved, a[q * n + q] + moved];
        for (k, row) in a.chunks_exact_mut(n).enumerate() {
            if k != p && k != q {
                self.turn(row);
            }
        }
        for k in 0..n {
            a[p * n + k] = a[k * n + p];
            a[q * n + k] = a[k * n + q];
        }
        (a[p * n + p], a[q * n + q]) = (diagonal[0], diagonal[1]);
        (a[p * n + q], a[q * n + p]) = (0.0, 0.0);
    }
}

/// Turns the symmetric `n` x `n` matrix `a` (row-major) into the diagonal matrix of its eigenvalues, in no order, and writes
/// their eigenvectors into the columns of `vectors`, of the same size.
///
/// It ends when the root of the sum of squares above the diagonal is below `tolerance`, or when no entry is above a
/// thousandth of it. Nothing is allocated.
///
/// ```
/// let mut a = [2.0, 1.0, 1.0, 2.0];
/// let mut vectors = [0.0; 4];
/// robohive_physics::math::diagonalize(&mut a, &mut vectors, 2, 1e-12);
/// assert!((a[0] - 1.0).abs() < 1e-15 && (a[3] - 3.0).abs() < 1e-15);
/// assert!((vectors[0] + vectors[2]).abs() < 1e-15, "the first eigenvector is (1, -1) / √2");
/// ```
pub fn diagonalize(a: &mut [f64], vectors: &mut [f64], n: usize, tolerance: f64) {
    for (k, x) in vectors.iter_mut().enumerate() {
        *x = if k / n == k % n { 1.0 } else { 0.0 };
    }
    for _ in 0..MAX_SWEEPS {
        let above = (0..n).flat_map(|p| &a[p * n + p + 1..(p + 1) * n]);
        if above.fold(0.0, |sum, x| sum + x * x) < tolerance * tolerance || !sweep(a, vectors, n, tolerance) {
            return;
        }
    }
}

/// One rotation for each pair of axes; whether there was an entry to remove.
fn sweep(a: &mut [f64], vectors: &mut [f64], n: usize, tolerance: f64) -> bool {
    let mut rotated = false;
    for p in 0..n {
        for q in p + 1..n {
            let entry = a[p * n + q];
            if entry != 0.0 && entry.abs() >= tolerance * 1e-3 {
                let rotation = Rotation::of(a, n, [p, q]);
                rotation.apply(a, n);
                vectors.chunks_exact_mut(n).for_each(|row| rotation.turn(row));
                rotated = true;
            }
        }
    }
    rotated
}
