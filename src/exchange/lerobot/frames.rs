//! The frames of an episode as they are given to the writer.

use super::features::{Feature, FeatureKind, NUMBERING};
use super::stats::Stats;
use super::table::{Cells, Column};
use dataset::{Array, Values};

/// Where pictures are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Pictures {
    /// In MP4 files, which lose little.
    #[default]
    Video,
    /// As PNG files in the Parquet files, without loss.
    Png,
}

/// The frames of an episode: of each feature an array whose first axis counts frames. Arrays of bytes of shape `[n, height,
/// width, 3]` are pictures, all others numbers.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// Names and values.
    pub features: Vec<(String, Array)>,
    /// What the episode is an attempt at, in words.
    pub task: String,
}

impl Frames {
    /// How many there are.
    ///
    /// # Errors
    /// There are none, a name cannot be one, or features have different numbers of them.
    pub fn count(&self) -> Result<usize, (String, String)> {
        let Some((first, array)) = self.features.first() else {
            return Err((String::new(), "an episode has no features".into()));
        };
        let count = array.shape.first().copied().unwrap_or(0);
        for (i, (name, array)) in self.features.iter().enumerate() {
            let fail = |message: String| Err((name.clone(), message));
            if name.is_empty() || name.contains('/') {
                return fail("the name of a feature is not empty and has no /".into());
            }
            if NUMBERING.iter().any(|(own, _)| own == name) {
                return fail("the writer sets this feature".into());
            }
            if self.features[..i].iter().any(|(other, _)| other == name) {
                return fail("given twice".into());
            }
            if array.shape.is_empty() || array.shape[1..].contains(&0) {
                return fail(format!("shape {:?}: a frame has no value", array.shape));
            }
            if array.shape[0] != count {
                return fail(format!("{} frames, where {first:?} has {count}", array.shape[0]));
            }
            if array.shape.len() > 6 {
                return fail(format!("shape {:?}: a value has five axes at most", array.shape));
            }
        }
        if count == 0 { Err((first.clone(), "an episode has a frame at least".into())) } else { Ok(count) }
    }

    /// What the frames consist of.
    pub fn forms(&self, pictures: Pictures) -> Vec<Feature> {
        let form = |(name, array): &(String, Array)| {
            let row = &array.shape[1..];
            let kind = match &array.values {
                Values::U8(_) if row.len() == 3 && row[2] == 3 => match pictures {
                    Pictures::Video => FeatureKind::Video,
                    Pictures::Png => FeatureKind::Image,
                },
                Values::F16(_) | Values::F32(_) => FeatureKind::F32,
                Values::F64(_) => FeatureKind::F64,
                Values::Bool(_) => FeatureKind::Bool,
                _ => FeatureKind::I64,
            };
            let shape = if row.is_empty() { vec![1] } else { row.to_vec() };
            Feature { name: name.clone(), kind, shape }
        };
        self.features.iter().map(form).collect()
    }
}

/// The scalars of an array as cells of a column.
pub fn cells(array: &Array) -> Cells {
    match &array.values {
        Values::F32(values) => Cells::F32(values.clone()),
        Values::F64(values) => Cells::F64(values.clone()),
        Values::I64(values) => Cells::I64(values.clone()),
        Values::Bool(values) => Cells::Bool(values.clone()),
        // Every number of half precision is one of single precision.
        values @ Values::F16(_) => Cells::F32(values.to_f64().into_iter().map(|x| x as f32).collect()),
        Values::U64(values) => Cells::I64(values.iter().map(|&x| x as i64).collect()),
        values => Cells::I64(values.to_f64().into_iter().map(|x| x as i64).collect()),
    }
}

/// A column of numbers, and its statistics. A value of shape `[1]` is a scalar.
pub fn numbers(feature: &Feature, array: &Array) -> (Column, Stats) {
    let row = if feature.shape == [1] { Vec::new() } else { feature.shape.clone() };
    let stats = Stats::of_rows(&array.values.to_f64(), &feature.shape);
    (Column { name: feature.name.clone(), row, cells: cells(array) }, stats)
}
