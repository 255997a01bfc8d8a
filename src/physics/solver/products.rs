//! Products with a Jacobian in compressed rows, added up in MuJoCo's order: the entries of a row in four lanes and those
//! that remain one by one, and the entries of a column of the transpose likewise.
//!
//! Solvers that multiply often put columns together ([`Columns`]); others add up row by row ([`Lanes`]).

use super::pattern::Pattern;
use crate::math::dot_sparse;

/// Columns of a row that is not two triples.
const OTHER: u32 = u32::MAX;

/// Sums of a product with the transpose, row by row.
#[derive(Clone, Debug, Default)]
pub(super) struct Lanes {
    /// Place of each entry among the sums.
    places: Vec<u32>,
    /// Entries of each column, all and those placed so far.
    counts: Vec<[u32; 2]>,
    /// Eight for each column: the lanes, and up to three entries that remain.
    sums: Vec<f64>,
}

impl Lanes {
    /// Places the entries of rows with these columns, one row after the other.
    pub fn place(&mut self, nv: usize, columns: &[i32]) {
        self.counts.clear();
        self.counts.resize(nv, [0; 2]);
        columns.iter().for_each(|&c| self.counts[c as usize][0] += 1);
        self.places.clear();
        self.places.extend(columns.iter().map(|&c| {
            let [all, placed] = &mut self.counts[c as usize];
            let (n, whole) = (*placed, *all & !3);
            *placed += 1;
            8 * c as u32 + if n < whole { n & 3 } else { 4 + n - whole }
        }));
    }

    /// `out = Jᵀ f`.
    pub fn mul_transposed(&mut self, row_start: &[usize], jacobian: &[f64], f: &[f64], out: &mut [f64]) {
        let Lanes { places, sums, .. } = self;
        sums.clear();
        sums.resize(8 * out.len(), 0.0);
        for (i, &f) in f.iter().enumerate().filter(|(_, f)| **f != 0.0) {
            let row = row_start[i]..row_start[i + 1];
            for (&place, x) in places[row.clone()].iter().zip(&jacobian[row]) {
                sums[place as usize] += x * f;
            }
        }
        for (out, s) in out.iter_mut().zip(sums.as_chunks::<8>().0) {
            *out = (s[0] + s[2]) + (s[1] + s[3]) + s[4] + s[5] + s[6];
        }
    }
}

/// Entries of the transpose: one column, or three columns that occur in rows only together, such as the columns of a vertex
/// that slides along three axes.
#[derive(Clone, Copy, Debug)]
struct Group {
    /// First column.
    column: u32,
    /// Number of columns, 1 or 3.
    width: u32,
    /// First of its rows.
    first: u32,
    /// Number of its rows.
    count: u32,
    /// First of its values.
    values: u32,
}

impl Group {
    /// Where the value of the `n`-th row in the `k`-th column is: columns of four rows each, then rows that remain.
    fn place(self, n: u32, k: u32) -> u32 {
        let whole = self.count & !3;
        let within = if n < whole { (n & !3) * self.width + 4 * k + (n & 3) } else { n * self.width + k };
        self.values + within
    }
}

/// The Jacobian by columns.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    groups: Vec<Group>,
    /// Rows of the groups, increasing within each.
    rows: Vec<u32>,
    values: Vec<f64>,
    /// Place of each entry of the rows among the values.
    places: Vec<u32>,
    /// First columns of rows that are two triples.
    pairs: Vec<[u32; 2]>,
    /// Working memory: how many rows each column has, and how many of them have the next column too.
    counts: Vec<[u32; 2]>,
    /// Working memory: group of each column, and its place therein.
    group_of: Vec<[u32; 2]>,
    /// Working memory: rows of each group so far.
    placed: Vec<u32>,
}

