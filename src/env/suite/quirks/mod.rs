//! What RoboHive's tasks do otherwise than they mean to, and what happens here.

mod hands;
mod myobase;
mod myochallenge;
mod robots;

/// A quirk of the original that shapes numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quirk {
    /// What it is about.
    pub name: &'static str,
    /// The ids that it concerns: an id, or a pattern with `*`.
    pub ids: &'static [&'static str],
    /// What the original does, and what `Compat::RoboHive07` reproduces.
    pub original: &'static str,
    /// What happens under `Compat::Fixed`.
    pub fixed: &'static str,
}

/// All of them, by suites.
pub fn quirks() -> impl Iterator<Item = &'static Quirk> {
    [robots::QUIRKS, hands::QUIRKS, myobase::QUIRKS, myochallenge::QUIRKS].into_iter().flatten()
}

impl Quirk {
    /// Whether it concerns an id.
    pub fn concerns(&self, id: &str) -> bool {
        self.ids.iter().any(|pattern| fits(pattern, id))
    }
}

/// Whether an id is one of a pattern.
fn fits(pattern: &str, id: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == id,
        Some((start, end)) => id.strip_prefix(start).is_some_and(|rest| {
            // What the first `*` stands for ends anywhere.
            rest.char_indices().map(|(k, _)| k).chain([rest.len()]).any(|k| fits(end, &rest[k..]))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry::Registry;
    use std::collections::BTreeSet;

    #[test]
    fn every_pattern_has_ids_and_every_name_is_unique() {
        let specs = Registry::builtin().specs();
        for quirk in quirks() {
            for pattern in quirk.ids {
                assert!(specs.iter().any(|spec| fits(pattern, &spec.id)), "{}: {pattern}", quirk.name);
            }
        }
        assert_eq!(quirks().map(|quirk| quirk.name).collect::<BTreeSet<_>>().len(), quirks().count());
    }

    #[test]
    fn patterns_end_where_they_say() {
        assert!(
            fits("myo*Leg*Walk-v0", "myoSarcLegWalk-v0")
                && fits("myo*Leg*Walk-v0", "myoLegHillyTerrainWalk-v0")
        );
        assert!(!fits("myo*Leg*Walk-v0", "myoLegWalk-v1") && !fits("myo", "myoLegWalk-v0"));
    }
}
