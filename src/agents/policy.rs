//! What chooses actions.

use crate::archive::{self, Archive};
use crate::error::PolicyError;
use crate::learn::{Actor, Card, Teacher};
use crate::mjrl;
use crate::nets::Tape;
use crate::network::Network;
use crate::observation::Shown;
use env::episode::Summary;
use env::{Env, Rng};
use std::path::Path;

/// A policy.
#[derive(Clone)]
#[non_exhaustive]
pub enum Policy {
    /// Every action zero.
    Zero,
    /// Actions drawn uniformly from the action space.
    Random(Box<Rng>),
    /// The mean action of a Gaussian policy of the original.
    Mean(Box<Mean>),
    /// The mean action of a policy that was trained here.
    Trained(Box<Trained>),
}

/// The mean of a Gaussian policy as a function of what is observed.
#[derive(Clone)]
pub struct Mean {
    network: Network,
    /// What it is shown, in environments of an id.
    shown: Option<(String, Shown)>,
    input: Vec<f64>,
}

/// The mean action of a trained policy, with the bits that it has in training.
#[derive(Clone)]
pub struct Trained {
    actor: Actor,
    card: Card,
    tape: Tape,
    chosen: Vec<f32>,
}

impl Policy {
    /// Uniformly random actions, decided by a seed.
    pub fn random(seed: u64) -> Self {
        Policy::Random(Box::new(Rng::pcg64(seed)))
    }

    /// The mean action that a network computes.
    pub fn mean(network: Network) -> Self {
        Policy::Mean(Box::new(Mean { network, shown: None, input: Vec::new() }))
    }

    /// Reads a policy from a file: one that [`learn`](crate::learn) wrote, or a pickle of mjrl's Gaussian policies, which is not executed.
    ///
    /// # Errors
    /// The file cannot be read, or holds no policy that is understood.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, PolicyError> {
        let path = path.as_ref();
        let bytes = archive::read(path, archive::MAX_BYTES)?;
        Self::parse(&bytes).map_err(|error| error.within(path))
    }

    /// The policy that is shipped for the environments of an id; `None` where none is.
    ///
    /// # Errors
    /// The policy is one of another version.
    pub fn shipped(id: &str) -> Result<Option<Self>, PolicyError> {
        assets::policy(id).map(Self::parse).transpose()
    }

    /// The policy that is shipped for the environments of an id.
    ///
    /// # Errors
    /// None is shipped; the policy is one of another version.
    pub fn best(id: &str) -> Result<Self, PolicyError> {
        Self::shipped(id)?.ok_or_else(|| PolicyError::Unshipped { id: id.to_owned() })
    }

    /// Reads a policy from the bytes of a file.
    ///
    /// # Errors
    /// The bytes hold no policy that is understood.
    pub fn parse(bytes: &[u8]) -> Result<Self, PolicyError> {
        if !archive::is_archive(bytes) {
            return Ok(Self::mean(mjrl::read(bytes)?));
        }
        let archive = Archive::parse(bytes)?;
        let card = Card::of(&archive)?;
        let actor = card.actor(&archive)?;
        Ok(Policy::Trained(Box::new(Trained { actor, card, tape: Tape::default(), chosen: Vec::new() })))
    }

    /// The policy at the start of an episode: random actions are those of its seed.
    #[must_use]
    pub fn for_episode(&self, seed: u64) -> Self {
        match self {
            Policy::Random(_) => Policy::random(seed),
            other => other.clone(),
        }
    }

    /// Plays an episode, from a reset with this seed to its end.
    ///
    /// # Errors
    /// The environment cannot be reset or stepped; the policy is one for another.
    pub fn play(&self, env: &mut Env, seed: u64) -> Result<Summary, PolicyError> {
        let (mut policy, mut action) = (self.for_episode(seed), vec![0.0; env.action_len()]);
        let mut summary = Summary::default();
        env.reset(Some(seed))?;
        while !(summary.terminated || summary.truncated) {
            policy.action(env, &mut action)?;
            let step = env.step(&action)?;
            summary.add(env, &step);
        }
        Ok(summary)
    }

    /// Chooses an action for the present state of an environment.
    ///
    /// # Errors
    /// The policy is one for another environment; the action space cannot be drawn from.
    ///
    /// # Panics
    /// `action` is not as long as the environment's actions.
    pub fn action(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError> {
        assert_eq!(action.len(), env.action_len());
        match self {
            Policy::Zero => action.fill(0.0),
            Policy::Random(rng) => env.random_action(rng, action)?,
            Policy::Mean(mean) => mean.action(env, action)?,
            Policy::Trained(trained) => trained.action(env, action)?,
        }
        Ok(())
    }
}

impl Teacher for Policy {
    fn begin(&mut self, _: &Env, seed: u64) -> Result<(), PolicyError> {
        *self = self.for_episode(seed);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError> {
        self.action(env, action)
    }
}

impl Trained {
    /// What its file says of it.
    pub fn card(&self) -> &Card {
        &self.card
    }

    fn action(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError> {
        let sizes = [env.observation().len(), action.len()];
        if sizes != [self.card.observed, self.card.actions] {
            let Card { id, observed, actions, .. } = &self.card;
            let [seen, taken] = sizes;
            let message = format!(
                "it was trained on {id} and takes {observed} observed numbers to {actions} actions; here are {seen} and {taken}"
            );
            return Err(PolicyError::Foreign { id: env.spec().id.clone(), message });
        }
        self.actor.forward(&self.actor.normalized(env.observation()), &mut self.tape);
        self.chosen.resize(action.len(), 0.0);
        self.actor.mean(self.tape.output(), &mut self.chosen);
        action.iter_mut().zip(&self.chosen).for_each(|(to, from)| *to = f64::from(*from));
        Ok(())
    }
}

impl Mean {
    fn action(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError> {
        let outputs = self.network.outputs();
        if outputs != action.len() {
            let message = format!("it gives actions of {outputs} values, and {} are taken", action.len());
            return Err(PolicyError::Foreign { id: env.spec().id.clone(), message });
        }
        let id = &env.spec().id;
        let (_, shown) = match self.shown.take() {
            Some(shown) if shown.0 == *id => self.shown.insert(shown),
            _ => self.shown.insert((id.clone(), Shown::find(env, self.network.inputs())?)),
        };
        shown.gather(env, &mut self.input);
        self.network.compute(&self.input, action);
        Ok(())
    }
}
