//! Teachers of runs, and what they show.

use crate::error::PolicyError;
use crate::learn::{Demonstrations, Teacher, Teaching};
use crate::policy::Policy;
use env::Env;

/// The teacher of a name for an environment: a controller, or the policy in a file.
///
/// # Errors
/// There is no such controller and no such file; the controller serves other environments.
pub fn teacher(name: &str, env: &Env) -> Result<Box<dyn Teacher + Send>, PolicyError> {
    let fail = |message| PolicyError::Teacher { id: env.spec().id.clone(), message };
    if control::controllers().iter().any(|entry| entry.name == name) {
        let controller = control::make(name, env).map_err(|error| fail(error.to_string()))?;
        return Ok(Box::new(controller));
    }
    let policy = Policy::open(name).map_err(|error| {
        fail(format!(
            "a teacher is a controller or the file of a policy, and {name} is no controller: {error}; `robohive run {} \
             --controller list` shows controllers",
            env.spec().id
        ))
    })?;
    Ok(Box::new(policy))
}

/// What a teacher shows in environments like `env`; each of its episodes is told of.
///
/// # Errors
/// [`teacher`] finds none; it succeeds too rarely, or cannot act.
pub(super) fn shown(
    teaching: &Teaching,
    seed: u64,
    env: &Env,
    tell: impl FnMut(&Demonstrations),
) -> Result<Demonstrations, PolicyError> {
    let mut env = env.fork()?;
    let mut teacher = teacher(&teaching.by, &env)?;
    Demonstrations::play(&mut env, &mut *teacher, teaching.lessons, seed, tell)
}
