//! The Furuta pendulum: a pendulum at the end of an arm that a motor turns about the vertical is to be swung up and balanced (Furuta,
//! Yamakita and Kobayashi, Swing-up control of inverted pendulum using pseudo-state feedback, 1992; Åström and Furuta, Swinging up a
//! pendulum by energy control, Automatica 36, 2000). Sizes and masses are near those of Quanser's QUBE-Servo 2.
//!
//! Action: torque of the motor, -1 to 1 for -0.05 to 0.05 N m. Observation: cosine and sine of the arm, cosine and sine of the
//! pendulum from upright, velocities \[rad/s\], seconds for which the pendulum has been upright. Dense reward: cosine of the
//! pendulum's angle, one more while it is upright, 100 at the end. Sparse reward: 1 while it is upright. Solved: less than 0.1 rad
//! from upright for 2 s, which ends the episode. Episodes start hanging, within 0.1 rad, the arm anywhere, and last 10 s.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Angle from upright that counts as upright \[rad\].
    angle: f64,
    /// How long it is to stay there \[s\].
    hold: f64,
    /// Largest angle from hanging at the start \[rad\].
    joint_noise: f64,
}

#[derive(Clone)]
pub struct Furuta {
    angle: f64,
    noise: f64,
    upright: Hold,
}

impl Furuta {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model is no arm with a pendulum.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let m = &setup.scene.model;
        if m.nq != 2 || m.nv != 2 {
            return Err(setup.wrong("the model has two joints: the arm's, then the pendulum's"));
        }
        Ok(Furuta { angle: args.angle, noise: args.joint_noise, upright: Hold::new(args.hold) })
    }

    fn holds(&self, data: &Data) -> bool {
        // Less than the angle from upright, on whatever turn.
        -ops::sincos(data.state.qpos[1]).1 > ops::sincos(self.angle).1
    }
}

impl Task for Furuta {
    fn defaults(&self) -> Defaults {
        let weights = [("upright", 1.0), ("held", 1.0), ("bonus", 100.0)];
        let defaults = Defaults::new(&["arm", "pendulum", "velocities", "held"], &weights, 5);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["arm", "pendulum", "velocities"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        episode.start.qpos[0] = episode.rng.uniform(-PI, PI)?;
        episode.start.qpos[1] = self.noise * episode.rng.uniform(-1.0, 1.0)?;
        self.upright.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.upright.leave(self.holds(&turn.scene.data));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (arm, pendulum) = (ops::sincos(view.data.state.qpos[0]), ops::sincos(view.data.state.qpos[1]));
        rows.set("arm", "", [arm.1, arm.0]);
        rows.set("pendulum", "", [-pendulum.1, -pendulum.0]);
        rows.set("velocities", "rad/s", &view.data.state.qvel);
        rows.set("held", "s", [self.upright.seconds(self.holds(view.data), view.dt)]);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        terms.set("upright", "", [rows["pendulum"][0]]);
        self.upright.judge(rows["held"][0], self.holds(view.data), false, terms)
    }

    fn rewards_paths(&self) -> bool {
        false
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.upright.keep(keeper);
    }
}
