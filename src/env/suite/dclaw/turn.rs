//! Turning: the valve is to come from one angle to another.

use super::valve::{Args, Valve};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Verdict, View};

/// Error of the angle \[rad\] below which the task is solved.
const SOLVED: f64 = 0.1;

#[derive(Clone)]
pub struct Turn {
    valve: Valve,
    target: [f64; 2],
}

impl Turn {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings or elements of the model are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let (Some(target), None) = (args.target_angle_range, args.target_velocity_range) else {
            return Err(setup.wrong("turning needs target_angle_range and takes no target_velocity_range"));
        };
        let valve = Valve::new(&args, SOLVED, setup)?;
        Ok(Turn { valve, target })
    }
}

impl Task for Turn {
    fn defaults(&self) -> Defaults {
        Valve::defaults()
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.valve.start(episode)?;
        let target = episode.rng.uniform(self.target[0], self.target[1])?;
        self.valve.point(episode.scene, target)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.valve.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        self.valve.reward(rows, terms)
    }
}
