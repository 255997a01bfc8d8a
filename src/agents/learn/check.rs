//! Settings of which no training can be made are refused.

use super::advantage::Horizon;
use super::fit::Fit;
use super::sac::Sac;
use super::settings::{Algorithm, Settings};

/// Most observations that are remembered.
const MOST_REMEMBERED: usize = 1 << 24;
/// Most numbers of a hidden layer, and most layers.
const WIDEST: usize = 4096;
const DEEPEST: usize = 16;

impl Settings {
    /// Refuses what no training can be made of, in words.
    pub(crate) fn check(&self) -> Result<(), String> {
        let Settings { episodes, horizon: Horizon { gamma, lambda }, hidden, log_std, fit, .. } = self;
        share("horizon.gamma", *gamma)?;
        share("horizon.lambda", *lambda)?;
        positive("episodes", *episodes as f64)?;
        can_fit("fit", *fit)?;
        self.check_algorithm()?;
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

    fn check_algorithm(&self) -> Result<(), String> {
        match self.algorithm {
            Algorithm::Npg(npg) => positive("algorithm.npg.step", npg.step),
            Algorithm::Cloning(cloning) => can_clone("algorithm.cloning", cloning),
            Algorithm::Dagger(cloning) => can_clone("algorithm.dagger", cloning),
            Algorithm::Dapg(dapg) => {
                share("algorithm.dapg.decay", dapg.decay)?;
                positive("algorithm.dapg.step", dapg.step)?;
                positive("algorithm.dapg.weight", dapg.weight)?;
                can_fit("algorithm.dapg.cloning", dapg.cloning)
            }
            Algorithm::Sac(sac) => self.check_soft(sac),
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
                Ok(())
            }
        }
    }

    fn check_soft(&self, sac: Sac) -> Result<(), String> {
        let (batch, lambda) = (self.fit.batch, self.horizon.lambda);
        share("algorithm.sac.share", f64::from(sac.share))?;
        positive("algorithm.sac.steps", sac.steps as f64)?;
        positive("algorithm.sac.rate", f64::from(sac.rate))?;
        if batch < 2 {
            return Err(format!("fit.batch must be at least 2 for sac, which halves it, and is {batch}"));
        }
        if !sac.entropy.is_finite() {
            return Err(format!("algorithm.sac.entropy must be a number, and is {}", sac.entropy));
        }
        if lambda != 1.0 {
            let message = "horizon.lambda must be 1 for sac, whose returns are of algorithm.sac.steps steps";
            return Err(format!("{message}, and is {lambda}"));
        }
        if !(2..=MOST_REMEMBERED).contains(&sac.remembered) || sac.begin > sac.remembered {
            return Err(format!(
                "algorithm.sac.remembered must be from 2 to {MOST_REMEMBERED} and not below begin, and they are {} and {}",
                sac.remembered, sac.begin
            ));
        }
        Ok(())
    }
}

fn share(name: &str, value: f64) -> Result<(), String> {
    match (0.0..=1.0).contains(&value) {
        true => Ok(()),
        false => Err(format!("{name} must be from 0 to 1, and is {value}")),
    }
}

fn positive(name: &str, value: f64) -> Result<(), String> {
    match value > 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(format!("{name} must be above 0, and is {value}")),
    }
}

fn can_fit(name: &str, fit: Fit) -> Result<(), String> {
    positive(&format!("{name}.rate"), f64::from(fit.rate))?;
    positive(&format!("{name}.longest"), fit.longest)?;
    positive(&format!("{name}.batch"), fit.batch as f64)
}

fn can_clone(name: &str, cloning: Fit) -> Result<(), String> {
    positive(&format!("{name}.epochs"), cloning.epochs as f64)?;
    can_fit(name, cloning)
}
