//! Sparse Cholesky factor `H = Lᵀ L` in compressed rows, found from the last row to the first: on a kinematic tree
//! this order makes no fill (Featherstone 2008, section 6.5; Davis 2006, chapter 4).

use super::problem::Problem;
use crate::math::{add_scaled_slice, bit_set, dot_sparse};
use std::ops::Range;

const NONE: usize = usize::MAX;

/// Mean length of runs from which on they are followed.
const LONG_RUN: usize = 4;

/// Structure of the factor of `M + Jᵀ D J`, and memory of its computation. Values are kept by the caller.
#[derive(Clone, Debug, Default)]
pub(super) struct SparseCholesky {
    n: usize,
    /// The problem's count of changes when its pattern was analysed.
    analysed: Option<u64>,
    /// Start of each row, and the end of the last.
    start: Vec<usize>,
    /// Columns, increasing within a row, the diagonal last.
    columns: Vec<i32>,
    /// Stretches of successive columns within the rows: the first column, and how many; and where each row's stretches begin.
    runs: Vec<(u32, u32)>,
    run_start: Vec<usize>,
    /// Runs are long enough to be worth following.
    by_runs: bool,
    /// Lists of the later rows with an entry in each column, the last column's list first: the list of column `c` begins at
    /// `later_start[c + 1]` and ends at `later_start[c]`.
    later_start: Vec<usize>,
    /// Row of each and the place of its entry, in the order in which they are subtracted.
    later: Vec<(usize, usize)>,
    /// Successive rows of the Jacobian with the same columns, such as the rows of one contact: the first, and how many.
    groups: Vec<(usize, usize)>,
    /// Entries of groups by column: start of each column.
    entry_start: Vec<usize>,
    /// Group of each, and its place within the group's rows.
    entries: Vec<(usize, usize)>,
    /// Columns of each row of the matrix that are not zero, as sets.
    patterns: Vec<u64>,
    /// The same of the pattern before.
    patterns_before: Vec<u64>,
    set: Vec<u64>,
    /// Row that each is eliminated into first.
    parent: Vec<usize>,
    /// Last row whose elimination has visited each.
    visited: Vec<usize>,
    /// Number of entries listed so far, or their end, by row or column.
    at: Vec<usize>,
    dense: Vec<f64>,
    sums: Vec<f64>,
}

impl SparseCholesky {
    /// Finds the structure for the pattern of `p`, or keeps what is known of it.
    pub fn analyse(&mut self, p: &Problem) {
        if self.analysed == Some(p.changes) {
            return;
        }
        self.analysed = Some(p.changes);
        self.group_rows(p);
        self.list_columns(p);
        std::mem::swap(&mut self.patterns, &mut self.patterns_before);
        self.mark_matrix(p);
        // So that exchanging the two needs no more memory.
        self.patterns_before.reserve(self.patterns.len().saturating_sub(self.patterns_before.len()));
        if self.n == p.nv && self.patterns == self.patterns_before {
            return;
        }
        self.n = p.nv;
        self.follow_elimination();
        self.place_entries();
        self.find_runs();
        self.dense.clear();
        self.dense.resize(p.nv, 0.0);
    }

    /// Lists the later rows of each column: those where the matrix has an entry, in increasing order, each followed by
    /// the rows that its elimination leads through. Floating-point sums over them depend on this order, MuJoCo's.
    fn follow_elimination(&mut self) {
        let (n, words) = (self.n, bit_set::words(self.n));
        for v in [&mut self.parent, &mut self.visited] {
            v.clear();
            v.resize(n, NONE);
        }
        self.later.clear();
        self.later_start.clear();
        self.later_start.resize(n + 1, 0);
        for r in (0..n).rev() {
            self.later_start[r + 1] = self.later.len();
            self.visited[r] = r;
            bit_set::for_each(&self.patterns[r * words..(r + 1) * words], |c| {
                let mut row = c;
                while row > r && self.visited[row] != r {
                    self.visited[row] = r;
                    self.later.push((row, 0));
                    if self.parent[row] == NONE {
                        self.parent[row] = r;
                    }
                    row = self.parent[row];
                }
            });
        }
        self.later_start[0] = self.later.len();
    }

