//! Cholesky factor `A = L Lᵀ` of dense matrices, kept by columns: row `k` of the array holds, from its diagonal on,
//! column `k` of `L`. What lies before the diagonal is working memory.
//!
//! Rows of the array are `stride(n)` long, zeros behind the `n`-th entry. Inner products keep four running sums over
//! columns, as in `dense`; vector registers run along the rows of `L`, which are independent.

use std::array::from_fn;

/// Entries that one step of the inner loops takes.
const WIDTH: usize = 4;

/// Distance of the rows of an array for `n` by `n` matrices.
pub const fn stride(n: usize) -> usize {
    n.next_multiple_of(WIDTH)
}

/// Adds `s row rowᵀ` to the upper triangle of `a`; `row` holds the columns from `first` on, zero elsewhere, and
/// `scaled` is working memory.
pub fn add_outer_product(a: &mut [f64], n: usize, first: usize, row: &[f64], s: f64, scaled: &mut Vec<f64>) {
    let (stride, start) = (stride(n), first / WIDTH * WIDTH);
    scaled.clear();
    scaled.resize(first - start, 0.0);
    scaled.extend(row.iter().map(|x| x * s));
    scaled.resize(scaled.len().next_multiple_of(WIDTH), 0.0);
    for (j, &x) in (first..).zip(row).filter(|(_, x)| **x != 0.0) {
        let from = j / WIDTH * WIDTH;
        let scaled = &mut scaled[from - start..];
        let column = whole(&mut a[j * stride + from..][..scaled.len()]);
        column.iter_mut().zip(whole(scaled)).for_each(|(a, scaled)| *a += x * *scaled);
    }
}

/// Replaces the upper triangle of `a` by its factor. Pivots below `least` are raised to it and their columns cleared;
/// returns the number of sound pivots.
pub fn cholesky_factor(a: &mut [f64], n: usize, least: f64) -> usize {
    let (stride, mut rank) = (stride(n), n);
    for j in 0..n {
        let (above, column) = a[..(j + 1) * stride].split_at_mut(j * stride);
        let first = j / WIDTH * WIDTH;
        let mut i = first;
        while i + 2 * WIDTH <= stride {
            subtract_product::<{ 2 * WIDTH }>(above, stride, i, |c| above[c * stride + j], &mut column[i..]);
            i += 2 * WIDTH;
        }
        if i < stride {
            subtract_product::<WIDTH>(above, stride, i, |c| above[c * stride + j], &mut column[i..]);
        }
        let pivot = column[j];
        let sound = pivot >= least;
        let root = pivot.max(least).sqrt();
        let inverse = 1.0 / root;
        column[first..].iter_mut().for_each(|x| *x = if sound { *x * inverse } else { 0.0 });
        column[j] = root;
        rank -= usize::from(!sound);
    }
    rank
}

/// Subtracts from `out` the products of the columns before it, at rows `i..i + W`, with `factor`.
#[inline]
fn subtract_product<const W: usize>(
    columns: &[f64],
    stride: usize,
    i: usize,
    factor: impl Fn(usize) -> f64,
    out: &mut [f64],
) {
    let product = product::<W>(columns, stride, i, factor);
    out[..W].iter_mut().zip(product).for_each(|(x, p)| *x -= p);
}

/// Sums of `columns` at rows `i..i + W`, each times `factor` of its number.
#[inline]
fn product<const W: usize>(
    columns: &[f64],
    stride: usize,
    i: usize,
    factor: impl Fn(usize) -> f64,
) -> [f64; W] {
    let mut lanes = [[0.0; W]; 4];
    let blocks = columns.chunks_exact(4 * stride);
    let (rest, whole) = (blocks.remainder(), 4 * blocks.len());
    for (t, block) in blocks.enumerate() {
        for (l, lane) in lanes.iter_mut().enumerate() {
            let (x, f) = (&block[l * stride + i..][..W], factor(4 * t + l));
            (0..W).for_each(|k| lane[k] += x[k] * f);
        }
    }
    let mut tail = [0.0; W];
    for (c, column) in rest.chunks_exact(stride).enumerate() {
        let (x, f) = (&column[i..][..W], factor(whole + c));
        (0..W).for_each(|k| tail[k] += x[k] * f);
    }
    from_fn(|k| ((lanes[0][k] + lanes[2][k]) + (lanes[1][k] + lanes[3][k])) + tail[k])
}

/// Solves `L Lᵀ x = x` in place.
pub fn cholesky_solve(l: &[f64], n: usize, x: &mut [f64]) {
    let stride = stride(n);
    for first in (0..n).step_by(WIDTH) {
        let before = product::<WIDTH>(&l[..first * stride], stride, first, |c| x[c]);
        for i in first..n.min(first + WIDTH) {
            let inside = (first..i).fold(0.0, |s, c| s + l[c * stride + i] * x[c]);
            x[i] = (x[i] - (before[i - first] + inside)) / l[i * (stride + 1)];
        }
    }
    for i in (0..n).rev() {
        let column = &l[i * stride + i..i * stride + n];
        let value = column[1..].iter().zip(&x[i + 1..n]).fold(x[i], |value, (l, x)| value - l * x);
        x[i] = value / column[0];
    }
}

