//! Quadratic programs in a box: the least of `x' h x / 2 + g' x` where each coordinate has bounds, by projected Newton steps (Bertsekas,
//! Projected Newton methods for optimization problems with simple constraints, SIAM Journal on Control and Optimization 20, 1982).

use nalgebra::{DMatrix, DVector};

/// Most Newton steps.
const NEWTON: usize = 20;

/// A convex quadratic function.
pub trait Convex {
    fn value(&self, x: &DVector<f64>) -> f64;

    fn slope(&self, x: &DVector<f64>) -> DVector<f64>;

    /// Where the function is least when coordinates other than `free` stay as they are: the values of these. `None` where it is not
    /// convex.
    fn target(&self, free: &[usize], x: &DVector<f64>) -> Option<DVector<f64>>;
}

/// `x' h x / 2 + g' x`.
struct Quadratic<'a> {
    h: &'a DMatrix<f64>,
    g: &'a DVector<f64>,
}

impl Quadratic<'_> {
    fn part(&self, places: &[usize]) -> DMatrix<f64> {
        DMatrix::from_fn(places.len(), places.len(), |i, j| self.h[(places[i], places[j])])
    }
}

impl Convex for Quadratic<'_> {
    fn value(&self, x: &DVector<f64>) -> f64 {
        0.5 * x.dot(&(self.h * x)) + self.g.dot(x)
    }

    fn slope(&self, x: &DVector<f64>) -> DVector<f64> {
        self.g + self.h * x
    }

    fn target(&self, free: &[usize], x: &DVector<f64>) -> Option<DVector<f64>> {
        let step = self.part(free).cholesky()?.solve(&self.slope(x).select_rows(free));
        Some(x.select_rows(free) - step)
    }
}

/// The point `x` within bounds that minimises `x' h x / 2 + g' x`, by projected Newton steps, and the
/// inverse of `h` on the coordinates that are not at a bound; `None` where `h` is not positive there.
pub fn minimise(
    h: &DMatrix<f64>,
    g: &DVector<f64>,
    bounds: &[[f64; 2]],
) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let program = Quadratic { h, g };
    let x = least(&program, bounds)?;
    let free = free(&program.slope(&x), &x, bounds);
    let inverse = program.part(&free).cholesky()?.inverse();
    let mut all = DMatrix::zeros(x.len(), x.len());
    for (i, &row) in free.iter().enumerate() {
        for (j, &column) in free.iter().enumerate() {
            all[(row, column)] = inverse[(i, j)];
        }
    }
    Some((x, all))
}

/// The point within bounds where a function is least, by projected Newton steps; `None` where it is not convex.
pub fn least(program: &impl Convex, bounds: &[[f64; 2]]) -> Option<DVector<f64>> {
    let project = |x: DVector<f64>| {
        DVector::from_iterator(x.len(), x.iter().zip(bounds).map(|(x, [low, high])| x.clamp(*low, *high)))
    };
    let mut x = project(DVector::zeros(bounds.len()));
    for _ in 0..NEWTON {
        let free = free(&program.slope(&x), &x, bounds);
        let mut direction = DVector::zeros(x.len());
        for (&k, goal) in free.iter().zip(&program.target(&free, &x)?) {
            direction[k] = goal - x[k];
        }
        let before = program.value(&x);
        let mut share = 1.0;
        let mut next = project(&x + &direction);
        while program.value(&next) > before && share > 1e-6 {
            share *= 0.5;
            next = project(&x + &direction * share);
        }
        let moved = (&next - &x).norm();
        x = next;
        if moved <= 1e-10 * (1.0 + x.norm()) {
            break;
        }
    }
    Some(x)
}

/// The coordinates that are free: not at a bound towards which the slope pushes them.
fn free(slope: &DVector<f64>, x: &DVector<f64>, bounds: &[[f64; 2]]) -> Vec<usize> {
    let held =
        |k: usize| (x[k] <= bounds[k][0] && slope[k] > 0.0) || (x[k] >= bounds[k][1] && slope[k] < 0.0);
    (0..x.len()).filter(|&k| !held(k)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inside the box it is the free minimum; outside, no point of the box is better.
    #[test]
    fn no_point_of_the_box_is_better() {
        let (h, g) = (dmatrix![2.0, 0.6; 0.6, 1.0], DVector::from_vec(vec![-1.0, -2.0]));
        let (free, _) = minimise(&h, &g, &[[-9.0, 9.0]; 2]).unwrap();
        assert!((&h * &free + &g).norm() < 1e-9);
        let (bounded, inverse) = minimise(&h, &g, &[[-1.0, 0.2], [-1.0, 0.5]]).unwrap();
        let value = |x: &DVector<f64>| 0.5 * (x.transpose() * &h * x)[0] + g.dot(x);
        for i in 0..=24 {
            for j in 0..=30 {
                let other = DVector::from_vec(vec![-1.0 + 0.05 * f64::from(i), -1.0 + 0.05 * f64::from(j)]);
                assert!(value(&other) >= value(&bounded) - 1e-12);
            }
        }
        // The second coordinate stands at its bound, and is not free.
        assert!(bounded[1] == 0.5 && inverse[(1, 1)] == 0.0);
    }
}
