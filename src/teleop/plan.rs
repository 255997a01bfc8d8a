//! What a session does by itself, and what became of a tick.

use crate::motion::Mark;
use crate::reached::Reached;
use record::Kept;

/// What a session does by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plan {
    /// Seed of the first reset; each episode that is kept or skipped takes the next.
    pub seed: u64,
    /// Episodes to keep, after which the session ends; 0 for as many as the person likes.
    pub episodes: usize,
    /// Steps after which an episode ends by itself, judged by the task; 0 for never.
    pub horizon: usize,
    /// Successive steps that solve the task after which an episode ends as a success; 0 for never.
    pub solved_for: usize,
    /// Pictures of the visual keys are kept too.
    pub images: bool,
}

/// An episode that is over.
#[derive(Clone, Debug)]
pub struct Finished {
    /// Its rows, ready for [`record::Recording::add`].
    pub kept: Kept,
    /// Seed of its reset.
    pub seed: u64,
    /// The person, or the task in their place, calls it a success.
    pub success: bool,
    /// Its steps.
    pub steps: usize,
    /// The sum of its rewards.
    pub reward: f64,
}

/// What a tick did.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct Ticked {
    /// An episode that ended, which the caller writes.
    pub finished: Option<Finished>,
    /// An episode was thrown away.
    pub discarded: bool,
    /// Time went on.
    pub stepped: bool,
    /// Whether the person made the step, where a policy shares control.
    pub by_hand: Option<bool>,
    /// Why the target was not taken.
    pub refused: Option<Reached>,
    /// Physics refused the step; the session went back by one state, and time stands still. On hardware, where the model could
    /// not show what the devices read, the episode is thrown away.
    pub fault: Option<String>,
    /// A mark that means nothing here: the time of hardware neither goes back nor slows down, and without a policy none is
    /// given control.
    pub impossible: Option<Mark>,
    /// The session is over.
    pub over: bool,
}
