//! Whether an environment keeps its contract: spaces, finite numbers, repeatable episodes, saved states, observations that
//! say something.
//!
//! ```
//! use robohive_env::{Env, Options, OwnModels, check};
//!
//! let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default())?;
//! let report = check::check(&mut env, 1, 5)?;
//! assert!(report.violations.is_empty(), "{:?}", report.violations);
//! # Ok::<(), robohive_env::EnvError>(())
//! ```

use crate::draws::Rng;
use crate::environment::Env;
use crate::error::EnvError;
use crate::pictures::eyes::{Exteroception, Pixels};
use std::fmt;

/// What an environment broke.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Violation {
    /// An observation or reward is NaN or infinite.
    NotFinite {
        /// Step of the episode, zero for the reset.
        step: usize,
        /// The row or value.
        name: String,
    },
    /// The same seed gave another episode.
    NotRepeatable {
        /// First step that differs.
        step: usize,
    },
    /// A restored state continued otherwise.
    StateLost {
        /// First step after the restored one that differs.
        step: usize,
    },
    /// Physics refused a step under random actions.
    Fault {
        /// Step of the episode.
        step: usize,
        /// Why.
        message: String,
    },
    /// Every value of a row stayed what it was, through actions and resets, and the task does not say that it does.
    Constant {
        /// The row.
        name: String,
    },
    /// A row that the task says is constant changed.
    NotConstant {
        /// The row.
        name: String,
    },
    /// An image holds NaN or infinities.
    ImageNotFinite {
        /// The visual key.
        key: String,
    },
    /// All pixels of an image are the same.
    Blank {
        /// The visual key.
        key: String,
    },
    /// The same state was drawn otherwise.
    ImageNotRepeatable {
        /// The visual key.
        key: String,
        /// How the state came back.
        after: &'static str,
    },
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Violation::NotFinite { step, name } => write!(f, "{name} is not finite at step {step}"),
            Violation::NotRepeatable { step } => {
                write!(f, "the same seed gives another episode from step {step} on")
            }
            Violation::StateLost { step } => write!(f, "a restored state differs after {step} steps"),
            Violation::Fault { step, message } => write!(f, "physics refuses step {step}: {message}"),
            Violation::Constant { name } => write!(f, "the observation {name} never changes"),
            Violation::NotConstant { name } => {
                write!(f, "the observation {name} is called constant, and changes")
            }
            Violation::ImageNotFinite { key } => write!(f, "{key} is not finite"),
            Violation::Blank { key } => write!(f, "{key} shows nothing: its pixels are all the same"),
            Violation::ImageNotRepeatable { key, after } => {
                write!(f, "{key} differs after {after}, in the same state")
            }
        }
    }
}

/// What a check saw.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What was broken; nothing in an environment that keeps its contract.
    pub violations: Vec<Violation>,
    /// Steps taken.
    pub steps: usize,
    /// Episodes that the task ended.
    pub terminated: usize,
}

/// Longest episode that a check plays.
pub const STEPS: usize = 1000;
/// Resets that show what they draw.
const RESETS: u64 = 3;
/// Steps after a restored state.
const RESTORED: usize = 10;

/// Plays seeded episodes of random actions, at most `steps` long, and checks the contract.
///
/// # Errors
/// The environment cannot be reset or stepped at all.
pub fn check(env: &mut Env, seed: u64, steps: usize) -> Result<Report, EnvError> {
    let mut report = Report::default();
    let first = episode(env, seed, steps, Some(&mut report))?;
    let mut varied = Varied::new(&first, env);
    let mut again = episode(env, seed, steps, None)?;
    if let Some(step) = differing(&first, &again) {
        report.violations.push(Violation::NotRepeatable { step });
    }
    let (constant, resting) = (env.constant_rows(), env.resting_rows());
    for reset in 1..=RESETS {
        again = vec![env_rows(env, reset)?];
        varied.see(&again);
    }
    for (row, varies) in varied.rows(env) {
        match (varies, constant.contains(&row)) {
            (false, false) if resting.contains(&row) => {}
            (false, false) => report.violations.push(Violation::Constant { name: row }),
            (true, true) => report.violations.push(Violation::NotConstant { name: row }),
            _ => {}
        }
    }
    if let Some(step) = state_round_trip(env, seed)? {
        report.violations.push(Violation::StateLost { step });
    }
    Ok(report)
}

/// Steps before an image is drawn.
const BEFORE_IMAGES: usize = 3;