    /// Lays out the rows from the lists of columns.
    fn place_entries(&mut self) {
        let n = self.n;
        self.start.clear();
        self.start.resize(n + 1, 0);
        self.later.iter().for_each(|&(row, _)| self.start[row + 1] += 1);
        for r in 0..n {
            self.start[r + 1] += self.start[r] + 1;
        }
        self.columns.clear();
        self.columns.resize(self.start[n], 0);
        self.at.clear();
        self.at.extend_from_slice(&self.start[..n]);
        for r in 0..n {
            for (row, place) in &mut self.later[self.later_start[r + 1]..self.later_start[r]] {
                *place = self.at[*row];
                self.columns[*place] = r as i32;
                self.at[*row] += 1;
            }
            self.columns[self.at[r]] = r as i32;
        }
    }

    fn find_runs(&mut self) {
        self.runs.clear();
        self.run_start.clear();
        self.run_start.push(0);
        for r in 0..self.n {
            let first = self.runs.len();
            for &c in &self.columns[self.start[r]..self.start[r + 1]] {
                match self.runs[first..].last_mut() {
                    Some((start, count)) if *start + *count == c as u32 => *count += 1,
                    _ => self.runs.push((c as u32, 1)),
                }
            }
            self.run_start.push(self.runs.len());
        }
        self.by_runs = self.columns.len() >= LONG_RUN * self.runs.len();
    }

    /// Calls `f` with the columns of each run of row `r`, and where their entries are.
    #[inline]
    fn for_runs(&self, r: usize, mut f: impl FnMut(Range<usize>, Range<usize>)) {
        let mut place = self.start[r];
        for &(first, count) in &self.runs[self.run_start[r]..self.run_start[r + 1]] {
            let (first, count) = (first as usize, count as usize);
            f(first..first + count, place..place + count);
            place += count;
        }
    }

    /// Marks the entries of each row of the matrix.
    fn mark_matrix(&mut self, p: &Problem) {
        let words = bit_set::words(p.nv);
        self.patterns.clear();
        self.patterns.resize(p.nv * words, 0);
        for (r, pattern) in self.patterns.chunks_exact_mut(words).enumerate() {
            p.inertia_row(r).0.iter().for_each(|&c| bit_set::insert(pattern, c as usize));
        }
        for r in 0..p.nv {
            for &c in p.inertia_row(r).0 {
                bit_set::insert(&mut self.patterns[c as usize * words..], r);
            }
        }
        for &(first, _) in &self.groups {
            let columns = p.sparse_row(first).0;
            self.set.clear();
            self.set.resize(words, 0);
            columns.iter().for_each(|&c| bit_set::insert(&mut self.set, c as usize));
            for &r in columns {
                bit_set::unite(&mut self.patterns[r as usize * words..], &self.set);
            }
        }
    }

    fn group_rows(&mut self, p: &Problem) {
        self.groups.clear();
        for i in 0..p.rows.len() {
            match self.groups.last_mut() {
                Some((first, count)) if p.sparse_row(*first).0 == p.sparse_row(i).0 => *count += 1,
                _ => self.groups.push((i, 1)),
            }
        }
    }

    /// Lists the entries of groups by column.
    fn list_columns(&mut self, p: &Problem) {
        self.entry_start.clear();
        self.entry_start.resize(p.nv + 1, 0);
        let columns = |first: usize| p.sparse_row(first).0.iter().map(|&c| c as usize);
        for &(first, _) in &self.groups {
            columns(first).for_each(|c| self.entry_start[c + 1] += 1);
        }
        for c in 0..p.nv {
            self.entry_start[c + 1] += self.entry_start[c];
        }
        self.entries.clear();
        self.entries.resize(self.entry_start[p.nv], (0, 0));
        self.at.clear();
        self.at.extend_from_slice(&self.entry_start[..p.nv]);
        for (group, &(first, _)) in self.groups.iter().enumerate() {
            for (k, c) in columns(first).enumerate() {
                self.entries[self.at[c]] = (group, k);
                self.at[c] += 1;
            }
        }
    }

    /// Entries of row `r` left of the diagonal, and the place of the diagonal.
    fn row(&self, r: usize) -> (Range<usize>, usize) {
        let diagonal = self.start[r + 1] - 1;
        (self.start[r]..diagonal, diagonal)
    }

