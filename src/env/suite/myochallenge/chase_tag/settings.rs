//! The settings of tag.

use super::opponent::OpponentArgs;
use super::relief;
use super::start::Start;
use super::terrain::{self, Heights, Terrain};
use crate::assets::Assets;
use crate::task::Setup;
use random::RandomState;
use robot::Compat;
use serde::Deserialize;
use std::cmp::Ordering;

/// Farthest that the opponent can be asked to appear from the agent: always possible on its ground \[m\].
const SPAWN_LIMIT: f64 = 5.0;
/// Rounding that sums of probabilities may have.
const ROUNDING: f64 = 1e-9;

/// What an id of tag says.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Args {
    /// How episodes start.
    pub reset_type: Start,
    /// Distance of a catch \[m\].
    pub win_distance: f64,
    /// Distance from the agent at which the opponent may appear \[m\].
    pub min_spawn_distance: f64,
    /// Whether the agent catches or escapes.
    pub task_choice: Choice,
    /// What it walks on.
    pub terrain: Ground,
    /// The file of the relief.
    pub relief: String,
    /// Heights of hills \[m\].
    pub hills_range: [f64; 2],
    /// Heights of rough ground \[m\].
    pub rough_range: [f64; 2],
    /// Heights of the relief \[m\].
    pub relief_range: [f64; 2],
    /// Whether the opponent may run away.
    pub repeller_opponent: bool,
    /// Speeds of a chasing opponent \[m/s\].
    pub chase_vel_range: [f64; 2],
    /// Bounds of random motion \[m/s, rad/s\].
    pub random_vel_range: [f64; 2],
    /// Bounds of the speed of an escape \[m/s\].
    pub repeller_vel_range: [f64; 2],
    /// How often the opponent stands at its place, stands anywhere, moves at random, and runs away.
    pub opponent_probabilities: Vec<f64>,
}

impl Default for Args {
    fn default() -> Self {
        Args {
            reset_type: Start::None,
            win_distance: 0.5,
            min_spawn_distance: 2.0,
            task_choice: Choice::Chase,
            terrain: Ground::Flat,
            relief: "envs/myo/assets/myo_relief.npy".into(),
            hills_range: [0.0; 2],
            rough_range: [0.0; 2],
            relief_range: [0.0; 2],
            repeller_opponent: false,
            chase_vel_range: [1.0; 2],
            random_vel_range: [1.0; 2],
            repeller_vel_range: [1.0; 2],
            opponent_probabilities: vec![0.1, 0.45, 0.45],
        }
    }
}

/// Who catches whom.
#[derive(Clone, Copy, PartialEq, Deserialize)]
pub enum Choice {
    #[serde(rename = "CHASE")]
    Chase,
    #[serde(rename = "EVADE")]
    Evade,
    #[serde(rename = "random")]
    Random,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
pub enum Ground {
    #[serde(rename = "FLAT")]
    Flat,
    #[serde(rename = "random")]
    Random,
}

impl Args {
    /// The opponent that the settings describe.
    ///
    /// # Errors
    /// Which setting is wrong, and what it should be.
    pub(super) fn opponent(&self) -> Result<OpponentArgs, String> {
        let count = if self.repeller_opponent { 4 } else { 3 };
        let probabilities = &self.opponent_probabilities;
        let proper = probabilities.iter().all(|p| (0.0..=1.0).contains(p));
        if probabilities.len() != count
            || !proper
            || (probabilities.iter().sum::<f64>() - 1.0).abs() > ROUNDING
        {
            return Err(format!("opponent_probabilities are {count} numbers from 0 to 1 whose sum is 1"));
        }
        let ranges = [
            ("chase_vel_range", self.chase_vel_range),
            ("random_vel_range", self.random_vel_range),
            ("repeller_vel_range", self.repeller_vel_range),
        ];
        if let Some((name, _)) =
            ranges.iter().find(|(_, [low, high])| low.partial_cmp(high).is_none_or(Ordering::is_gt))
        {
            return Err(format!("{name} begins above its end"));
        }
        if self.chase_vel_range[0] < 0.0 {
            return Err("chase_vel_range begins below zero".into());
        }
        if self.min_spawn_distance.is_nan() || self.min_spawn_distance > SPAWN_LIMIT {
            return Err(format!("min_spawn_distance is at most {SPAWN_LIMIT} m, which is always possible"));
        }
        Ok(OpponentArgs {
            probabilities: [probabilities[0], probabilities[1], probabilities[2]],
            repelled: self.repeller_opponent,
            spawn_distance: self.min_spawn_distance,
            chase_speeds: self.chase_vel_range,
            random_speeds: self.random_vel_range,
            escape_speeds: self.repeller_vel_range,
        })
    }

    /// The ground that the settings describe; `None` for flat ground.
    ///
    /// # Errors
    /// The model has no height field of the right size; the relief is missing or no image of the right size.
    pub(super) fn ground(&self, setup: &Setup<'_>, assets: &dyn Assets) -> Result<Option<Terrain>, String> {
        if self.terrain == Ground::Flat {
            return Ok(None);
        }
        let m = &setup.scene.model;
        let side = terrain::SIDE;
        if m.hfield_nrow.first() != Some(&(side as i32)) || m.hfield_ncol.first() != Some(&(side as i32)) {
            return Err(format!("its model has no height field of {side} times {side} samples"));
        }
        let image = relief::image(&self.relief, assets)?;
        let heights = Heights { hills: self.hills_range, rough: self.rough_range, relief: self.relief_range };
        let placing = (setup.compat == Compat::RoboHive07).then(|| RandomState::new(0));
        Terrain::new(heights, &image, placing)
            .map(Some)
            .map_err(|message| format!("{}: {message}", self.relief))
    }
}
