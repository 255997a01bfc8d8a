//! Two balls that circle each other in the palm.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::baoding::{Following, KEYS, jumps, wrist_error};
use crate::suite::circling::{Circling, draw_radii, open_hand};
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::f64::consts::FRAC_PI_4;

/// Angles \[rad\] at which the balls start on their path.
const STARTS: [f64; 2] = [3.0 * FRAC_PI_4, -FRAC_PI_4];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    n_shifts_per_period: Option<i64>,
    #[serde(default = "drop_th")]
    drop_th: f64,
    #[serde(default = "proximity_th")]
    proximity_th: f64,
    #[serde(default = "goal_time_period")]
    goal_time_period: [f64; 2],
    #[serde(default = "goal_xrange")]
    goal_xrange: [f64; 2],
    #[serde(default = "goal_yrange")]
    goal_yrange: [f64; 2],
    #[serde(default)]
    muscle_condition: Condition,
}

fn drop_th() -> f64 {
    1.25
}

fn proximity_th() -> f64 {
    0.015
}

fn goal_time_period() -> [f64; 2] {
    [5.0; 2]
}

fn goal_xrange() -> [f64; 2] {
    [0.025; 2]
}

fn goal_yrange() -> [f64; 2] {
    [0.028; 2]
}

#[derive(Clone)]
pub struct Baoding {
    muscles: Muscles,
    circling: Circling,
    radii: [[f64; 2]; 2],
    period: [f64; 2],
    drop: f64,
    near: f64,
    compat: Compat,
}

impl Baoding {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or sites are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let jumps = jumps(setup.spec, args.n_shifts_per_period)?;
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let radii = [args.goal_xrange, args.goal_yrange];
        let period = args.goal_time_period;
        let drawn = draw_radii(radii, setup.rng)?;
        let mut circling = Circling::new(setup.scene, drawn, period[0], STARTS)?;
        circling.orbit.jumps = jumps;
        Ok(Baoding {
            muscles,
            circling,
            radii,
            period,
            drop: args.drop_th,
            near: args.proximity_th,
            compat: setup.compat,
        })
    }
}

impl Task for Baoding {
    fn defaults(&self) -> Defaults {
        let weights = [
            ("pos_dist_1", 5.0),
            ("pos_dist_2", 5.0),
            ("drop_penalty", 500.0),
            ("wrist_angle", 0.5),
            ("act_mag", 1.0),
            ("bonus", 1.0),
        ];
        Defaults { success: Success::Share, ..self.muscles.defaults(&KEYS, &weights) }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        open_hand(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        self.circling.orbit.radii = draw_radii(self.radii, episode.rng)?;
        self.circling.orbit.period = episode.rng.uniform(self.period[0], self.period[1])?;
        if self.compat == Compat::Fixed {
            // In the original, targets stay where the episode before left them until the first step.
            self.circling.place_targets(episode.scene, 0, 0.0)?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.circling.place_targets(turn.scene, turn.steps, turn.dt)?;
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.circling.pairs.observe(view, rows);
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let following = Following::of(rows, self.near, self.drop);
        let [first, second] = following.distances;
        terms.set("pos_dist_1", "m", [-first]);
        terms.set("pos_dist_2", "m", [-second]);
        terms.set("drop_penalty", "", [-f64::from(following.fallen)]);
        terms.set("wrist_angle", "rad", [-wrist_error(rows)]);
        terms.set("act_mag", "", [-effort(rows)]);
        terms.set("bonus", "", [following.bonus()]);
        Verdict {
            sparse: -(first + second),
            solved: following.both() && !following.fallen,
            done: following.fallen,
        }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
        self.circling.keep(keeper);
    }
}
