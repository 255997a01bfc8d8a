//! The plan of a session, and the outcome of a tick.

use crate::motion::Mark;
use crate::reached::Reached;
use record::Kept;

/// Settings of a session.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plan {
    /// Seed of the first reset; each episode that is kept or skipped takes the next.
    pub seed: u64,
    /// Number of episodes to keep, after which the session ends; 0 for no limit.
    pub episodes: usize,
    /// Steps after which an episode ends by itself, judged by the task; 0 for never.
    pub horizon: usize,
    /// Successive steps that solve the task after which an episode ends as a success; 0 for never.
    pub solved_for: usize,
    /// Whether the images of the visual keys are kept too.
    pub images: bool,
}

/// An episode that is over.
#[derive(Clone, Debug)]
pub struct Finished {
    /// Its rows, ready for [`record::Recording::add`].
    pub kept: Kept,
    /// Seed of its reset.
    pub seed: u64,
    /// Whether the person, or without a judgement the task, calls it a success.
    pub success: bool,
    /// Its steps.
    pub steps: usize,
    /// The sum of its rewards.
    pub reward: f64,
}

/// The outcome of a tick.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct Ticked {
    /// An episode that ended, for the caller to write.
    pub finished: Option<Finished>,
    /// An episode was discarded.
    pub discarded: bool,
    /// The environment made a step.
    pub stepped: bool,
    /// Whether the person acted in the step; `None` without a policy or a step.
    pub by_hand: Option<bool>,
    /// Why the target was refused.
    pub refused: Option<Reached>,
    /// The physics of the step failed: the session went back by one state, and time is paused. On hardware, where the model cannot
    /// mirror the readings of the devices, the episode is discarded.
    pub fault: Option<String>,
    /// A mark that does not apply: on hardware time neither goes back nor slows down, and without a policy there is no
    /// handover.
    pub impossible: Option<Mark>,
    /// The session is over.
    pub over: bool,
}
