//! Turning: the valve is to come from one angle to another.

use super::valve::{Args, Valve};
use crate::assets::Assets;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::spec::Spec;
use crate::task::{Defaults, Episode, Setup, Task, Verdict, View};
use toml::Table;

/// Error of the angle [rad] below which the task is solved.
const SOLVED: f64 = 0.1;

#[derive(Clone)]
struct Turn {
    valve: Valve,
    target: [f64; 2],
}

/// Builds the task.
///
/// # Errors
/// Settings or elements of the model are missing.
pub fn build(
    spec: &Spec,
    own: Table,
    _: &dyn Assets,
    setup: &mut Setup<'_>,
) -> Result<Box<dyn Task>, EnvError> {
    let args: Args = spec.task_args(own)?;
    let (Some(target), None) = (args.target_angle_range, args.target_velocity_range) else {
        return Err(spec.wrong("turning needs target_angle_range and takes no target_velocity_range"));
    };
    let valve = Valve::new(spec, &args, SOLVED, setup)?;
    Ok(Box::new(Turn { valve, target }))
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

    fn boxed(&self) -> Box<dyn Task> {
        Box::new(self.clone())
    }
}
