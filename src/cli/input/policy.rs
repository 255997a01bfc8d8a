//! Policies by their names on the command line.

use crate::failure::Failure;
use agents::{Policy, PolicyError};

/// The name of the policy that is shipped for an id.
pub const BEST: &str = "best";

/// The policy of a name, for the environments of an id: best, random, zero, or a file that holds one.
///
/// # Errors
/// None is shipped for the id, or best is asked for without one; the file cannot be read, or holds no policy.
pub fn policy(name: &str, id: Option<&str>) -> Result<Policy, Failure> {
    match name {
        BEST => {
            let id = id.ok_or_else(|| {
                Failure::usage("best is the policy that is shipped for an id: give an ID after it")
            })?;
            Policy::best(id).map_err(Failure::usage)
        }
        "random" => Ok(Policy::random(0)),
        "zero" => Ok(Policy::Zero),
        path => Policy::open(path).map_err(|error| {
            Failure::usage(format!("--policy must be best, random, zero or a file with a policy: {error}"))
        }),
    }
}

/// The policy that is shipped for an id.
pub fn shipped(id: &str) -> Result<Option<Policy>, Failure> {
    Policy::shipped(id).map_err(Failure::new)
}

/// What was wrong: with what was given, or with what happened.
pub fn failure(error: PolicyError) -> Failure {
    match error {
        PolicyError::Env(_) | PolicyError::Reward { .. } => Failure::new(error),
        error => Failure::usage(error),
    }
}
