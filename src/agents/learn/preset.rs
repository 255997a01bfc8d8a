//! Settings to begin with.

use super::advantage::Horizon;
use super::dapg::Dapg;
use super::fit::Fit;
use super::npg::Npg;
use super::ppo::Ppo;
use super::sac::Sac;
use super::settings::{Algorithm, Settings};
use crate::nets::Activation;

impl Settings {
    /// Those of an algorithm by its name, one of [`Algorithm::NAMES`].
    pub fn named(algorithm: &str) -> Option<Self> {
        let settings = match algorithm {
            "npg" => Self::npg(),
            "ppo" => Self::ppo(),
            "sac" => Self::sac(),
            "bc" => Self::cloning(),
            "dagger" => Self::dagger(),
            "dapg" => Self::dapg(),
            _ => return None,
        };
        Some(settings)
    }

    /// The natural policy gradient. The policy's network, 96 episodes an iteration, the step size and the passes over the values are those of the NPG
    /// runs that MyoSuite published; the rest are values that work here.
    pub fn npg() -> Self {
        Settings {
            algorithm: Algorithm::Npg(Npg { step: 0.1 }),
            episodes: 96,
            horizon: Horizon { gamma: 0.995, lambda: 0.97 },
            hidden: [vec![32, 32], vec![128, 128]],
            activation: Activation::Tanh,
            log_std: [-0.25, -1.0],
            fit: Fit { epochs: 2, batch: 64, rate: 1e-3, longest: 0.5 },
        }
    }

    /// Proximal policy optimisation for tasks of some hundred steps.
    pub fn ppo() -> Self {
        let (epochs, batch, rate, longest) = (10, 64, 3e-4, 0.5);
        let ([clip, entropy], divergence) = ([0.2, 0.0], 0.03);
        Settings {
            algorithm: Algorithm::Ppo(Ppo { epochs, batch, rate, clip, entropy, longest, divergence }),
            episodes: 32,
            horizon: Horizon { gamma: 0.97, lambda: 0.95 },
            hidden: [vec![64, 64], vec![64, 64]],
            activation: Activation::Tanh,
            log_std: [-0.5, -2.0],
            fit: Fit { epochs, batch, rate, longest },
        }
    }

    /// Behaviour cloning, with episodes enough to see what it comes to.
    pub fn cloning() -> Self {
        let cloning = Fit { epochs: 20, batch: 64, rate: 1e-3, longest: 10.0 };
        let ppo = Self::ppo();
        Settings { algorithm: Algorithm::Cloning(cloning), log_std: [-0.5, -4.0], ..ppo }
    }

    /// Dataset aggregation: a clone that is corrected in 16 episodes of its own an iteration.
    pub fn dagger() -> Self {
        let cloning = Fit { epochs: 5, batch: 64, rate: 1e-3, longest: 10.0 };
        Settings { algorithm: Algorithm::Dagger(cloning), episodes: 16, ..Self::cloning() }
    }

    /// The natural policy gradient with demonstrations: the policy's network, 200 episodes an iteration, the step size, the weights and the cloning are
    /// those of the published runs on hands; the rest is our choice.
    pub fn dapg() -> Self {
        let cloning = Fit { epochs: 5, batch: 32, rate: 1e-3, longest: 10.0 };
        let dapg = Dapg { step: 0.05, weight: 0.01, decay: 0.95, cloning };
        Settings { algorithm: Algorithm::Dapg(dapg), episodes: 200, log_std: [0.0, -3.0], ..Self::npg() }
    }

    /// Soft actor-critic for tasks of some hundred steps, with an update for each step.
    pub fn sac() -> Self {
        let (rate, batch) = (5e-4, 128);
        let sac = Sac { steps: 3, share: 0.01, entropy: -1.0, rate, remembered: 1 << 20, begin: 5000 };
        Settings {
            algorithm: Algorithm::Sac(sac),
            episodes: 8,
            horizon: Horizon { gamma: 0.98, lambda: 1.0 },
            hidden: [vec![128, 128], vec![128, 128]],
            activation: Activation::Relu,
            log_std: [-0.5, -5.0],
            fit: Fit { epochs: batch, batch, rate, longest: 10.0 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_settings_of_its_algorithm() {
        for (name, _) in Algorithm::NAMES {
            assert_eq!(Settings::named(name).map(|settings| settings.algorithm.name()), Some(name));
        }
        assert_eq!(Settings::named("ddpg"), None);
    }
}
