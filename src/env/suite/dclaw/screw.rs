//! Screwing: the valve is to follow a mark that turns at a constant velocity.

use super::valve::{Args, Valve};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Turn, Verdict, View};
use robot::Keeper;

/// Error of the angle \[rad\] below which the task is solved.
const SOLVED: f64 = 0.2;

#[derive(Clone)]
pub struct Screw {
    valve: Valve,
    velocities: [f64; 2],
    /// Angle of the mark in this episode \[rad\], whole turns included.
    angle: f64,
    /// Velocity of the mark in this episode \[rad/s\].
    velocity: f64,
}

impl Screw {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings or elements of the model are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let (Some(velocities), None) = (args.target_velocity_range, args.target_angle_range) else {
            return Err(setup.wrong("screwing needs target_velocity_range and takes no target_angle_range"));
        };
        let valve = Valve::new(&args, SOLVED, setup)?;
        Ok(Screw { valve, velocities, angle: 0.0, velocity: 0.0 })
    }
}

impl Task for Screw {
    fn defaults(&self) -> Defaults {
        Valve::defaults()
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.angle = self.valve.start(episode)?;
        self.velocity = episode.rng.uniform(self.velocities[0], self.velocities[1])?;
        self.valve.point(episode.scene, self.angle)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.angle += self.velocity * turn.dt;
        self.valve.point(turn.scene, self.angle)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.valve.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        self.valve.reward(rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.number(&mut self.angle);
        keeper.number(&mut self.velocity);
    }
}
