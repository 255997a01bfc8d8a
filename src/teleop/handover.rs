//! Control shared by a policy and a person: the policy acts until the person takes control, and again after it is handed back.

use crate::error::TeleopError;
use crate::motion::Motion;
use agents::Policy;
use env::Env;

/// The dataset of a trial with who acted in each state: true for the person, false for the policy and in the last state.
pub const INTERVENTION: &str = "env_infos/intervention";

/// A policy, and who acts. A copy is sufficient to continue an episode from here.
#[derive(Clone)]
pub struct Handover {
    policy: Policy,
    by_hand: bool,
    action: Vec<f64>,
}

impl Handover {
    /// Shared control that starts with the policy.
    pub fn new(policy: &Policy, seed: u64) -> Self {
        Handover { policy: policy.for_episode(seed), by_hand: false, action: Vec::new() }
    }

    /// Begins an episode from the reset of a seed: the policy acts.
    pub fn begin(&mut self, seed: u64) {
        *self = Handover::new(&self.policy, seed);
    }

    /// The person acts.
    pub fn by_hand(&self) -> bool {
        self.by_hand
    }

    /// Hands control over; returns whether the person has it now.
    pub fn hand_over(&mut self) -> bool {
        self.by_hand = !self.by_hand;
        self.by_hand
    }

    /// Whether the person takes control by any motion. A hand in a glove never rests: with it only the mark takes control.
    pub fn takes_over(&mut self, motion: &Motion) -> bool {
        let takes = motion.touches() && !self.by_hand;
        self.by_hand |= takes;
        takes
    }

    /// The policy's action in this state; `None` while the person acts.
    ///
    /// # Errors
    /// The policy is one for another environment.
    pub fn action(&mut self, env: &Env) -> Result<Option<&[f64]>, TeleopError> {
        if self.by_hand {
            return Ok(None);
        }
        self.action.resize(env.action_len(), 0.0);
        self.policy.action(env, &mut self.action)?;
        Ok(Some(&self.action))
    }
}