/// Rank-one updates `L Lᵀ ± x xᵀ` of a factor (Gill, Golub, Murray, Saunders 1974), one for each row of `x`, which is
/// `stride(n)` long; destroys `x`. Returns the number of pivots that fell below `least`.
///
/// Two columns advance together, the second one update behind: each waits for its own square roots alone.
pub fn cholesky_update(l: &mut [f64], n: usize, x: &mut [f64], plus: &[bool], least: f64) -> usize {
    let (stride, mut fallen) = (stride(n), 0);
    let mut step = |column: &mut [f64], k: usize, u: usize| {
        fallen += usize::from(update_column(column, k, &mut x[u * stride..(u + 1) * stride], plus[u], least));
    };
    for (pair, columns) in l[..n * stride].chunks_mut(2 * stride).enumerate() {
        let (first, second) = columns.split_at_mut(stride);
        for u in 0..=plus.len() {
            if u < plus.len() {
                step(first, 2 * pair, u);
            }
            if u > 0 && !second.is_empty() {
                step(second, 2 * pair + 1, u - 1);
            }
        }
    }
    fallen
}

/// The same entries, known to be whole registers.
#[inline]
fn whole(x: &mut [f64]) -> &mut [f64] {
    x.as_chunks_mut::<WIDTH>().0.as_flattened_mut()
}

/// Rotates `x` into column `k`; returns whether the pivot fell below `least`.
#[inline]
fn update_column(column: &mut [f64], k: usize, x: &mut [f64], plus: bool, least: f64) -> bool {
    if x[k] == 0.0 {
        return false;
    }
    let pivot = column[k];
    let square = if plus { pivot * pivot + x[k] * x[k] } else { pivot * pivot - x[k] * x[k] };
    let fallen = square < least;
    let root = (if fallen { least } else { square }).sqrt();
    let [c, s] = [root, x[k]].map(|v| v / pivot);
    let (inverse, signed) = (1.0 / c, if plus { s } else { -s });
    let first = k / WIDTH * WIDTH;
    let (l, x) = (whole(&mut column[first..]), whole(&mut x[first..]));
    for (l, x) in l.iter_mut().zip(x) {
        *l = (*l + signed * *x) * inverse;
        *x = c * *x - s * *l;
    }
    column[k] = root;
    fallen
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: usize = 7;
    const S: usize = stride(N);

    fn spd() -> Vec<f64> {
        let value = |i: usize, j: usize| ((3 * i + 7 * j) % 5) as f64 - 2.0;
        let mut a = vec![0.0; N * S];
        for i in 0..N {
            for j in 0..N {
                a[i * S + j] =
                    (0..N).map(|k| value(i, k) * value(j, k)).sum::<f64>() + f64::from(u8::from(i == j));
            }
        }
        a
    }

    /// Entry of `L Lᵀ`.
    fn square(l: &[f64], i: usize, j: usize) -> f64 {
        (0..=i.min(j)).map(|c| l[c * S + i] * l[c * S + j]).sum()
    }

    #[test]
    fn factor_solves_and_updates() {
        let a = spd();
        let mut l = a.clone();
        assert_eq!(cholesky_factor(&mut l, N, 1e-15), N);
        let v: Vec<f64> = (0..N).map(|i| 1.0 + i as f64).collect();
        let mut x = v.clone();
        cholesky_solve(&l, N, &mut x);
        for i in 0..N {
            let product = (0..N).map(|j| a[i * S + j] * x[j]).sum::<f64>();
            assert!((product - v[i]).abs() < 1e-10);
        }
        let before = l.clone();
        let w: Vec<f64> = v.iter().map(|x| (5.0 * x).sin()).collect();
        let both: Vec<f64> = [&v, &w].into_iter().flat_map(|x| x.iter().copied().chain([0.0])).collect();
        assert_eq!(cholesky_update(&mut l, N, &mut both.clone(), &[true, true], 1e-15), 0);
        for i in 0..N {
            for j in 0..N {
                let added = v[i] * v[j] + w[i] * w[j];
                assert!((square(&l, i, j) - a[i * S + j] - added).abs() < 1e-9);
            }
        }
        assert_eq!(cholesky_update(&mut l, N, &mut both.clone(), &[false, false], 1e-15), 0);
        for j in 0..N {
            for i in j..N {
                assert!((l[j * S + i] - before[j * S + i]).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn deficient_pivot_is_counted() {
        let mut a = [0.0; 8];
        (a[0], a[1], a[5]) = (1.0, 1.0, 1.0);
        assert_eq!(cholesky_factor(&mut a, 2, 1e-15), 1);
        assert_eq!(a[5], 1e-15_f64.sqrt());
    }
}
