//! Mean and deviation of all that was seen so far, by which what is seen is normalised.

use crate::archive::{Entry, Numbers};

/// Largest normalised value; the smallest is its negative.
const LIMIT: f64 = 10.0;
/// Added to a variance.
const FLOOR: f64 = 1e-8;

/// Running statistics of vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Running {
    count: f64,
    mean: Vec<f64>,
    /// Sums of squared deviations from the mean.
    squares: Vec<f64>,
}

impl Running {
    /// Before the first of the vectors of `len` numbers.
    pub fn new(len: usize) -> Self {
        Running { count: 0.0, mean: vec![0.0; len], squares: vec![0.0; len] }
    }

    /// Length of the vectors.
    pub fn width(&self) -> usize {
        self.mean.len()
    }

    /// Takes vectors in, one after the other (Chan et al., 1979, equation 2.1 with sets of one).
    ///
    /// # Panics
    /// `rows` is no whole number of vectors.
    pub fn observe(&mut self, rows: &[f64]) {
        assert!(
            rows.len().is_multiple_of(self.width()),
            "{} numbers in rows of {}",
            rows.len(),
            self.width()
        );
        for row in rows.chunks_exact(self.width()) {
            self.count += 1.0;
            for ((value, mean), squares) in row.iter().zip(&mut self.mean).zip(&mut self.squares) {
                let away = value - *mean;
                *mean += away / self.count;
                *squares += away * (value - *mean);
            }
        }
    }

    /// All that it is, by names.
    pub(crate) fn entries(&mut self) -> [Entry<'_>; 3] {
        [
            Entry::new("count", Numbers::F64(std::slice::from_mut(&mut self.count))),
            Entry::new("mean", Numbers::F64(&mut self.mean)),
            Entry::new("squares", Numbers::F64(&mut self.squares)),
        ]
    }

    /// Standard deviations; 1 where fewer than two vectors were seen.
    pub fn deviations(&self) -> impl Iterator<Item = f64> {
        let count = self.count;
        self.squares
            .iter()
            .map(move |squares| if count < 2.0 { 1.0 } else { (squares / count + FLOOR).sqrt() })
    }

    /// Means.
    pub fn means(&self) -> &[f64] {
        &self.mean
    }

    /// Appends vectors to `out`, each number as deviations from its mean, at most 10.
    pub fn normalize(&self, rows: &[f64], out: &mut Vec<f32>) {
        let scales: Vec<f64> = self.deviations().map(|deviation| 1.0 / deviation).collect();
        for row in rows.chunks_exact(self.width()) {
            let values = row.iter().zip(&self.mean).zip(&scales);
            out.extend(
                values.map(|((value, mean), scale)| ((value - mean) * scale).clamp(-LIMIT, LIMIT) as f32),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_are_those_of_all_rows_however_they_come() {
        let rows: Vec<f64> = (0..40).map(|k| f64::from((k * 17) % 23) + 1e4 * f64::from(k % 2)).collect();
        let (mut together, mut apart) = (Running::new(2), Running::new(2));
        together.observe(&rows);
        rows.chunks(6).for_each(|rows| apart.observe(rows));
        assert_eq!(together, apart);
        for k in 0..2 {
            let column: Vec<f64> = rows.iter().skip(k).step_by(2).copied().collect();
            let mean = column.iter().sum::<f64>() / 20.0;
            let variance = column.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 20.0;
            assert!((together.means()[k] - mean).abs() < 1e-9);
            assert!((together.deviations().nth(k).unwrap() - variance.sqrt()).abs() < 1e-6);
        }
        let mut out = Vec::new();
        together.normalize(&[together.means()[0], 1e9], &mut out);
        assert_eq!(out, [0.0, 10.0], "far values are cut");
    }

    #[test]
    fn nothing_seen_leaves_values_as_they_are() {
        let mut out = Vec::new();
        Running::new(2).normalize(&[0.5, -3.0], &mut out);
        assert_eq!(out, [0.5, -3.0]);
    }
}
