//! Which rows of an environment's observation a policy was trained on.

use crate::error::PolicyError;
use env::Env;
use std::ops::Range;

/// Observations that policies were trained on before an environment got the rows that it has now: its task, and the rows.
///
/// Those of the Adroit hand are of the first version of these tasks (Rajeswaran et al., 2018).
const EARLIER: [(&str, &[&str]); 3] = [
    (
        "adroit_door",
        &["hand_jnt", "latch_pos", "door_pos", "palm_pos", "handle_pos", "reach_err", "door_open"],
    ),
    (
        "adroit_hammer",
        &["hand_jnt", "obj_vel", "palm_pos", "obj_pos", "obj_rot", "target_pos", "nail_impact"],
    ),
    ("adroit_relocate", &["hand_jnt", "palm_obj_err", "palm_tar_err", "obj_tar_err"]),
];

/// What a policy is shown of an environment.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shown {
    /// The observation vector.
    All,
    /// These parts of the observation dictionary, one after the other.
    Parts(Vec<Range<usize>>),
}

impl Shown {
    /// Finds `len` values to show: the observation vector, or the vector of an earlier version of the task.
    ///
    /// # Errors
    /// Neither has this length.
    pub fn find(env: &Env, len: usize) -> Result<Self, PolicyError> {
        if env.observation().len() == len {
            return Ok(Shown::All);
        }
        for (_, rows) in EARLIER.iter().filter(|(task, _)| *task == env.spec().task) {
            let parts: Option<Vec<_>> = rows.iter().map(|row| env.rows().place(row)).collect();
            if let Some(parts) = parts
                && parts.iter().map(Range::len).sum::<usize>() == len
            {
                return Ok(Shown::Parts(parts));
            }
        }
        let message = format!("it takes {len} observed values, and there are {}", env.observation().len());
        Err(PolicyError::Foreign { id: env.spec().id.clone(), message })
    }

    /// Writes what is shown.
    pub fn gather(&self, env: &Env, out: &mut Vec<f64>) {
        out.clear();
        match self {
            Shown::All => out.extend_from_slice(env.observation()),
            Shown::Parts(parts) => {
                parts.iter().for_each(|part| out.extend_from_slice(&env.rows().values()[part.clone()]));
            }
        }
    }
}
