//! Policies by their names on the command line.

use crate::failure::Failure;
use agents::Policy;

/// The policy of a name: random, zero, or a file that holds one.
///
/// # Errors
/// The file cannot be read, or holds no policy.
pub fn policy(name: &str) -> Result<Policy, Failure> {
    match name {
        "random" => Ok(Policy::random(0)),
        "zero" => Ok(Policy::Zero),
        path => Policy::open(path).map_err(|error| {
            Failure::usage(format!("--policy must be random, zero or a file with a policy: {error}"))
        }),
    }
}
