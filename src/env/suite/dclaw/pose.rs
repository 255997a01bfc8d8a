//! Posing: the joints are to take a pose, or to follow one that swings between two.

use super::claw::{Fingers, draw_pose, excess, last_action};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Turn, Verdict, View};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_4, FRAC_PI_6, PI};

/// Mean error of the joints \[rad\] below which the task is solved.
const SOLVED: f64 = PI / 18.0;

/// Mean error of the joints \[rad\] from which on the score is zero.
const LOST: f64 = FRAC_PI_4;

/// Velocity \[rad/s\] from which a joint counts as too fast.
const FAST: f64 = PI;

/// Angular frequencies of goals that swing \[rad/s\], and the highest velocity that they reach \[rad/s\].
const FREQUENCIES: [f64; 2] = [0.5, 2.0];
const GOAL_VELOCITY: f64 = FRAC_PI_6;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// First and last joint of the claw.
    dof_range_names: [String; 2],
    /// First and last joint of the second claw, which shows the goal.
    overlay_range_names: [String; 2],
    #[serde(default)]
    goal: GoalKind,
}

/// Whether the goal of an episode moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum GoalKind {
    /// A pose; the claw starts in another one.
    #[default]
    Fixed,
    /// A swing between two poses; the claw starts in the middle.
    Swing,
}

/// Where a joint is to be: an angle about which it swings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Goal {
    /// Middle of the swing \[rad\].
    centre: f64,
    /// Half its width \[rad\], zero for a goal at rest.
    amplitude: f64,
    /// Angular frequency \[rad/s\].
    frequency: f64,
}

impl Goal {
    /// A swing between two angles, its width reduced to what the velocity allows.
    fn between(a: f64, b: f64, frequency: f64) -> Self {
        let amplitude = (0.5 * (b - a).abs()).min(GOAL_VELOCITY / frequency);
        Goal { centre: 0.5 * (a + b), amplitude, frequency }
    }

    /// The angle at a time \[s\].
    fn at(&self, time: f64) -> f64 {
        self.centre + self.amplitude * ops::sin(self.frequency * time)
    }
}

#[derive(Clone)]
pub struct Posing {
    fingers: Fingers,
    overlay: Fingers,
    kind: GoalKind,
    /// The goal of every joint in this episode.
    goals: Vec<Goal>,
    /// The two poses that an episode draws \[rad\].
    drawn: [Vec<f64>; 2],
}

impl Posing {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings or joints are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let fingers = Fingers::new(setup.spec, setup.scene, &args.dof_range_names)?;
        let overlay = Fingers::new(setup.spec, setup.scene, &args.overlay_range_names)?;
        let count = fingers.qpos.len();
        if overlay.qpos.len() != count {
            let message = format!("the overlay has {} joints, and the claw {count}", overlay.qpos.len());
            return Err(setup.wrong(message));
        }
        let (goals, drawn) = (vec![Goal::default(); count], [vec![0.0; count], vec![0.0; count]]);
        Ok(Posing { fingers, overlay, kind: args.goal, goals, drawn })
    }
}

impl Task for Posing {
    fn defaults(&self) -> Defaults {
        let weights = [("pose_error_cost", 1.0), ("joint_vel_cost", 0.1)];
        Defaults::new(&["qpos", "last_action", "qpos_error"], &weights, 20).proprio(&["qpos"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for pose in &mut self.drawn {
            draw_pose(episode.rng, pose)?;
        }
        let [first, second] = &self.drawn;
        let claw = &mut episode.start.qpos[self.fingers.qpos.clone()];
        for (k, goal) in self.goals.iter_mut().enumerate() {
            (claw[k], *goal) = match self.kind {
                GoalKind::Fixed => (first[k], Goal { centre: second[k], ..Goal::default() }),
                GoalKind::Swing => {
                    let frequency = episode.rng.uniform(FREQUENCIES[0], FREQUENCIES[1])?;
                    let goal = Goal::between(first[k], second[k], frequency);
                    (goal.centre, goal)
                }
            };
        }
        episode.start.qvel.fill(0.0);
        let shown = &mut episode.start.qpos[self.overlay.qpos.clone()];
        shown.iter_mut().zip(&self.goals).for_each(|(angle, goal)| *angle = goal.at(0.0));
        Ok(())
    }

    /// Moves the overlay to where the goal is after this step; its friction holds it there.
    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let state = &mut turn.scene.data.state;
        let time = state.time + turn.dt;
        let shown = &mut state.qpos[self.overlay.qpos.clone()];
        shown.iter_mut().zip(&self.goals).for_each(|(angle, goal)| *angle = goal.at(time));
        state.qvel[self.overlay.qvel.clone()].fill(0.0);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (state, time) = (&view.data.state, view.data.time());
        let angles = &state.qpos[self.fingers.qpos.clone()];
        rows.set("qpos", "rad", angles);
        rows.set("qvel", "rad/s", &state.qvel[self.fingers.qvel.clone()]);
        rows.set("last_action", "", last_action(view));
        rows.set(
            "qpos_error",
            "rad",
            self.goals.iter().zip(angles).map(|(goal, angle)| goal.at(time) - angle),
        );
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let errors = &rows["qpos_error"];
        let mean = errors.iter().map(|error| error.abs()).sum::<f64>() / errors.len() as f64;
        terms.set("pose_error_cost", "rad", [-norm(errors)]);
        terms.set("joint_vel_cost", "rad/s", [-excess(&rows["qvel"], FAST)]);
        Verdict { sparse: 1.0 - (mean / LOST).min(1.0), solved: mean < SOLVED, done: false }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        for goal in &mut self.goals {
            keeper.number(&mut goal.centre);
            keeper.number(&mut goal.amplitude);
            keeper.number(&mut goal.frequency);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swings_are_as_wide_as_poses_and_velocity_allow() {
        let near = Goal::between(0.2, -0.2, 0.5);
        assert_eq!((near.centre, near.amplitude), (0.0, 0.2));
        let far = Goal::between(-1.5, 1.0, 2.0);
        assert_eq!((far.centre, far.amplitude), (-0.25, GOAL_VELOCITY / 2.0));
        assert!((far.at(PI / 4.0) - (far.centre + far.amplitude)).abs() < 1e-15);
        assert_eq!(Goal { centre: 0.3, ..Goal::default() }.at(7.0), 0.3);
    }
}
