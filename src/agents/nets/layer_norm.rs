//! Layer normalisation without parameters of its own: each row to mean 0 and variance 1 (Ba et al., 2016, equations 3 and 4; gain 1, bias 0).

/// Added to a variance.
const FLOOR: f32 = 1e-5;
/// Parts of a sum over a row, which vectors add side by side.
const PARTS: usize = 8;

/// What the derivative needs.
#[derive(Clone, Debug, Default)]
pub(super) struct Tape {
    /// The normalised rows.
    rows: Vec<f32>,
    /// What each row was multiplied by.
    scales: Vec<f32>,
}

/// Normalises rows of `width` numbers.
pub(super) fn forward(width: usize, values: &mut [f32], tape: &mut Tape) {
    tape.scales.clear();
    for row in values.chunks_exact_mut(width) {
        let mean = sum(row.iter().copied()) / width as f32;
        row.iter_mut().for_each(|value| *value -= mean);
        let variance = sum(row.iter().map(|value| value * value)) / width as f32;
        let scale = 1.0 / (variance + FLOOR).sqrt();
        row.iter_mut().for_each(|value| *value *= scale);
        tape.scales.push(scale);
    }
    tape.rows.clear();
    tape.rows.extend_from_slice(values);
}

/// Multiplies each row of `changes` by the derivative, a symmetric matrix: it serves slopes and tangents alike.
pub(super) fn derivative(width: usize, tape: &Tape, changes: &mut [f32]) {
    let rows = changes.chunks_exact_mut(width).zip(tape.rows.chunks_exact(width)).zip(&tape.scales);
    for ((changes, row), scale) in rows {
        let mean = sum(changes.iter().copied()) / width as f32;
        let along = sum(changes.iter().zip(row).map(|(change, value)| change * value)) / width as f32;
        changes
            .iter_mut()
            .zip(row)
            .for_each(|(change, value)| *change = (*change - mean - value * along) * scale);
    }
}

/// The sum of the numbers, every eighth of them added in order, then the eight sums.
fn sum(numbers: impl Iterator<Item = f32>) -> f32 {
    let mut parts = [0.0; PARTS];
    numbers.enumerate().for_each(|(k, number)| parts[k % PARTS] += number);
    parts.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_get_mean_zero_and_variance_one() {
        let mut values = vec![3.0, -1.0, 2.0, 8.0, 100.0, 101.0, 99.0, 104.0];
        forward(4, &mut values, &mut Tape::default());
        for row in values.chunks(4) {
            let mean = row.iter().sum::<f32>() / 4.0;
            let variance = row.iter().map(|value| value * value).sum::<f32>() / 4.0;
            assert!(mean.abs() < 1e-6 && (variance - 1.0).abs() < 1e-4, "{row:?}");
        }
        assert!((values[3] - 5.0 / 10.5_f32.sqrt()).abs() < 1e-3, "{values:?}");
    }
}
