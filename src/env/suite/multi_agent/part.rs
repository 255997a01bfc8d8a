//! The part of an agent in a task, beside what its kind of robot observes.

use crate::error::EnvError;
use crate::scene::Scene;
use crate::team::{Agent, Stakes, Team};

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
