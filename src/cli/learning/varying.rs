//! What varies between the runs of a sweep: settings and seeds, and the folders that they name.

use crate::failure::Failure;
use crate::input::policy::failure;
use agents::run::Config;
use std::collections::BTreeSet;
use std::str::FromStr;

/// Most runs of a sweep.
pub const MOST_RUNS: usize = 1000;
/// Longest name of a run's folder: file systems have names of 255 bytes, and files in it have names too.
const LONGEST_NAME: usize = 200;

/// A setting and the values that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Its path in run.toml.
    key: String,
    /// As they were given.
    values: Vec<String>,
}

/// Seeds of the runs of each combination.
#[derive(Clone, Debug, PartialEq)]
pub struct Seeds(pub Vec<u64>);

/// A value of each setting that varies.
pub struct Combination {
    /// Paths and values.
    pub settings: Vec<(String, String)>,
    /// What is trained, without its seed.
    pub config: Config,
}

impl FromStr for Variation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (key, list) = text.split_once('=').ok_or("it is not KEY=V1,V2")?;
        if key == "seed" {
            return Err("give seeds by --seeds".into());
        }
        let values = split(list)?.into_iter().map(|value| value.trim().to_owned()).collect::<Vec<_>>();
        if values.iter().any(String::is_empty) {
            return Err("a value is missing; an empty text is \"\"".into());
        }
        Ok(Variation { key: key.into(), values })
    }
}

impl FromStr for Seeds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // run.toml has integers with a sign.
        let number = |text: &str| match text.trim().parse::<u64>() {
            Ok(number) if i64::try_from(number).is_ok() => Ok(number),
            _ => Err(format!("{text:?} is no integer from 0 to {}", i64::MAX)),
        };
        if !text.contains(',') {
            return match number(text)? {
                count if (1..=MOST_RUNS as u64).contains(&count) => Ok(Seeds((1..=count).collect())),
                count => Err(format!(
                    "{count} seeds: there can be 1 to {MOST_RUNS}; the seed {count} alone is \"{count},\""
                )),
            };
        }
        let list = text.strip_suffix(',').unwrap_or(text);
        let seeds = list.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
        match seeds.iter().enumerate().find(|(place, seed)| seeds[..*place].contains(seed)) {
            Some((_, seed)) => Err(format!("the seed {seed} is there twice")),
            None => Ok(Seeds(seeds)),
        }
    }
}

/// The parts of a list between its commas, but for commas within brackets or quotation marks.
fn split(list: &str) -> Result<Vec<&str>, String> {
    let (mut parts, mut begin, mut depth, mut quote, mut escaped) = (Vec::new(), 0, 0_usize, None, false);
    for (place, c) in list.char_indices() {
        let escapes = quote == Some('"') && c == '\\' && !escaped;
        match (quote, c) {
            (Some(mark), _) if c == mark && !escaped => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth = depth.checked_sub(1).ok_or("a bracket was not opened")?,
            (None, ',') if depth == 0 => {
                parts.push(&list[begin..place]);
                begin = place + 1;
            }
            (None, _) => {}
        }
        escaped = escapes;
    }
    if depth > 0 || quote.is_some() {
        return Err("a bracket or a quotation mark is not closed".into());
    }
    parts.push(&list[begin..]);
    Ok(parts)
}

