//! What a ground is asked to be, and for which height field.

use physics::Model;
use physics::elements::HfieldId;
use serde::Deserialize;

/// What there is beyond the flat patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Kind {
    /// Uneven ground: independent heights 0.12 m apart.
    Rough,
    /// Waves of 1.5 to 4 m.
    Hilly,
    /// Flights of five steps along x, up and down.
    Stairs,
    /// Boxes of 0.1 to 0.5 m that lie about.
    Obstacles,
    /// Trenches of 0.15 to 0.4 m across x.
    Gaps,
}

/// A kind of ground, and how much of it.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Terrain {
    /// What it is.
    pub kind: Kind,
    /// From the lowest place to the highest \[m\]; positive.
    pub height: f64,
    /// Half the side of the flat square in the middle \[m\]; 0 or more.
    pub flat: f64,
}

/// Places of the heights of a height field: rows along x, the first at the smallest y, as MuJoCo stores them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Rows; at least 2.
    pub rows: usize,
    /// Heights in a row; at least 2.
    pub columns: usize,
    /// Half lengths along x and y \[m\].
    pub half: [f64; 2],
}

impl Grid {
    /// The grid of a height field.
    pub fn of(model: &Model, hfield: HfieldId) -> Self {
        let id = hfield.index();
        let [x, y, ..] = model.hfield_size[id];
        Grid { rows: model.hfield_nrow[id] as usize, columns: model.hfield_ncol[id] as usize, half: [x, y] }
    }

    /// Every place, in the order of the heights \[m\].
    pub(super) fn places(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let along = |axis: usize, k: usize, count: usize| {
            self.half[axis] * ((2 * k) as f64 - (count - 1) as f64) / (count - 1) as f64
        };
        (0..self.rows * self.columns)
            .map(move |k| [along(0, k % self.columns, self.columns), along(1, k / self.columns, self.rows)])
    }

    /// The heights along an axis between two places \[m\]: the first, and that behind the last.
    pub(super) fn cells(&self, axis: usize, range: [f64; 2]) -> [usize; 2] {
        let count = [self.columns, self.rows][axis];
        let [low, high] = range.map(|place| (place / self.half[axis] + 1.0) / 2.0 * (count - 1) as f64);
        let first = low.ceil().clamp(0.0, count as f64) as usize;
        [first, (high.floor() + 1.0).clamp(first as f64, count as f64) as usize]
    }
}

impl Terrain {
    /// How far a place is beyond the flat patch \[m\]; negative within.
    pub(super) fn beyond(&self, [x, y]: [f64; 2]) -> f64 {
        x.abs().max(y.abs()) - self.flat
    }
}
