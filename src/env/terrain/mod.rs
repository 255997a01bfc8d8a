//! Ground that a seed decides: heights for the height field of any model, with a flat patch in the middle, where a robot starts.
//!
//! ```
//! use robohive_env::terrain::{Grid, Kind, Terrain};
//!
//! let grid = Grid { rows: 80, columns: 120, half: [6.0, 4.0] };
//! let stairs = Terrain { kind: Kind::Stairs, height: 0.5, flat: 0.6 };
//! let ground = stairs.draw(&grid, 7)?;
//! assert_eq!(ground.heights.len(), 80 * 120);
//! // The middle is flat.
//! assert_eq!(ground.heights[40 * 120 + 60], ground.level);
//! # Ok::<(), robohive_env::terrain::TerrainError>(())
//! ```

pub(crate) mod formulas;
mod ground;
mod kinds;
mod settings;

pub use ground::{Ground, TerrainError};
pub use settings::{Grid, Kind, Terrain};

#[cfg(test)]
mod tests;
