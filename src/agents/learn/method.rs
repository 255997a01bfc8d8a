//! What improves a policy: its own latest episodes, or all that is remembered.

use super::actor::Actor;
use super::on_policy::{OnPolicy, Rule};
use super::sac::Soft;
use super::settings::{Algorithm, Settings};
use crate::archive::Entry;
use env::Rng;

/// What improves a policy.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// Its own latest episodes.
    OnPolicy(Box<OnPolicy>),
    /// All that is remembered.
    Soft(Box<Soft>),
}

impl Method {
    /// Before the first iteration.
    pub fn new(settings: &Settings, actor: &Actor, rng: &mut Rng) -> Self {
        let rule = match settings.algorithm {
            Algorithm::Sac(sac) => {
                let (own, hidden) = ((sac, settings.squashed()), &settings.hidden[1]);
                return Method::Soft(Box::new(Soft::new(own, hidden, settings.activation, actor, rng)));
            }
            Algorithm::Ppo(ppo) => Rule::Ppo(ppo),
            Algorithm::Npg(npg) => Rule::Npg(npg),
            Algorithm::Cloning(cloning) | Algorithm::Dagger(cloning) => Rule::Cloning(cloning),
            Algorithm::Dapg(dapg) => Rule::Dapg(dapg),
        };
        Method::OnPolicy(Box::new(OnPolicy::new(rule, settings, actor, rng)))
    }

    /// All that it keeps from one iteration to the next, by names.
    pub fn entries(&mut self) -> Vec<Entry<'_>> {
        match self {
            Method::OnPolicy(method) => method.entries(),
            Method::Soft(soft) => soft.entries(),
        }
    }
}