    /// Assembles `M + Jᵀ D J` row by row and factors it at once; returns the rank.
    pub fn factorize(&mut self, p: &Problem, active: &[f64], values: &mut Vec<f64>, least: f64) -> usize {
        values.clear();
        values.resize(self.columns.len(), 0.0);
        let mut rank = self.n;
        for r in (0..self.n).rev() {
            self.assemble_row(p, active, r);
            self.eliminate_into(r, values);
            let (left, diagonal) = self.row(r);
            let pivot = self.dense[r];
            rank -= usize::from(pivot < least);
            let root = pivot.max(least).sqrt();
            let inverse = 1.0 / root;
            for (&c, value) in self.columns[left.clone()].iter().zip(&mut values[left]) {
                *value = std::mem::take(&mut self.dense[c as usize]) * inverse;
            }
            values[diagonal] = root;
            self.dense[r] = 0.0;
        }
        rank
    }

    /// Puts row `r` of the matrix in `dense`.
    fn assemble_row(&mut self, p: &Problem, active: &[f64], r: usize) {
        for &(group, at) in &self.entries[self.entry_start[r]..self.entry_start[r + 1]] {
            let (first, count) = self.groups[group];
            let active = &active[first..first + count];
            if active.iter().all(|&d| d == 0.0) {
                continue;
            }
            let columns = &p.sparse_row(first).0[..=at];
            let length = p.pattern.row_start[first + 1] - p.pattern.row_start[first];
            self.sums.clear();
            self.sums.extend(columns.iter().map(|&c| self.dense[c as usize]));
            let rows = p.jacobian[p.pattern.row_start[first]..].chunks_exact(length);
            for (row, d) in rows.zip(active) {
                add_scaled_slice(&mut self.sums, row, row[at] * d);
            }
            columns.iter().zip(&self.sums).for_each(|(&c, sum)| self.dense[c as usize] = *sum);
        }
        let (columns, values) = p.inertia_row(r);
        for (&c, x) in columns.iter().zip(values) {
            self.dense[c as usize] += x;
        }
    }

    /// Subtracts the contributions of all later rows with an entry in column `r`.
    fn eliminate_into(&mut self, r: usize, values: &[f64]) {
        if self.by_runs {
            let mut dense = std::mem::take(&mut self.dense);
            for &(row, at) in &self.later[self.later_start[r + 1]..self.later_start[r]] {
                let (scale, end) = (values[at], at + 1);
                self.for_runs(row, |columns, places| {
                    let places = places.start..places.end.min(end);
                    if !places.is_empty() {
                        let dense = dense[columns.start..columns.start + places.len()].iter_mut();
                        dense.zip(&values[places]).for_each(|(sum, value)| *sum -= scale * value);
                    }
                });
            }
            self.dense = dense;
            return;
        }
        for &(row, at) in &self.later[self.later_start[r + 1]..self.later_start[r]] {
            let (span, scale) = (self.start[row]..at + 1, values[at]);
            for (&c, value) in self.columns[span.clone()].iter().zip(&values[span]) {
                self.dense[c as usize] -= scale * value;
            }
        }
    }

    /// Solves `Lᵀ L x = x` in place.
    pub fn solve(&self, values: &[f64], x: &mut [f64]) {
        for i in (0..self.n).rev() {
            let (left, diagonal) = self.row(i);
            let solved = x[i] / values[diagonal];
            x[i] = solved;
            for (&c, value) in self.columns[left.clone()].iter().zip(&values[left]) {
                x[c as usize] -= value * solved;
            }
        }
        for i in 0..self.n {
            let (left, diagonal) = self.row(i);
            x[i] = (x[i] - dot_sparse(&values[left.clone()], &self.columns[left], x)) / values[diagonal];
        }
    }

