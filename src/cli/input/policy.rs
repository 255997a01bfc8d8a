//! Policies by their names on the command line.

use crate::failure::Failure;
use agents::Policy;

/// The name of the policy that is shipped for an id.
pub const BEST: &str = "best";

/// The policy of a name, for the environments of an id: best, random, zero, or a file that holds one.
///
/// # Errors
/// None is shipped for the id; the file cannot be read, or holds no policy.
pub fn policy(name: &str, id: &str) -> Result<Policy, Failure> {
    match name {
        BEST => shipped(id)?.ok_or_else(|| {
            let ids: Vec<_> = assets::policies().collect();
            Failure::usage(format!(
                "no policy is shipped for {id}; there are some for {}; `robohive train {id}` trains one",
                ids.join(", ")
            ))
        }),
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