impl Columns {
    /// Lays out the entries of `pattern`, which has `nv` columns.
    pub fn place(&mut self, nv: usize, pattern: &Pattern) {
        self.count(nv, pattern);
        self.group();
        self.placed.clear();
        self.placed.resize(self.groups.len(), 0);
        self.places.clear();
        self.pairs.clear();
        for (row, ends) in pattern.row_start.windows(2).enumerate() {
            let columns = &pattern.columns[ends[0]..ends[1]];
            for &c in columns {
                let [group, k] = self.group_of[c as usize];
                let (g, n) = (self.groups[group as usize], &mut self.placed[group as usize]);
                if k == 0 {
                    self.rows[(g.first + *n) as usize] = row as u32;
                    *n += 1;
                }
                self.places.push(g.place(*n - 1, k));
            }
            let begins_triple = |c: i32| {
                let [group, k] = self.group_of[c as usize];
                k == 0 && self.groups[group as usize].width == 3
            };
            self.pairs.push(match *columns {
                [a, _, _, b, _, _] if begins_triple(a) && begins_triple(b) => [a as u32, b as u32],
                _ => [OTHER; 2],
            });
        }
    }

    fn count(&mut self, nv: usize, pattern: &Pattern) {
        self.counts.clear();
        self.counts.resize(nv, [0; 2]);
        for ends in pattern.row_start.windows(2) {
            let columns = &pattern.columns[ends[0]..ends[1]];
            columns.iter().for_each(|&c| self.counts[c as usize][0] += 1);
            for two in columns.windows(2).filter(|two| two[1] == two[0] + 1) {
                self.counts[two[0] as usize][1] += 1;
            }
        }
    }

    /// Makes groups of the columns that have entries.
    fn group(&mut self) {
        let Columns { groups, counts, group_of, .. } = self;
        groups.clear();
        group_of.clear();
        group_of.resize(counts.len(), [0; 2]);
        let together = |c: usize| {
            let [here, both] = counts[c];
            both == here && counts.get(c + 1).is_some_and(|next| next[0] == here)
        };
        let (mut c, mut rows, mut values) = (0, 0, 0);
        while c < counts.len() {
            let count = counts[c][0];
            let width = if count > 0 && together(c) && together(c + 1) { 3 } else { 1 };
            (0..width).for_each(|k| group_of[c + k] = [groups.len() as u32, k as u32]);
            groups.push(Group { column: c as u32, width: width as u32, first: rows, count, values });
            rows += count;
            values += count * width as u32;
            c += width;
        }
        self.rows.resize(rows as usize, 0);
        self.values.resize(values as usize, 0.0);
    }

    /// Takes the entries of the rows.
    pub fn fill(&mut self, jacobian: &[f64]) {
        for (&place, &x) in self.places.iter().zip(jacobian) {
            self.values[place as usize] = x;
        }
    }

    /// `out = J v`.
    pub fn mul(&self, pattern: &Pattern, jacobian: &[f64], v: &[f64], out: &mut [f64]) {
        for ((out, ends), &[a, b]) in out.iter_mut().zip(pattern.row_start.windows(2)).zip(&self.pairs) {
            let row = &jacobian[ends[0]..ends[1]];
            *out = match row.as_array::<6>() {
                Some(x) if a != OTHER => {
                    let (p, q) = (&v[a as usize..a as usize + 3], &v[b as usize..b as usize + 3]);
                    let lanes = (x[0] * p[0] + x[2] * p[2]) + (x[1] * p[1] + x[3] * q[0]);
                    // Lanes begin with zero, so that their sum is not a negative one.
                    0.0 + lanes + x[4] * q[1] + x[5] * q[2]
                }
                _ => dot_sparse(row, &pattern.columns[ends[0]..ends[1]], v),
            };
        }
    }

