//! The part of an agent in a task, beside what its kind of robot observes.

use crate::error::EnvError;
use crate::scene::Scene;
use crate::suite::locomotion::FRAME_SKIP;
use crate::task::{Defaults, Success};
use crate::team::{Agent, Stakes, Team, prefix};

/// Steps in which a task is to be solved for a success: more than these, 0.5 s.
pub const STEPS: usize = 25;

/// What an agent observes and earns.
pub struct Part<'a> {
    /// Its name.
    pub name: &'a str,
    /// Rows beside those of its kind of robot.
    pub rows: &'a [&'a str],
    /// Weights of terms of its own.
    pub own: &'a [(&'a str, f64)],
    /// Weights of terms that both have.
    pub shared: &'a [(&'a str, f64)],
}

/// The agents of these parts, which observe the rows `kind` of their kind of robot, where the other is (`mate_error`), and their own.
///
/// # Errors
/// The model has no actuator of an agent.
pub fn team(parts: &[Part<'_>], kind: &[&str], stakes: Stakes, scene: &Scene) -> Result<Team, EnvError> {
    let agent = |part: &Part<'_>| {
        let rows = [kind, &["mate_error"], part.rows].concat();
        Ok(Agent::new(part.name, scene, &rows, &[])?.earning(part.own, part.shared))
    };
    Ok(Team::new(parts.iter().map(agent).collect::<Result<_, EnvError>>()?, stakes))
}

/// Defaults of a task that succeeds if it is solved in more than `steps` steps. Proprioception is the joints of all agents.
pub fn defaults(team: &Team, steps: usize) -> Defaults {
    let own = |agent: &Agent| ["joint_pos", "joint_vel"].map(|row| prefix(agent.name()) + row);
    let proprio = team.agents().iter().flat_map(own).collect();
    let defaults = Defaults::new(&team.obs_keys(), &team.weights(), FRAME_SKIP);
    Defaults { success: Success::MoreThan(steps), proprio_keys: Some(proprio), ..defaults }
}
