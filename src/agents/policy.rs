//! What chooses actions.

use crate::error::PolicyError;
use crate::mjrl;
use crate::network::Network;
use crate::observation::Shown;
use env::{Env, Rng};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Most bytes of a file. Those of RoboHive's policies have less than one MiB.
const MAX_BYTES: u64 = 64 << 20;

/// A policy.
#[derive(Clone)]
#[non_exhaustive]
pub enum Policy {
    /// Every action zero.
    Zero,
    /// Actions drawn uniformly from the action space.
    Random(Box<Rng>),
    /// The mean action of a Gaussian policy.
    Mean(Box<Mean>),
}

/// The mean of a Gaussian policy as a function of what is observed.
#[derive(Clone)]
pub struct Mean {
    network: Network,
    /// What it is shown, in environments of an id.
    shown: Option<(String, Shown)>,
    input: Vec<f64>,
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

    /// Reads a policy from a file: a pickle of mjrl's Gaussian policies, which is not executed.
    ///
    /// # Errors
    /// The file cannot be read, or holds no policy that is understood.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, PolicyError> {
        let path = path.as_ref();
        let fail = |error| PolicyError::File { path: path.into(), error };
        let mut bytes = Vec::new();
        let file = File::open(path).map_err(fail)?;
        file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(fail)?;
        if bytes.len() as u64 > MAX_BYTES {
            let message = format!("it has more than {} MiB, and no policy has", MAX_BYTES >> 20);
            return Err(PolicyError::content(message).within(path));
        }
        Self::parse(&bytes).map_err(|error| error.within(path))
    }

    /// Reads a policy from the bytes of a file.
    ///
    /// # Errors
    /// The bytes hold no policy that is understood.
    pub fn parse(bytes: &[u8]) -> Result<Self, PolicyError> {
        Ok(Self::mean(mjrl::read(bytes)?))
    }

    /// The policy at the start of an episode: random actions are those of its seed.
    #[must_use]
    pub fn for_episode(&self, seed: u64) -> Self {
        match self {
            Policy::Random(_) => Policy::random(seed),
            other => other.clone(),
        }
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
        }
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
