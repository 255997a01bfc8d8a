//! From names and ranges of a configuration to dials.

use super::dial::{Dial, Draws, Target, word};
use crate::draws::Ranges;
use physics::Model;
use physics::math::Legible;
use physics::model::{ObjType, Suggestions};

/// Names that a message lists.
const LISTED: usize = 20;

/// Bounds of what may have any value.
pub(super) const ANYTHING: [f64; 2] = [f64::MIN, f64::MAX];

/// The dials that were found so far for a setting.
pub(super) struct Choice<'a, T> {
    pub model: &'a Model,
    pub dials: Vec<Dial<T>>,
}

impl<'a, T: Target> Choice<'a, T> {
    pub(super) fn of(model: &'a Model) -> Self {
        Choice { model, dials: Vec::new() }
    }

    /// The elements that patterns of the entry `key` name; all without patterns.
    ///
    /// # Errors
    /// A pattern that fits no element, with those that there are.
    pub(super) fn named(
        &self,
        key: &str,
        (kind, count): (ObjType, usize),
        patterns: Option<&[String]>,
    ) -> Result<Vec<usize>, String> {
        let Some(patterns) = patterns else { return Ok((0..count).collect()) };
        let name = |id: usize| self.model.name_of(kind, id);
        for pattern in patterns {
            if (0..count).any(|id| fits(pattern, name(id))) {
                continue;
            }
            let nearest = Suggestions::default().nearest(pattern, (0..count).map(name));
            let hint = nearest.map_or_else(String::new, |nearest| format!("; did you mean {nearest}?"));
            let names: Vec<_> = (0..count).map(name).filter(|name| !name.is_empty()).collect();
            let more = names.len().saturating_sub(LISTED);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            let listed = match names.is_empty() {
                true => "none has a name".to_owned(),
                false => format!("there are {}{more}", names[..names.len().min(LISTED)].join(", ")),
            };
            return Err(format!(
                "{key} of {} names the {} {pattern}, which the model does not have{hint} ({listed})",
                T::SETTING,
                word(kind)
            ));
        }
        Ok((0..count).filter(|&id| patterns.iter().any(|pattern| fits(pattern, name(id)))).collect())
    }

    /// Adds a dial for each part of an element that is drawn.
    pub(super) fn put_all<const N: usize>(
        &mut self,
        (kind, id): (ObjType, usize),
        parts: [(&str, &'static str, T, &Option<Draws>); N],
    ) {
        for (part, unit, target, draws) in parts {
            if let Some(draws) = draws {
                self.put((kind, id, part), unit, target, draws.clone());
            }
        }
    }

    /// Adds a dial for a part of an element.
    pub(super) fn put(&mut self, place: (ObjType, usize, &str), unit: &'static str, target: T, draws: Draws) {
        self.add(Dial { name: self.name(place), unit, target, draws });
    }

    /// The name of a dial.
    pub(super) fn name(&self, (kind, id, part): (ObjType, usize, &str)) -> String {
        let element = match self.model.name_of(kind, id) {
            "" => id.to_string(),
            name => name.to_owned(),
        };
        format!("{}/{element}/{part}", word(kind))
    }

    /// Adds a dial, or replaces the one that turns the same.
    pub(super) fn add(&mut self, dial: Dial<T>) {
        self.dials.retain(|known| !known.target.turns_same(&dial.target));
        self.dials.push(dial);
    }

    /// Uniform draws within a range, which must be within bounds.
    ///
    /// # Errors
    /// It is empty, not finite or beyond its bounds.
    pub(super) fn bounds<const N: usize>(
        &self,
        key: &str,
        range: &Ranges<N>,
        within: [f64; 2],
    ) -> Result<Vec<[f64; 2]>, String> {
        let pairs: Vec<[f64; 2]> =
            range.low.into_iter().zip(range.high).map(|(low, high)| [low, high]).collect();
        let good = |[low, high]: &[f64; 2]| {
            within[0] <= *low && low <= high && *high <= within[1] && (high - low).is_finite()
        };
        if pairs.iter().all(good) {
            return Ok(pairs);
        }
        let [low, high] = within;
        let limits = if within == ANYTHING {
            String::new()
        } else {
            format!(", within {} and {}", Legible(low), Legible(high))
        };
        Err(format!("{key} of {} needs finite bounds, low not above high{limits}", T::SETTING))
    }

    /// [`Choice::bounds`] of a range that may be missing.
    ///
    /// # Errors
    /// As there.
    pub(super) fn optional<const N: usize>(
        &self,
        key: &str,
        range: Option<&Ranges<N>>,
        within: [f64; 2],
    ) -> Result<Option<Draws>, String> {
        range.map(|range| self.bounds(key, range, within).map(Draws::Uniform)).transpose()
    }

    /// Zero or one, by a probability.
    ///
    /// # Errors
    /// It is none.
    pub(super) fn chance(&self, key: &str, probability: Option<f64>) -> Result<Option<Draws>, String> {
        match probability {
            None => Ok(None),
            Some(p) if (0.0..=1.0).contains(&p) => Ok(Some(Draws::Chance(p))),
            Some(p) => Err(format!("{key} of {} is a probability, 0 to 1, not {p}", T::SETTING)),
        }
    }
}

/// Whether a name is the pattern, or begins like one that ends with `*`.
fn fits(pattern: &str, name: &str) -> bool {
    pattern.strip_suffix('*').map_or(name == pattern, |start| name.starts_with(start))
}
