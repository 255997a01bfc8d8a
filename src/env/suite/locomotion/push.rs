//! Pushes: at intervals the root of a body gets a velocity in a random direction.

use super::interval::Interval;
use crate::error::EnvError;
use crate::task::Turn;
use physics::elements::BodyId;
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;

/// When and how hard a body is pushed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Push {
    /// Steps of the environment from one push to the next.
    every: Interval,
    /// The change of velocity that a push gives to the whole body, as a share of its walking speed; the force lasts one step of
    /// the environment.
    speed: f64,
}

impl Push {
    /// Counts from the beginning of an episode.
    pub fn restart(&mut self) {
        self.every.restart();
    }

    /// Pushes when it is time.
    ///
    /// # Errors
    /// The generator refuses, which it does not for this range.
    pub fn act(&mut self, root: BodyId, speed: f64, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let mut wrench = [0.0; 6];
        if self.every.passes() {
            let mass = turn.scene.model.body_subtreemass[root.index()];
            let (sine, cosine) = ops::sincos(turn.rng.uniform(-PI, PI)?);
            let force = mass * self.speed * speed / turn.dt;
            wrench[..2].copy_from_slice(&[force * cosine, force * sine]);
        }
        turn.scene.data.body_mut(root).set_xfrc_applied(wrench);
        Ok(())
    }

    /// Writes, or reads, the steps since the last push.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        self.every.keep(keeper);
    }
}
