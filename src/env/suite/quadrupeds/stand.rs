//! Standing: the robot is to stretch its legs from a crouch, or from anywhere.

use super::kitty::{Args, Kitty, Start};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Verdict, View};
use robot::Compat;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_4, FRAC_PI_6, PI};

/// The joints of a crouched leg \[rad\].
const CROUCH: [f64; 3] = [0.0, FRAC_PI_4, -FRAC_PI_2];

/// Mean error of the joints \[rad\] at which the task is solved.
const STRETCHED: f64 = PI / 12.0;

/// Distance of the marks \[m\], where the id gives none; nothing moves them.
const DISTANCE: [f64; 2] = [2.3, 2.3];

#[derive(Clone)]
pub struct Stand {
    kitty: Kitty,
    upright: f64,
    start: Start,
    compat: Compat,
}

impl Stand {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings, elements or the configuration are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let distance = args.target_distance_range.unwrap_or(DISTANCE);
        Ok(Stand {
            kitty: Kitty::new(&args, distance, setup)?,
            upright: args.upright_threshold.unwrap_or(0.0),
            start: args.reset_type.unwrap_or_default(),
            compat: setup.compat,
        })
    }
}

impl Task for Stand {
    fn defaults(&self) -> Defaults {
        let obs_keys = [
            "root_pos",
            "root_euler",
            "kitty_qpos",
            "root_vel",
            "root_angular_vel",
            "kitty_qvel",
            "last_action",
            "upright",
            "pose_error",
        ];
        Kitty::defaults(
            &obs_keys,
            &[
                ("pose_error_cost", 4.0),
                ("center_distance_cost", 2.0),
                ("bonus_small", 5.0),
                ("bonus_big", 10.0),
                ("upright", 1.0),
                ("falling", 100.0),
            ],
        )
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        match self.start {
            Start::Fixed => {
                let legs = &mut episode.start.qpos[self.kitty.legs()];
                legs.iter_mut().zip(CROUCH.iter().cycle()).for_each(|(angle, &crouched)| *angle = crouched);
            }
            Start::Random => {
                for limit in &self.kitty.limits {
                    episode.start.qpos[limit.place] = episode.rng.uniform(limit.range[0], limit.range[1])?;
                }
            }
        }
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.kitty.observe("last_action", view, rows);
        // Legs are straight at zero.
        rows.set(
            "pose_error",
            "rad",
            view.data.state.qpos[self.kitty.legs()].iter().map(|angle| 0.0 - angle),
        );
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (errors, upright) = (&rows["pose_error"], rows["upright"][0]);
        let error = errors.iter().map(|angle| angle.abs()).sum::<f64>() / errors.len() as f64;
        let (fallen, solved) = (upright < self.upright, error < STRETCHED && upright > 0.9);
        // The original takes the height in, and bounds the score from the wrong side.
        let (centre, score) = match self.compat {
            Compat::RoboHive07 => (norm(&rows["root_pos"]), 1.0 - (error / FRAC_PI_3).max(1.0)),
            Compat::Fixed => (norm(&rows["root_pos"][..2]), 1.0 - (error / FRAC_PI_3).min(1.0)),
        };
        terms.set("upright", "", [(upright - self.upright) / (1.0 - self.upright)]);
        terms.set("falling", "", [-f64::from(fallen)]);
        terms.set("pose_error_cost", "rad", [-error]);
        terms.set("center_distance_cost", "m", [-centre]);
        terms.set("bonus_small", "", [f64::from(error < FRAC_PI_6) * upright]);
        terms.set("bonus_big", "", [f64::from(solved)]);
        Verdict { sparse: score, solved, done: fallen }
    }
}
