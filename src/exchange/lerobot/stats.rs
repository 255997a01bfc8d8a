//! Statistics of features, by which policies normalise.

use super::table::{Cells, Column};
use serde_json::{Value, json};

/// The quantiles that are given, with their names.
const QUANTILES: [(&str, f64); 5] = [("q01", 0.01), ("q10", 0.1), ("q50", 0.5), ("q90", 0.9), ("q99", 0.99)];

/// Statistics of every direction of a feature; numbers that are not finite do not count.
#[derive(Clone, Debug, PartialEq)]
pub struct Stats {
    /// Shape of each.
    shape: Vec<usize>,
    min: Vec<f64>,
    max: Vec<f64>,
    mean: Vec<f64>,
    std: Vec<f64>,
    quantiles: [Vec<f64>; 5],
    /// Frames.
    count: usize,
}

impl Stats {
    /// Of rows of `shape`, row-major.
    pub fn of_rows(values: &[f64], shape: &[usize]) -> Self {
        let width = shape.iter().product::<usize>().max(1);
        let mut out = Stats::empty(shape.to_vec(), values.len() / width);
        for i in 0..width {
            let mut column: Vec<f64> =
                values.iter().skip(i).step_by(width).copied().filter(|x| x.is_finite()).collect();
            column.sort_unstable_by(f64::total_cmp);
            let weighted: Vec<(f64, usize)> = column.into_iter().map(|x| (x, 1)).collect();
            out.push(&weighted);
        }
        out
    }

    /// Of pictures: of each of three channels, whose values are 0 to 1.
    pub fn of_pictures(rgb: &[u8], frames: usize) -> Self {
        let mut counts = [[0usize; 256]; 3];
        for pixel in rgb.chunks_exact(3) {
            for (channel, &value) in counts.iter_mut().zip(pixel) {
                channel[usize::from(value)] += 1;
            }
        }
        let mut out = Stats::empty(vec![3, 1, 1], frames);
        for channel in counts {
            let weighted: Vec<(f64, usize)> =
                channel.into_iter().enumerate().map(|(value, n)| (value as f64 / 255.0, n)).collect();
            out.push(&weighted);
        }
        out
    }

    fn empty(shape: Vec<usize>, count: usize) -> Self {
        let none = Vec::new;
        Stats {
            shape,
            min: none(),
            max: none(),
            mean: none(),
            std: none(),
            quantiles: Default::default(),
            count,
        }
    }

    /// Adds a direction: its values, sorted, and how often each occurs.
    fn push(&mut self, values: &[(f64, usize)]) {
        let values: Vec<(f64, usize)> = values.iter().copied().filter(|(_, n)| *n > 0).collect();
        let count = values.iter().map(|(_, n)| n).sum::<usize>();
        let average = |of: &dyn Fn(f64) -> f64| {
            values.iter().map(|&(x, n)| n as f64 * of(x)).sum::<f64>() / count.max(1) as f64
        };
        let mean = average(&|x| x);
        self.min.push(values.first().map_or(0.0, |(x, _)| *x));
        self.max.push(values.last().map_or(0.0, |(x, _)| *x));
        self.mean.push(mean);
        self.std.push(average(&|x| (x - mean) * (x - mean)).sqrt());
        for (out, (_, q)) in self.quantiles.iter_mut().zip(QUANTILES) {
            out.push(quantile(&values, count, q));
        }
    }

    /// Takes in the statistics of further frames. As in LeRobot, quantiles are averaged over episodes.
    pub fn merge(&mut self, other: &Stats) {
        let (own, new) = (self.count as f64, other.count as f64);
        let total = (own + new).max(1.0);
        for i in 0..self.mean.len() {
            let mean = (own * self.mean[i] + new * other.mean[i]) / total;
            let variance = |stats: &Stats| stats.std[i].powi(2) + (stats.mean[i] - mean).powi(2);
            self.std[i] = ((own * variance(self) + new * variance(other)) / total).sqrt();
            self.mean[i] = mean;
            self.min[i] = self.min[i].min(other.min[i]);
            self.max[i] = self.max[i].max(other.max[i]);
            for (a, b) in self.quantiles.iter_mut().zip(&other.quantiles) {
                a[i] = (own * a[i] + new * b[i]) / total;
            }
        }
        self.count += other.count;
    }

    /// Names and values.
    fn parts(&self) -> Vec<(&'static str, &[f64])> {
        let moments = [("min", &self.min), ("max", &self.max), ("mean", &self.mean), ("std", &self.std)];
        let quantiles = QUANTILES.iter().zip(&self.quantiles).map(|((name, _), values)| (*name, values));
        moments.into_iter().chain(quantiles).map(|(name, values)| (name, &values[..])).collect()
    }