/// Draws the images of the visual keys in a state, and once more after the same episode and from the saved state: finite,
/// not constant, the same to the last bit.
///
/// # Errors
/// The environment cannot be reset or stepped at all, or its images cannot be drawn.
pub fn check_images(env: &mut Env, seed: u64) -> Result<Vec<Violation>, EnvError> {
    let mut violations = Vec::new();
    episode(env, seed, BEFORE_IMAGES, None)?;
    let (saved, seen) = (env.state(), env.exteroception()?.clone());
    for image in seen.images() {
        let key = image.name().to_string();
        let (finite, varied) = match image.pixels() {
            Pixels::Bytes(bytes) => (true, bytes.iter().any(|byte| *byte != bytes[0])),
            Pixels::Numbers(x) => (x.iter().all(|x| x.is_finite()), x.iter().any(|value| *value != x[0])),
        };
        if !finite {
            violations.push(Violation::ImageNotFinite { key });
        } else if !varied {
            violations.push(Violation::Blank { key });
        }
    }
    let mut compare = |again: &Exteroception, after| {
        let pairs = seen.images().iter().zip(again.images());
        let differing = pairs.filter(|(first, second)| first.pixels() != second.pixels());
        violations.extend(differing.map(|(image, _)| {
            let key = image.name().to_string();
            Violation::ImageNotRepeatable { key, after }
        }));
    };
    episode(env, seed, BEFORE_IMAGES, None)?;
    compare(env.exteroception()?, "the same episode");
    env.reset(Some(seed + 1))?;
    env.exteroception()?;
    env.set_state(&saved)?;
    compare(env.exteroception()?, "the return to a saved state");
    Ok(violations)
}

/// The rows after a seeded reset.
fn env_rows(env: &mut Env, seed: u64) -> Result<Vec<f64>, EnvError> {
    env.reset(Some(seed))?;
    Ok(env.rows().values().to_vec())
}

/// All rows of every state of an episode of random actions.
fn episode(
    env: &mut Env,
    seed: u64,
    steps: usize,
    mut report: Option<&mut Report>,
) -> Result<Vec<Vec<f64>>, EnvError> {
    let mut rng = Rng::pcg64(seed);
    let mut action = vec![0.0; env.action_len()];
    let mut seen = vec![env_rows(env, seed)?];
    note_infinities(env, 0, report.as_deref_mut());
    for step in 1..=steps {
        env.random_action(&mut rng, &mut action)?;
        let outcome = env.step(&action)?;
        seen.push(env.rows().values().to_vec());
        if let Some(report) = report.as_deref_mut() {
            report.steps += 1;
            report.terminated += usize::from(outcome.terminated);
            if let Some(fault) = &outcome.fault {
                report.violations.push(Violation::Fault { step, message: fault.to_string() });
            }
        }
        note_infinities(env, step, report.as_deref_mut());
        if outcome.terminated || outcome.truncated {
            break;
        }
    }
    Ok(seen)
}

fn note_infinities(env: &Env, step: usize, report: Option<&mut Report>) {
    let Some(report) = report else { return };
    let rows = env.rows().iter().chain(env.terms().iter());
    for (row, values) in rows {
        if values.iter().any(|value| !value.is_finite()) {
            report.violations.push(Violation::NotFinite { step, name: row.name().to_string() });
        }
    }
}

fn differing(first: &[Vec<f64>], second: &[Vec<f64>]) -> Option<usize> {
    let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
    let step = first.iter().zip(second).position(|(a, b)| !same(a, b));
    step.or((first.len() != second.len()).then_some(first.len().min(second.len())))
}

/// Saves a state in the middle of an episode, goes on, returns to it, and goes on again: the first step that differs.
fn state_round_trip(env: &mut Env, seed: u64) -> Result<Option<usize>, EnvError> {
    episode(env, seed, RESTORED, None)?;
    env.reset(Some(seed))?;
    let mut rng = Rng::pcg64(seed + 1);
    let mut action = vec![0.0; env.action_len()];
    for _ in 0..3 {
        env.random_action(&mut rng, &mut action)?;
        env.step(&action)?;
    }
    let saved = env.state();
    let mut go_on = |env: &mut Env| -> Result<Vec<Vec<f64>>, EnvError> {
        let mut rng = Rng::pcg64(seed + 2);
        let mut seen = vec![env.rows().values().to_vec()];
        for _ in 0..RESTORED {
            env.random_action(&mut rng, &mut action)?;
            if env.step(&action)?.fault.is_some() {
                break;
            }
            seen.push(env.rows().values().to_vec());
        }
        // What the next episode draws belongs to the state.
        env.reset(None)?;
        seen.push(env.rows().values().to_vec());
        Ok(seen)
    };
    let first = go_on(env)?;
    env.set_state(&saved)?;
    Ok(differing(&first, &go_on(env)?))
}

/// Which values of the rows have changed.
struct Varied {
    first: Vec<f64>,
    changed: Vec<bool>,
}

impl Varied {
    fn new(seen: &[Vec<f64>], env: &Env) -> Self {
        let first = seen.first().cloned().unwrap_or_else(|| env.rows().values().to_vec());
        let mut varied = Varied { changed: vec![false; first.len()], first };
        varied.see(seen);
        varied
    }

    fn see(&mut self, seen: &[Vec<f64>]) {
        for values in seen {
            for (k, value) in values.iter().enumerate() {
                self.changed[k] |= value.to_bits() != self.first[k].to_bits();
            }
        }
    }

    /// Every row that the observation vector shows, and whether any of its values changed.
    fn rows(&self, env: &Env) -> Vec<(String, bool)> {
        let mut rows: Vec<(String, bool)> = Vec::new();
        for key in env.obs_keys() {
            let varies = env.rows().place(key).is_some_and(|place| self.changed[place].contains(&true));
            if !rows.iter().any(|(row, _)| row == key) {
                rows.push((key.clone(), varies));
            }
        }
        rows
    }
}
