//! Sweeps: configurations of runs that differ in settings, and the folders that these name.
//!
//! ```
//! use robohive_agents::learn::Settings;
//! use robohive_agents::run::Config;
//! use robohive_agents::sweep::{Variation, combinations};
//!
//! let base = Config::new("hive/FrankaReach-v0", Settings::ppo());
//! let rates = Variation { key: "learning.fit.rate".into(), values: vec!["1e-3".into(), "3e-4".into()] };
//! let found = combinations(&base, &[rates], 2)?;
//! assert_eq!((found.len(), found[1].config.learning.fit.rate), (2, 3e-4));
//! assert_eq!(found[1].folder(2), "fit.rate=3e-4-seed2");
//! # Ok::<(), robohive_agents::PolicyError>(())
//! ```

use crate::error::PolicyError;
use crate::run::Config;
use std::collections::BTreeSet;

/// Most runs of a sweep.
pub const MOST_RUNS: usize = 1000;
/// Longest name of a run's folder: file systems have names of 255 bytes, and files in it have names too.
const LONGEST_NAME: usize = 200;

/// A setting and the values that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Its path in run.toml.
    pub key: String,
    /// As TOML writes them, or text.
    pub values: Vec<String>,
}

/// A value of each setting that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Paths and values.
    pub settings: Vec<(String, String)>,
    /// What is trained, with the seed of the configuration that it was made of.
    pub config: Config,
}

impl Combination {
    /// The settings in words.
    pub fn described(&self) -> String {
        let part = |(key, value): &(String, String)| format!("{}={value}", short(key));
        self.settings.iter().map(part).collect::<Vec<_>>().join(" ")
    }

    /// The name of the folder of its run of a seed.
    pub fn folder(&self, seed: u64) -> String {
        let part = |(key, value): &(String, String)| format!("{}={}-", safe(short(key)), safe(value));
        self.settings.iter().map(part).chain([format!("seed{seed}")]).collect()
    }
}

/// Every combination of values, each for `seeds` seeds; the values of the last setting vary first.
///
/// # Errors
/// There are too many runs; a setting is unknown, cannot have a value, or varies twice; two combinations are the same.
pub fn combinations(
    base: &Config,
    variations: &[Variation],
    seeds: usize,
) -> Result<Vec<Combination>, PolicyError> {
    let runs = variations.iter().fold(seeds, |count, variation| count.saturating_mul(variation.values.len()));
    if runs > MOST_RUNS {
        let message = format!("these are {runs} runs, and a sweep has at most {MOST_RUNS}: vary less");
        return Err(PolicyError::Sweep(message));
    }
    let mut found = vec![Combination { settings: Vec::new(), config: base.clone() }];
    for (place, Variation { key, values }) in variations.iter().enumerate() {
        if variations[..place].iter().any(|other| other.key == *key) {
            let message = format!("{key} is there twice: give all of its values at once");
            return Err(PolicyError::Sweep(message));
        }
        if key == "seed" {
            return Err(PolicyError::Sweep(
                "every combination has the same seeds, which are no setting".into(),
            ));
        }
        let mut more = Vec::new();
        for Combination { settings, config } in &found {
            for value in values {
                let config = config.with(key, value)?;
                let settings = [&settings[..], &[(key.clone(), value.clone())]].concat();
                more.push(Combination { settings, config });
            }
        }
        found = more;
    }
    for (place, combination) in found.iter().enumerate() {
        if let Some(other) = found[..place].iter().find(|other| other.config == combination.config) {
            let message = format!("{} and {} are the same", other.described(), combination.described());
            return Err(PolicyError::Sweep(message));
        }
    }
    check_names(&found)?;
    Ok(found)
}

/// Refuses names of folders that are too long, or that some file systems take for one.
fn check_names(combinations: &[Combination]) -> Result<(), PolicyError> {
    let mut names = BTreeSet::new();
    for combination in combinations {
        let name = combination.folder(u64::MAX);
        if name.len() > LONGEST_NAME {
            let message =
                format!("the folder {name} has a longer name than {LONGEST_NAME} letters: vary less");
            return Err(PolicyError::Sweep(message));
        }
        if !names.insert(name.to_lowercase()) {
            let message = format!("another value gives the same folder as {}", combination.described());
            return Err(PolicyError::Sweep(message));
        }
    }
    Ok(())
}

/// A path without the table that most settings are in.
pub fn short(key: &str) -> &str {
    key.strip_prefix("learning.").unwrap_or(key)
}

/// Text of letters that no file system and no shell takes for anything else: `[[32,32],[64]]` is `32_32__64`.
fn safe(text: &str) -> String {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let kept = |c: char| match c {
        ',' | '/' | '\\' => Some('_'),
        c => (c.is_ascii_alphanumeric() || "+-._=".contains(c)).then_some(c),
    };
    text.replace("],", "__").chars().filter_map(kept).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::Settings;

    #[test]
    fn folders_have_harmless_names() {
        let setting = |key: &str, value: &str| (key.to_owned(), value.to_owned());
        let settings = [setting("learning.fit.rate", "0.001"), setting("environment.foo", "-2")];
        let named = |settings: &[_], seed| {
            let config = Config::new("hive/FrankaReach-v0", Settings::npg());
            Combination { settings: settings.to_vec(), config }.folder(seed)
        };
        assert_eq!(named(&settings, 1), "fit.rate=0.001-environment.foo=-2-seed1");
        assert_eq!(named(&[], 12), "seed12");
        for (value, name) in [
            ("[[32, 32], [64]]", "32_32__64"),
            ("[[32], [32, 64]]", "32__32_64"),
            ("'hive/A b'", "hive_Ab"),
            ("..\\*?$`;", ".._"),
        ] {
            assert_eq!(safe(value), name);
        }
    }
}
