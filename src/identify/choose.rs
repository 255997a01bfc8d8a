//! Parameters by the words of a user: `damping`, `elbow.armature`, `finger*.frictionloss`.

use crate::error::IdentifyError;
use crate::parameter::Parameter;
use crate::quantity::Quantity;
use mjcf::diagnostic::Diagnostics;
use physics::Model;
use physics::model::ObjType;
use std::collections::BTreeSet;

/// Most names that a message lists.
const LISTED: usize = 12;

impl Quantity {
    /// The parameters that words separated by commas name: a quantity of all elements that have it, or `ELEMENT.QUANTITY`,
    /// where `*` in ELEMENT stands for any text. Each is named once, in the order of the words.
    ///
    /// # Errors
    /// There is no such quantity or element; the nearest is suggested.
    pub fn choose(words: &str, model: &Model) -> Result<Vec<Parameter>, IdentifyError> {
        let mut found: Vec<Parameter> = Vec::new();
        let mut taken = BTreeSet::new();
        for word in words.split(',').map(str::trim).filter(|word| !word.is_empty()) {
            let chosen = Self::word(word, model)?;
            found.extend(chosen.into_iter().filter(|parameter| taken.insert(parameter.name.clone())));
        }
        if found.is_empty() {
            let all: Vec<_> = Self::ALL.iter().map(|quantity| quantity.name()).collect();
            return Err(IdentifyError::Choice(format!(
                "nothing is to be fitted; name some of {}",
                all.join(", ")
            )));
        }
        Ok(found)
    }

    fn word(word: &str, model: &Model) -> Result<Vec<Parameter>, IdentifyError> {
        let (pattern, name) = word.rsplit_once('.').unwrap_or(("*", word));
        let quantity = Self::named(name)?;
        let all: Vec<_> =
            quantity.elements(model).into_iter().map(|e| Parameter::of(model, quantity, e)).collect();
        let names: Vec<&str> =
            all.iter().map(|p| p.name.strip_suffix(&format!(".{name}")).unwrap_or("")).collect();
        let chosen: Vec<_> =
            all.iter().zip(&names).filter(|(_, own)| matches(pattern, own)).map(|(p, _)| p.clone()).collect();
        if !chosen.is_empty() {
            return Ok(chosen);
        }
        let kind = match quantity.kind() {
            Some(ObjType::Joint) => "joint",
            Some(ObjType::Actuator) => "actuator",
            Some(ObjType::Body) => "body",
            _ => "element",
        };
        let mut text =
            format!("{word}: the model has no {kind} '{pattern}' with a {name} that can be fitted");
        if let Some(near) = Diagnostics::default().nearest(pattern, names.iter().copied()) {
            text += &format!("; did you mean '{near}'?");
        }
        let listed: Vec<_> = names.iter().take(LISTED).copied().collect();
        let more = if names.len() > LISTED { ", …" } else { "" };
        text += &match listed.as_slice() {
            [] => "; there are none".to_owned(),
            some => format!("; there are {}{more}", some.join(", ")),
        };
        Err(IdentifyError::Choice(text))
    }
}

/// Whether a text is what a pattern stands for.
pub(crate) fn matches(pattern: &str, text: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == text,
        Some((head, rest)) => text.strip_prefix(head).is_some_and(|tail| {
            let mut cuts = (0..=tail.len()).filter(|&at| tail.is_char_boundary(at));
            cuts.any(|at| matches(rest, &tail[at..]))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn stars_stand_for_any_text() {
        for (pattern, text, is) in [
            ("*", "", true),
            ("elbow", "elbow", true),
            ("elbow", "elbows", false),
            ("finger*", "finger_2", true),
            ("*_2", "finger_2", true),
            ("f*r_*", "finger_2", true),
            ("f*x", "finger_2", false),
            ("ä*", "äöü", true),
        ] {
            assert_eq!(matches(pattern, text), is, "{pattern} {text}");
        }
    }
}
