//! Ground that differs from episode to episode, under a body with feet.

use super::walker::Walker;
use crate::error::EnvError;
use crate::task::{Episode, Setup};
use crate::terrain::{Grid, Kind, Terrain, TerrainError};
use physics::math::ops;
use serde::Deserialize;

/// Name of the height field and of its geom.
const GROUND: &str = "ground";
/// Seeds that a ground is drawn from.
const SEEDS: f64 = 4_294_967_296.0;

/// The ground of a task.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FloorArgs {
    kind: Kind,
    /// From the lowest place to the highest, in heights of the root.
    height: f64,
    /// Half the side of the flat square where the body starts, in heights of the root.
    flat: f64,
}

/// Ground that is drawn again for every episode.
#[derive(Clone, Debug)]
pub struct Floor {
    terrain: Terrain,
    grid: Grid,
}

impl Floor {
    /// The ground in the model, which is turned so that stairs begin before the body.
    ///
    /// # Errors
    /// The model has no height field `ground`, or one that is too low.
    pub fn new(args: &FloorArgs, walker: &Walker, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let Some(field) = setup.scene.model.hfield(GROUND) else {
            return Err(setup.wrong(format!("the model has no height field `{GROUND}`")));
        };
        let geom = setup.scene.geom(GROUND)?.index();
        let grid = Grid::of(&setup.scene.model, field);
        let terrain =
            Terrain { kind: args.kind, height: args.height * walker.height, flat: args.flat * walker.height };
        let ground = terrain.draw(&grid, 0).map_err(|error| setup.wrong(error.to_string()))?;
        let [x, y] = walker.ahead_at_start();
        let (sine, cosine) = ops::sincos(ops::angle(y, x) / 2.0);
        setup.scene.model.edit(|m| {
            m.geom_pos[geom][2] = -ground.level;
            m.geom_quat[geom] = [cosine, 0.0, 0.0, sine];
        })?;
        Ok(Floor { terrain, grid })
    }

    /// Draws the ground of an episode.
    ///
    /// # Errors
    /// None that construction has not found.
    pub fn start(&self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let seed = episode.rng.uniform(0.0, SEEDS)? as u64;
        let refused = |error: TerrainError| EnvError::Table { message: error.to_string() };
        let ground = self.terrain.draw(&self.grid, seed).map_err(refused)?;
        ground.write(&mut episode.scene.model, GROUND).map_err(refused)
    }
}