/// Every combination of values, each for `seeds` seeds; the values of the last setting vary first.
///
/// # Errors
/// There are too many runs; a setting is unknown, cannot have a value, or varies twice; two combinations are the same.
pub fn combinations(
    base: &Config,
    variations: &[Variation],
    seeds: usize,
) -> Result<Vec<Combination>, Failure> {
    let runs = variations.iter().fold(seeds, |count, variation| count.saturating_mul(variation.values.len()));
    if runs > MOST_RUNS {
        let message = format!("these are {runs} runs, and a sweep has at most {MOST_RUNS}: vary less");
        return Err(Failure::usage(message));
    }
    let mut found = vec![Combination { settings: Vec::new(), config: base.clone() }];
    for (place, Variation { key, values }) in variations.iter().enumerate() {
        if variations[..place].iter().any(|other| other.key == *key) {
            let message = format!("--vary {key} is there twice: give all of its values at once");
            return Err(Failure::usage(message));
        }
        let mut more = Vec::new();
        for Combination { settings, config } in &found {
            for value in values {
                let config = config.with(key, value).map_err(failure)?;
                let settings = [&settings[..], &[(key.clone(), value.clone())]].concat();
                more.push(Combination { settings, config });
            }
        }
        found = more;
    }
    for (place, combination) in found.iter().enumerate() {
        if let Some(other) = found[..place].iter().find(|other| other.config == combination.config) {
            let message = format!(
                "{} and {} are the same",
                described(&other.settings),
                described(&combination.settings)
            );
            return Err(Failure::usage(message));
        }
    }
    check_names(&found)?;
    Ok(found)
}

/// Refuses names of folders that are too long, or that some file systems take for one.
fn check_names(combinations: &[Combination]) -> Result<(), Failure> {
    let mut names = BTreeSet::new();
    for Combination { settings, .. } in combinations {
        let name = folder(settings, u64::MAX);
        if name.len() > LONGEST_NAME {
            let message =
                format!("the folder {name} has a longer name than {LONGEST_NAME} letters: vary less");
            return Err(Failure::usage(message));
        }
        if !names.insert(name.to_lowercase()) {
            let message = format!("another value gives the same folder as {}", described(settings));
            return Err(Failure::usage(message));
        }
    }
    Ok(())
}

/// Settings in words.
pub fn described(settings: &[(String, String)]) -> String {
    settings.iter().map(|(key, value)| format!("{}={value}", short(key))).collect::<Vec<_>>().join(" ")
}

/// The name of a run's folder.
pub fn folder(settings: &[(String, String)], seed: u64) -> String {
    let part = |(key, value): &(String, String)| format!("{}={}-", safe(short(key)), safe(value));
    settings.iter().map(part).chain([format!("seed{seed}")]).collect()
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

    fn values(text: &str) -> Result<Vec<String>, String> {
        text.parse::<Variation>().map(|variation| variation.values)
    }

    #[test]
    fn commas_within_brackets_and_quotation_marks_separate_nothing() {
        assert_eq!(values("a.b=1, 2e-3").unwrap(), ["1", "2e-3"]);
        assert_eq!(values("a=[[1,2],[3]],[[4],[5]]").unwrap(), ["[[1,2],[3]]", "[[4],[5]]"]);
        assert_eq!(values("a={x=1,y=2},{x=2,y=2}").unwrap(), ["{x=1,y=2}", "{x=2,y=2}"]);
        assert_eq!(values(r#"a="x,\"y",'z,\'"#).unwrap(), [r#""x,\"y""#, r"'z,\'"]);
        for (text, why) in [
            ("a", "not KEY=V1,V2"),
            ("a=", "a value is missing"),
            ("a=1,,2", "a value is missing"),
            ("a=[1,2", "not closed"),
            ("a='x", "not closed"),
            ("a=1],2", "not opened"),
            ("seed=1,2", "--seeds"),
        ] {
            assert!(values(text).unwrap_err().contains(why), "{text}");
        }
    }

    #[test]
    fn seeds_are_a_number_or_a_list() {
        let seeds = |text: &str| text.parse::<Seeds>().map(|Seeds(seeds)| seeds);
        assert_eq!(seeds("3"), Ok(vec![1, 2, 3]));
        assert_eq!(seeds("5,0, 7"), Ok(vec![5, 0, 7]));
        assert_eq!(seeds("7,"), Ok(vec![7]));
        for wrong in ["0", "1001", "-1", "1,1", ",", "", "1,9223372036854775808"] {
            assert!(seeds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn folders_have_harmless_names() {
        let setting = |key: &str, value: &str| (key.to_owned(), value.to_owned());
        let settings = [setting("learning.fit.rate", "0.001"), setting("environment.foo", "-2")];
        assert_eq!(folder(&settings, 1), "fit.rate=0.001-environment.foo=-2-seed1");
        assert_eq!(folder(&[], 12), "seed12");
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
