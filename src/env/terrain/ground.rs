//! Grounds, drawn from seeds and written into models.

use super::kinds;
use super::settings::{Grid, Kind, Terrain};
use crate::draws::Rng;
use physics::Model;
use physics::model::Suggestions;
use std::fmt;

/// Heights that a ground may have at most.
const MOST: usize = 1 << 24;

/// Heights, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// The grid that they are for.
    pub grid: Grid,
    /// From 0 to the terrain's height \[m\].
    pub heights: Vec<f64>,
    /// That of the flat patch \[m\].
    pub level: f64,
}

/// Why there is no such ground.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TerrainError {
    /// A number that no ground has: which, and what it may be.
    Setting(String),
    /// A height field that is missing, or has another grid or too little height.
    Hfield(String),
}

impl fmt::Display for TerrainError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TerrainError::Setting(message) | TerrainError::Hfield(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for TerrainError {}

impl Terrain {
    /// The ground of a seed: the same on every machine.
    ///
    /// # Errors
    /// A grid with fewer than two rows or columns, with more than 2²⁴ heights, or of no size; a height or patch that is none.
    pub fn draw(&self, grid: &Grid, seed: u64) -> Result<Ground, TerrainError> {
        let refused = |message: String| Err(TerrainError::Setting(message));
        let count = grid.rows.saturating_mul(grid.columns);
        if grid.rows.min(grid.columns) < 2 || count > MOST {
            return refused(format!(
                "a ground of {} rows and {} columns: there are at least 2 of each, and {MOST} heights at most",
                grid.rows, grid.columns
            ));
        }
        for (name, value) in [("x", grid.half[0]), ("y", grid.half[1])] {
            if !(value > 0.0 && value.is_finite()) {
                return refused(format!(
                    "a ground whose half length along {name} is {value} m: it is positive"
                ));
            }
        }
        if !(self.height > 0.0 && self.height.is_finite()) {
            return refused(format!("a ground of the height {} m: it is positive", self.height));
        }
        if !(self.flat >= 0.0 && self.flat.is_finite()) {
            return refused(format!("a flat patch of the half side {} m: it is 0 or more", self.flat));
        }
        let (mut heights, mut rng) = (vec![0.0; count], Rng::pcg64(seed));
        let (fill, level): (Fill, f64) = match self.kind {
            Kind::Rough => (kinds::rough, self.height * 0.5),
            Kind::Hilly => (kinds::hilly, self.height * 0.5),
            Kind::Stairs => (kinds::stairs, 0.0),
            Kind::Obstacles => (kinds::obstacles, 0.0),
            Kind::Gaps => (kinds::gaps, self.height),
        };
        fill(self, grid, &mut heights, &mut rng).map_err(|error| TerrainError::Setting(error.to_string()))?;
        Ok(Ground { grid: *grid, heights, level })
    }
}

/// What writes the heights of a kind.
type Fill = fn(&Terrain, &Grid, &mut [f64], &mut Rng) -> Result<(), random::RandomError>;

impl Ground {
    /// Writes the heights into a height field of the model. Its geom stands [`Self::level`] higher than the flat patch is to be, so
    /// a geom at z = -level has the patch at 0.
    ///
    /// # Errors
    /// The model has no such height field, or one of another grid, or one that is lower than this ground.
    pub fn write(&self, model: &mut Model, hfield: &str) -> Result<(), TerrainError> {
        let refused = |message: String| Err(TerrainError::Hfield(message));
        let Some(id) = model.hfield(hfield) else {
            let nearest = Suggestions::default().nearest(hfield, model.hfield_names().map(|(_, name)| name));
            let hint = nearest.map_or_else(String::new, |name| format!(": is it '{name}'?"));
            return refused(format!("the model has no height field '{hfield}'{hint}"));
        };
        let grid = Grid::of(model, id);
        if grid != self.grid {
            return refused(format!(
                "the height field '{hfield}' has the grid {grid:?}, and the ground {:?}",
                self.grid
            ));
        }
        let top = model.hfield_size[id.index()][2];
        let highest = self.heights.iter().copied().fold(0.0, f64::max);
        if highest > top {
            return refused(format!(
                "the height field '{hfield}' is {top} m high, and the ground {highest} m"
            ));
        }
        let start = model.hfield_adr[id.index()] as usize;
        let written = model.overwrite(|m| {
            for (elevation, height) in m.hfield_data[start..].iter_mut().zip(&self.heights) {
                *elevation = (height / top) as f32;
            }
        });
        written.map_err(|error| TerrainError::Hfield(error.to_string()))
    }
}