    /// As in `stats.json`.
    pub fn to_json(&self) -> Value {
        let nested = |values: &[f64]| match self.shape[..] {
            [_, ..] if self.shape.len() > 1 => nest(values, &self.shape),
            _ => json!(values),
        };
        let mut out: serde_json::Map<String, Value> =
            self.parts().into_iter().map(|(name, values)| (name.to_owned(), nested(values))).collect();
        out.insert("count".into(), json!([self.count]));
        Value::Object(out)
    }

    /// From an entry of `stats.json`; `None` where a part is missing.
    pub fn from_json(entry: &Value) -> Option<Self> {
        let part = |name: &str| entry.get(name).map(numbers).filter(|part| !part.is_empty());
        let count = entry.get("count")?.get(0)?.as_u64()?;
        let mut out = Stats::empty(shape(entry.get("min")?), usize::try_from(count).ok()?);
        (out.min, out.max, out.mean, out.std) = (part("min")?, part("max")?, part("mean")?, part("std")?);
        for (quantile, (name, _)) in out.quantiles.iter_mut().zip(QUANTILES) {
            *quantile = part(name)?;
        }
        let width = out.min.len();
        out.parts().iter().all(|(_, values)| values.len() == width).then_some(out)
    }

    /// As columns of the table of episodes.
    pub fn columns(&self, feature: &str) -> Vec<Column> {
        let row = if self.shape.is_empty() { vec![1] } else { self.shape.clone() };
        let column = |part: &str, row: &[usize], cells| Column {
            name: format!("stats/{feature}/{part}"),
            row: row.to_vec(),
            cells,
        };
        let parts =
            self.parts().into_iter().map(|(name, values)| column(name, &row, Cells::F64(values.to_vec())));
        let count = column("count", &[1], Cells::I64(vec![self.count as i64]));
        parts.chain([count]).collect()
    }
}

/// Numbers as arrays of arrays.
fn nest(values: &[f64], shape: &[usize]) -> Value {
    match shape {
        [] => values.first().copied().unwrap_or(0.0).into(),
        [axis, inner @ ..] => {
            let width = values.len() / (*axis).max(1);
            values.chunks(width.max(1)).map(|part| nest(part, inner)).collect()
        }
    }
}

/// All numbers of arrays of arrays.
fn numbers(value: &Value) -> Vec<f64> {
    match value.as_array() {
        Some(parts) => parts.iter().flat_map(numbers).collect(),
        None => value.as_f64().into_iter().collect(),
    }
}

/// Lengths of arrays of arrays, the outermost first.
fn shape(value: &Value) -> Vec<usize> {
    let parts = value.as_array();
    let inner = parts.and_then(|parts| parts.first()).map(shape).unwrap_or_default();
    parts.map(|parts| parts.len()).into_iter().chain(inner).collect()
}

/// The value below which a share of all values is, on the line between two of them.
fn quantile(values: &[(f64, usize)], count: usize, share: f64) -> f64 {
    let at = share * count.saturating_sub(1) as f64;
    let nth = |rank: usize| {
        let mut seen = 0;
        let found = values.iter().find(|(_, n)| {
            seen += n;
            seen > rank
        });
        found.or(values.last()).map_or(0.0, |(x, _)| *x)
    };
    let (low, high) = (nth(at.floor() as usize), nth(at.ceil() as usize));
    low + (high - low) * at.fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_between_values() {
        let stats = Stats::of_rows(&[3.0, 1.0, 2.0, f64::NAN, 4.0], &[]);
        assert_eq!((stats.min[0], stats.max[0], stats.mean[0]), (1.0, 4.0, 2.5));
        assert_eq!(stats.quantiles[2], [2.5]);
        assert!((stats.std[0] - 1.25f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn parts_merge_into_the_moments_of_all() {
        let all = Stats::of_rows(&[1.0, 10.0, 2.0, 20.0, 5.0, 50.0, 9.0, 0.0], &[2]);
        let mut merged = Stats::of_rows(&[1.0, 10.0], &[2]);
        merged.merge(&Stats::of_rows(&[2.0, 20.0, 5.0, 50.0, 9.0, 0.0], &[2]));
        for i in 0..2 {
            assert!(
                (all.mean[i] - merged.mean[i]).abs() < 1e-12 && (all.std[i] - merged.std[i]).abs() < 1e-12
            );
            assert_eq!((all.min[i], all.max[i]), (merged.min[i], merged.max[i]));
        }
    }

    #[test]
    fn pictures_count_by_channel() {
        let stats = Stats::of_pictures(&[0, 255, 51, 0, 255, 153], 2);
        assert_eq!((stats.mean[0], stats.mean[1], stats.max[2]), (0.0, 1.0, 0.6));
        assert_eq!(stats.to_json()["min"], json!([[[0.0]], [[1.0]], [[0.2]]]));
        assert_eq!(stats.to_json()["count"], json!([2]));
    }
}
