//! The ground that legs walk on: flat, or a height field.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::scene::Scene;
use crate::task::Pose;
use crate::terrain::formulas;
use physics::Model;
use physics::elements::GeomId;
use physics::model::GeomType;
use robot::Compat;
use serde::Deserialize;
use std::f64::consts::PI;

/// The geom that shows the height field.
const GEOM: &str = "terrain";
/// Where a height field is that is not used \[m\].
const AWAY: [f64; 3] = [0.0, 0.0, -10.0];
/// Elevations of a height field, a square row by row.
const CELLS: usize = 10_000;
/// Lowest elevation of rough ground, and the range above it.
const ROUGH: [f64; 2] = [-0.02, 0.08];
/// Flat cells before the hills.
const BEFORE_HILLS: usize = 3000;
/// Half waves of the hills.
const HILLS: f64 = 3.0;
/// Flat cells before the stairs, and cells of a step of them.
const BEFORE_STAIRS: usize = 5200;
const STEP: usize = 400;
/// Rise of a step over the height of all ground below the flat part.
const RISE: f64 = 0.1 / (2.0 + 12.0 * 0.1);

/// What a height field shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Relief {
    /// Uneven ground.
    Rough,
    /// Hills behind a flat part.
    Hilly,
    /// Stairs behind a flat part.
    Stairs,
}

/// A height field to be filled for every episode.
#[derive(Clone, Debug)]
pub struct Terrain {
    relief: Relief,
    /// Whether hills and stairs have the same height in every episode.
    fixed: bool,
    heights: Vec<f64>,
}

/// Takes the height field out of the way.
///
/// # Errors
/// The model has none.
pub fn remove(scene: &mut Scene) -> Result<(), EnvError> {
    let geom = scene.geom(GEOM)?;
    scene.overwrite(|m| m.geom_pos[geom.index()] = AWAY)?;
    Ok(())
}

/// Writes a pose of the model's keyframes; zero velocities where it has none.
///
/// # Errors
/// The model has no such keyframe.
pub fn key_pose(model: &Model, key: usize, pose: &mut Pose) -> Result<(), EnvError> {
    let missing = || EnvError::missing("keyframe", &key.to_string(), std::iter::empty());
    let (nq, nv) = (model.nq, model.nv);
    pose.qpos.copy_from_slice(model.key_qpos.get(key * nq..(key + 1) * nq).ok_or_else(missing)?);
    pose.qvel.copy_from_slice(model.key_qvel.get(key * nv..(key + 1) * nv).ok_or_else(missing)?);
    Ok(())
}

impl Terrain {
    /// Puts the height field where the legs are, and lets them touch it.
    ///
    /// # Errors
    /// The model has no height field, or one of another size.
    pub fn new(scene: &mut Scene, relief: Relief, fixed: bool, compat: Compat) -> Result<Self, EnvError> {
        let geom: GeomId = scene.geom(GEOM)?;
        let model = &scene.model;
        if model.geom_type[geom.index()] != GeomType::Hfield as i32 || model.hfield_data.len() != CELLS {
            return Err(EnvError::missing("height field of 100 x 100 cells", GEOM, std::iter::empty()));
        }
        scene.edit(compat, |m| {
            m.geom_pos[geom.index()] = [0.0; 3];
            m.geom_contype[geom.index()] = 1;
            m.geom_conaffinity[geom.index()] = 1;
        })?;
        Ok(Terrain { relief, fixed, heights: vec![0.0; CELLS] })
    }

    /// Fills the height field.
    ///
    /// # Errors
    /// Never, with the ranges of this task.
    pub fn draw(&mut self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        match self.relief {
            Relief::Rough => {
                formulas::noise(&mut self.heights, 0.5, rng)?;
                self.heights.iter_mut().for_each(|height| *height = ROUGH[0] + ROUGH[1] * *height);
            }
            Relief::Hilly => {
                let scale = if self.fixed { 0.63 } else { rng.uniform(0.53, 0.73)? };
                self.fill(|cell| scale * hill(cell));
            }
            Relief::Stairs => {
                let scale = if self.fixed { 2.5 } else { rng.uniform(1.5, 3.5)? };
                self.fill(|cell| scale * stair(cell));
            }
        }
        scene.overwrite(|m| {
            for (elevation, &height) in m.hfield_data.iter_mut().zip(&self.heights) {
                *elevation = height as f32;
            }
        })?;
        Ok(())
    }

    /// Writes heights by the number of cells before them on the way of the legs, which is against the order of the cells.
    fn fill(&mut self, height: impl Fn(usize) -> f64) {
        for (cell, place) in self.heights.iter_mut().rev().enumerate() {
            *place = height(cell);
        }
    }
}

/// The height of a hilly cell, from 0 to 1.
fn hill(cell: usize) -> f64 {
    match cell.checked_sub(BEFORE_HILLS) {
        None => 1.0,
        Some(cell) => formulas::hill(cell as f64 * HILLS * PI / (CELLS - BEFORE_HILLS - 1) as f64),
    }
}

/// The height of a cell of the stairs.
fn stair(cell: usize) -> f64 {
    cell.checked_sub(BEFORE_STAIRS).map_or(0.0, |cell| (cell / STEP) as f64 * RISE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hills_and_stairs_follow_a_flat_part() {
        assert_eq!([hill(0), hill(BEFORE_HILLS)], [1.0, 1.0]);
        let last = hill(CELLS - 1);
        assert!(last.abs() < 1e-12, "{last}");
        assert_eq!([stair(0), stair(BEFORE_STAIRS + STEP - 1)], [0.0, 0.0]);
        assert!((stair(CELLS - 1) - 11.0 * RISE).abs() < 1e-15);
    }
}
