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

    /// Refuses what no training can be made of, in words.
    pub(crate) fn check(&self) -> Result<(), String> {
        let Settings { episodes, horizon: Horizon { gamma, lambda }, hidden, log_std, fit, .. } = self;
        let share = |name: &str, value: f64| match (0.0..=1.0).contains(&value) {
            true => Ok(()),
            false => Err(format!("{name} must be from 0 to 1, and is {value}")),
        };
        let positive = |name: &str, value: f64| match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(format!("{name} must be above 0, and is {value}")),
        };
        share("horizon.gamma", *gamma)?;
        share("horizon.lambda", *lambda)?;
        positive("episodes", *episodes as f64)?;
        let fits = |name: &str, fit: Fit| {
            positive(&format!("{name}.rate"), f64::from(fit.rate))?;
            positive(&format!("{name}.longest"), fit.longest)?;
            positive(&format!("{name}.batch"), fit.batch as f64)
        };
        fits("fit", *fit)?;
        match self.algorithm {
            Algorithm::Npg(npg) => positive("algorithm.npg.step", npg.step)?,
            Algorithm::Cloning(cloning) | Algorithm::Dagger(cloning) => {
                let name = if self.algorithm.needs_corrections() { "dagger" } else { "cloning" };
                positive(&format!("algorithm.{name}.epochs"), cloning.epochs as f64)?;
                fits(&format!("algorithm.{name}"), cloning)?;
            }
            Algorithm::Dapg(dapg) => {
                share("algorithm.dapg.decay", dapg.decay)?;
                positive("algorithm.dapg.step", dapg.step)?;
                positive("algorithm.dapg.weight", dapg.weight)?;
                fits("algorithm.dapg.cloning", dapg.cloning)?;
            }
            Algorithm::Sac(sac) => {
                share("algorithm.sac.share", f64::from(sac.share))?;
                positive("algorithm.sac.steps", sac.steps as f64)?;
                positive("algorithm.sac.rate", f64::from(sac.rate))?;
                if fit.batch < 2 {
                    return Err(format!(
                        "fit.batch must be at least 2 for sac, which halves it, and is {}",
                        fit.batch
                    ));
                }
                if !sac.entropy.is_finite() {
                    return Err(format!("algorithm.sac.entropy must be a number, and is {}", sac.entropy));
                }
                if *lambda != 1.0 {
                    let message =
                        "horizon.lambda must be 1 for sac, whose returns are of algorithm.sac.steps steps";
                    return Err(format!("{message}, and is {lambda}"));
                }
                if !(2..=MOST_REMEMBERED).contains(&sac.remembered) || sac.begin > sac.remembered {
                    return Err(format!(
                        "algorithm.sac.remembered must be from 2 to {MOST_REMEMBERED} and not below begin, and they are {} and {}",
                        sac.remembered, sac.begin
                    ));
                }
            }
            Algorithm::Ppo(ppo) => {
                for (name, value) in [
                    ("rate", f64::from(ppo.rate)),
                    ("batch", ppo.batch as f64),
                    ("epochs", ppo.epochs as f64),
                    ("clip", f64::from(ppo.clip)),
                    ("longest", ppo.longest),
                    ("divergence", ppo.divergence),
                ] {
                    positive(&format!("algorithm.ppo.{name}"), value)?;
                }
            }
        }
        if log_std.iter().any(|log| !log.is_finite()) || log_std[0] < log_std[1] {
            return Err(format!(
                "log_std must be a start and a least value not above it, and is {log_std:?}"
            ));
        }
        let widths = hidden.iter().flatten();
        match widths.copied().find(|width| !(1..=WIDEST).contains(width)) {
            Some(width) => Err(format!("hidden layers must be 1 to {WIDEST} wide, and one is {width}")),
            None if hidden.iter().any(|layers| layers.len() > DEEPEST) => {
                Err(format!("there can be at most {DEEPEST} hidden layers"))
            }
            None => Ok(()),
        }
    }
}

/// Most observations that are remembered.
const MOST_REMEMBERED: usize = 1 << 24;
/// Most numbers of a hidden layer, and most layers.
const WIDEST: usize = 4096;
const DEEPEST: usize = 16;