    /// Rank-one update `Lᵀ L ± v vᵀ` by Givens rotations; the pattern of `v` is one of the Jacobian's rows.
    /// Returns the number of pivots that fell below `least`.
    pub fn update(
        &mut self,
        values: &mut [f64],
        columns: &[i32],
        v: &[f64],
        plus: bool,
        least: f64,
    ) -> usize {
        let Some(&last) = columns.last() else { return 0 };
        for (&c, &x) in columns.iter().zip(v) {
            self.dense[c as usize] = x;
        }
        let (mut fallen, mut dense) = (0, std::mem::take(&mut self.dense));
        for row in (0..=last as usize).rev() {
            let x = dense[row];
            if x == 0.0 {
                continue;
            }
            dense[row] = 0.0;
            let (left, at) = self.row(row);
            let diagonal = values[at];
            let mut square = if plus { diagonal * diagonal + x * x } else { diagonal * diagonal - x * x };
            if square < least {
                square = least;
                fallen += 1;
            }
            let root = square.sqrt();
            values[at] = root;
            let (c, s) = (diagonal / root, -x / root);
            let signed = if plus { -s } else { s };
            let rotate = |value: &mut f64, other: &mut f64| {
                let rotated = c * *value + signed * *other;
                *other = s * *value + c * *other;
                *value = rotated;
            };
            if self.by_runs {
                self.for_runs(row, |columns, places| {
                    let places = places.start..places.end.min(left.end);
                    let others = dense[columns.start..columns.start + places.len()].iter_mut();
                    values[places].iter_mut().zip(others).for_each(|(value, other)| rotate(value, other));
                });
            } else {
                for (&column, value) in self.columns[left.clone()].iter().zip(&mut values[left]) {
                    rotate(value, &mut dense[column as usize]);
                }
            }
        }
        self.dense = dense;
        fallen
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::cholesky::{cholesky_factor, cholesky_solve, stride};
    use crate::math::dense::dot_slice;

    const STRIDE: usize = stride(5);

    /// Inertia of two chains 0-1-2 and 3-4 with one row that couples their ends, and one within the first.
    fn problem() -> Problem {
        let inertia = [
            (0, vec![4.0]),
            (0, vec![1.0, 5.0]),
            (0, vec![0.5, 1.5, 3.0]),
            (3, vec![2.0]),
            (3, vec![-1.0, 4.0]),
        ];
        let mut p = Problem::default();
        p.nv = 5;
        for (first, row) in inertia {
            p.push_inertia_row(first, &row);
        }
        p.rows.d = vec![3.0, 7.0];
        p.pattern.columns = vec![0, 2, 4, 1, 2];
        p.jacobian = vec![1.0, -2.0, 1.5, 0.5, 2.0];
        p.pattern.row_start = vec![0, 3, 5];
        p
    }

    fn dense(p: &Problem, active: &[f64]) -> Vec<f64> {
        let mut h = vec![0.0; 5 * STRIDE];
        for r in 0..5 {
            for (&c, &x) in p.inertia_row(r).0.iter().zip(p.inertia_row(r).1) {
                h[STRIDE * r + c as usize] = x;
                h[STRIDE * c as usize + r] = x;
            }
        }
        for (i, d) in active.iter().enumerate() {
            let (columns, values) = p.sparse_row(i);
            for (&a, x) in columns.iter().zip(values) {
                for (&b, y) in columns.iter().zip(values) {
                    h[STRIDE * a as usize + b as usize] += d * x * y;
                }
            }
        }
        h
    }

    #[test]
    fn agrees_with_dense_factor_before_and_after_an_update() {
        let p = problem();
        let (mut cholesky, mut values) = (SparseCholesky::default(), Vec::new());
        cholesky.analyse(&p);
        assert!(cholesky.columns.len() < 15, "the factor is sparse");
        assert_eq!(cholesky.factorize(&p, &[3.0, 0.0], &mut values, 1e-15), 5);
        let b = [1.0, -2.0, 3.0, 0.5, -1.0];
        let check = |cholesky: &SparseCholesky, values: &[f64], active: &[f64]| {
            let (mut x, mut y) = (b, b);
            cholesky.solve(values, &mut x);
            let mut h = dense(&p, active);
            assert!((0..5).any(|i| dot_slice(&h[STRIDE * i..STRIDE * i + 5], &b).abs() > 1.0));
            cholesky_factor(&mut h, 5, 1e-15);
            cholesky_solve(&h, 5, &mut y);
            for (x, y) in x.iter().zip(y) {
                assert!((x - y).abs() < 1e-12);
            }
        };
        check(&cholesky, &values, &[3.0, 0.0]);
        let (columns, row) = p.sparse_row(1);
        let scaled: Vec<f64> = row.iter().map(|x| x * 7.0_f64.sqrt()).collect();
        assert_eq!(cholesky.update(&mut values, columns, &scaled, true, 1e-15), 0);
        check(&cholesky, &values, &[3.0, 7.0]);
    }
}
