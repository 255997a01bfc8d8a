//! Two bodies with feet, each of them an agent.

use super::part::{Part, team};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::locomotion::walker::{Disturbance, Posture, Walker};
use crate::task::{Episode, Pose, Setup, Turn, Verdict, View};
use crate::team::{Stakes, Team, prefix};
use robot::Keeper;

/// The two bodies, which are of the same kind.
#[derive(Clone, Copy)]
pub struct Bodies<'a> {
    /// Path of the roles of both.
    pub roles: &'a str,
    /// What makes episodes of both differ.
    pub disturbance: &'a Disturbance,
}

/// Two bodies.
#[derive(Clone)]
pub struct Pair {
    /// The bodies, in the order of the agents.
    pub walkers: [Walker; 2],
    /// The agents.
    pub team: Team,
}

impl Pair {
    /// The bodies of a task called `task`.
    ///
    /// # Errors
    /// The model does not fill the roles of an agent's body, or has no actuator of it.
    pub fn new(
        bodies: &Bodies<'_>,
        task: &str,
        parts: [Part<'_>; 2],
        stakes: Stakes,
        setup: &Setup<'_>,
    ) -> Result<Self, EnvError> {
        let walker = |part: &Part<'_>| {
            let disturbance = bodies.disturbance.clone();
            Walker::among_others(&prefix(part.name), bodies.roles, task, disturbance, setup)
        };
        let [a, b] = &parts;
        let team = team(&parts, &Walker::ROWS, stakes, setup.scene)?;
        Ok(Pair { walkers: [walker(a)?, walker(b)?], team })
    }

    /// The standing poses as initial one.
    pub fn initial_pose(&self, scene: &Scene, pose: &mut Pose) {
        self.walkers.iter().for_each(|walker| walker.initial_pose(&scene.model, pose));
    }

    /// Starts an episode: standing poses, joints a little off.
    ///
    /// # Errors
    /// The noise is no range.
    pub fn start(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walkers.iter_mut().try_for_each(|walker| walker.start(episode))
    }

    /// Pushes the bodies, where the settings ask for it.
    ///
    /// # Errors
    /// The push has no range.
    pub fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.walkers.iter_mut().try_for_each(|walker| walker.act(turn))
    }

    /// Writes the rows of each body; `more` adds those of the task, of the agent of a number.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows, more: impl Fn(usize, &Posture, &mut Rows)) {
        for (k, walker) in self.walkers.iter().enumerate() {
            let mate = view.data.kin.xpos[self.walkers[1 - k].root().index()];
            rows.within(walker.prefix(), |rows| {
                let posture = walker.observe(view, rows);
                rows.set("mate_error", "m", posture.towards(&mate));
                more(k, &posture, rows);
            });
        }
    }

    /// Writes the terms that the bodies have of the agents' own: how upright they are, whether the task is solved, whether
    /// they have fallen, which ends the episode. `more` adds those of the task.
    pub fn judge(
        &self,
        solved: bool,
        rows: &Rows,
        terms: &mut Rows,
        more: impl Fn(usize, &mut Rows),
    ) -> Verdict {
        let mut verdict = Verdict::default();
        for (k, walker) in self.walkers.iter().enumerate() {
            let own = terms.within(walker.prefix(), |terms| {
                more(k, terms);
                walker.judge(solved, rows, terms)
            });
            verdict = Verdict { done: own.done || verdict.done, ..own };
        }
        verdict
    }

    /// Whether the bodies touch each other.
    pub fn touch(&self, view: &View<'_>) -> bool {
        self.walkers[0].touches(view, self.walkers[1].root())
    }

    /// Writes, or reads, what the bodies remember from step to step.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        self.walkers.iter_mut().for_each(|walker| walker.keep(keeper));
    }
}
