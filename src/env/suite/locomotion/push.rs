//! Pushes: at intervals the root of a body gets a velocity in a random direction.

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
    every: usize,
    /// The change of velocity that a push gives to the whole body, as a share of its walking speed; the force lasts one step of
    /// the environment.
    speed: f64,
    /// Steps since the last push.
    #[serde(skip)]
    since: usize,
}

impl Push {
    /// Counts from the beginning of an episode.
    pub fn restart(&mut self) {
        self.since = 0;
    }

    /// Pushes when it is time.
    ///
    /// # Errors
    /// The generator refuses, which it does not for this range.
    pub fn act(&mut self, root: BodyId, speed: f64, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.since += 1;
        let mut wrench = [0.0; 6];
        if self.since == self.every {
            self.since = 0;
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
        keeper.count(&mut self.since);
    }
}
