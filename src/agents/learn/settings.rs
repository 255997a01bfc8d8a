//! How a training learns.

use super::actor::Head;
use super::advantage::Horizon;
use super::dapg::Dapg;
use super::fit::Fit;
use super::npg::Npg;
use super::ppo::Ppo;
use super::sac::Sac;
use crate::nets::{Activation, Squashed};
use serde::{Deserialize, Serialize};

/// How a policy is improved.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[non_exhaustive]
#[serde(rename_all = "snake_case")]
pub enum Algorithm {
    /// Proximal policy optimisation.
    Ppo(Ppo),
    /// The natural policy gradient.
    Npg(Npg),
    /// Behaviour cloning: episodes are played to see what became of it, and only demonstrations are learnt from.
    Cloning(Fit),
    /// Behaviour cloning of a teacher who says what to do in every state that the policy comes to (dataset aggregation).
    Dagger(Fit),
    /// The natural policy gradient with demonstrations.
    Dapg(Dapg),
    /// Soft actor-critic.
    Sac(Sac),
}

impl Algorithm {
    /// All names, with what they stand for.
    pub const NAMES: [(&str, &str); 6] = [
        ("npg", "The natural policy gradient"),
        ("ppo", "Proximal policy optimisation"),
        ("sac", "Soft actor-critic: learns again and again from all it remembers, where steps are slow"),
        ("bc", "Behaviour cloning: only from demonstrations"),
        (
            "dagger",
            "Behaviour cloning of a teacher who corrects the policy's own episodes (dataset aggregation)",
        ),
        ("dapg", "The natural policy gradient with demonstrations"),
    ];

    /// Its name in short.
    pub fn name(&self) -> &'static str {
        match self {
            Algorithm::Ppo(_) => "ppo",
            Algorithm::Npg(_) => "npg",
            Algorithm::Cloning(_) => "bc",
            Algorithm::Dagger(_) => "dagger",
            Algorithm::Dapg(_) => "dapg",
            Algorithm::Sac(_) => "sac",
        }
    }

    /// Whether it learns from demonstrations.
    pub fn needs_demonstrations(&self) -> bool {
        matches!(self, Algorithm::Cloning(_) | Algorithm::Dagger(_) | Algorithm::Dapg(_))
    }

    /// Whether its teacher also says what to do in states that the policy comes to.
    pub fn needs_corrections(&self) -> bool {
        matches!(self, Algorithm::Dagger(_))
    }
}

/// Settings of a training.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// How the policy is improved.
    pub algorithm: Algorithm,
    /// Episodes of an iteration.
    pub episodes: u64,
    /// How far rewards count.
    pub horizon: Horizon,
    /// Widths of the hidden layers of the policy, and of the value function.
    pub hidden: [Vec<usize>; 2],
    /// What follows hidden layers.
    pub activation: Activation,
    /// Logarithm of the deviations at first, and their least. Where they depend on the state, their greatest is as far above the first.
    pub log_std: [f32; 2],
    /// How the value function is fitted: in passes over an iteration's steps, or over as many that are remembered.
    pub fit: Fit,
}

impl Settings {
    /// The distribution of actions.
    pub(super) fn head(&self) -> Head {
        let [log_std, least] = self.log_std;
        match self.algorithm {
            Algorithm::Sac(_) => Head::Squashed(self.squashed()),
            _ => Head::Gaussian { log_std, least },
        }
    }

    /// The distribution of actions where they are squashed.
    pub(super) fn squashed(&self) -> Squashed {
        let [first, least] = self.log_std;
        Squashed { first, least }
    }
}
