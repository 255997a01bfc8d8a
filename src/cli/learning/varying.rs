//! Variations and seeds as the command line gives them.

use agents::sweep::{MOST_RUNS, Variation};
use std::str::FromStr;

/// Seeds of the runs of each combination.
#[derive(Clone, Debug, PartialEq)]
pub struct Seeds(pub Vec<u64>);

/// `KEY=V1,V2`.
///
/// # Errors
/// The key or a value is missing; it is the seed; a bracket or a quotation mark is not closed.
pub fn variation(text: &str) -> Result<Variation, String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Result<Vec<String>, String> {
        variation(text).map(|variation| variation.values)
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
}