    /// `out = Jᵀ f`.
    pub fn mul_transposed(&self, f: &[f64], out: &mut [f64]) {
        for group in &self.groups {
            let rows = &self.rows[group.first as usize..(group.first + group.count) as usize];
            let length = (group.count * group.width) as usize;
            let values = &self.values[group.values as usize..group.values as usize + length];
            let first = group.column as usize;
            if group.width == 3 {
                out[first..first + 3].copy_from_slice(&sums::<3, 12>(rows, values, f));
            } else {
                [out[first]] = sums::<1, 4>(rows, values, f);
            }
        }
    }
}

/// Products of `W` columns, whose values are laid out as [`Group::place`] says, with `f`; `C` is `4 W`.
#[inline]
fn sums<const W: usize, const C: usize>(rows: &[u32], values: &[f64], f: &[f64]) -> [f64; W] {
    let ((rows, rows_left), (values, values_left)) = (rows.as_chunks::<4>(), values.as_chunks::<C>());
    let mut lanes = [[0.0; 4]; W];
    for (rows, values) in rows.iter().zip(values) {
        let f = rows.map(|row| f[row as usize]);
        for (lanes, values) in lanes.iter_mut().zip(values.as_chunks::<4>().0) {
            (0..4).for_each(|i| lanes[i] += values[i] * f[i]);
        }
    }
    let mut sums = lanes.map(|s| (s[0] + s[2]) + (s[1] + s[3]));
    for (&row, values) in rows_left.iter().zip(values_left.as_chunks::<W>().0) {
        let f = f[row as usize];
        (0..W).for_each(|k| sums[k] += values[k] * f);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seven rows: pairs of three bodies that slide along three axes each, and a hinge that some rows have.
    fn rows() -> (Pattern, Vec<f64>) {
        let rows: [&[i32]; 7] = [
            &[0, 1, 2, 4, 5, 6],
            &[0, 1, 2, 3, 7, 8, 9],
            &[4, 5, 6, 7, 8, 9],
            &[0, 1, 2],
            &[3],
            &[0, 1, 2, 4, 5, 6, 7, 8, 9],
            &[0, 1, 2, 7, 8, 9],
        ];
        let mut pattern = Pattern::default();
        pattern.row_start.push(0);
        for row in rows {
            pattern.columns.extend_from_slice(row);
            pattern.row_start.push(pattern.columns.len());
        }
        let values = (0..pattern.columns.len()).map(|k| 0.1 + 1.7 * ((k * k) % 11) as f64 / 7.0).collect();
        (pattern, values)
    }

    #[test]
    fn columns_and_lanes_give_the_same_bits() {
        let (pattern, jacobian) = rows();
        let (mut columns, mut lanes) = (Columns::default(), Lanes::default());
        columns.place(10, &pattern);
        columns.fill(&jacobian);
        lanes.place(10, &pattern.columns);
        assert_eq!(columns.groups.iter().filter(|g| g.width == 3).count(), 3);
        let f = [0.3, -1.0 / 3.0, 0.0, 2.0, 0.7, -1.1, 1e-3];
        let (mut by_columns, mut by_rows) = ([9.0; 10], [9.0; 10]);
        columns.mul_transposed(&f, &mut by_columns);
        lanes.mul_transposed(&pattern.row_start, &jacobian, &f, &mut by_rows);
        assert_eq!(by_columns, by_rows);
        assert!(by_rows.iter().all(|x| x.abs() > 1e-3));
    }

    #[test]
    fn two_triples_are_added_like_any_row() {
        let (pattern, jacobian) = rows();
        let mut columns = Columns::default();
        columns.place(10, &pattern);
        assert_eq!(columns.pairs[2], [4, 7]);
        let v: [f64; 10] = std::array::from_fn(|k| 1.0 / (1.0 + k as f64));
        let mut product = [0.0; 7];
        columns.mul(&pattern, &jacobian, &v, &mut product);
        for (i, ends) in pattern.row_start.windows(2).enumerate() {
            let (row, columns) = (&jacobian[ends[0]..ends[1]], &pattern.columns[ends[0]..ends[1]]);
            assert_eq!(product[i], dot_sparse(row, columns, &v));
        }
    }
}
