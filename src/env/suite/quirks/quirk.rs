//! A quirk, and the ids that it concerns.

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

impl Quirk {
    /// Whether it concerns an id.
    pub fn concerns(&self, id: &str) -> bool {
        self.ids.iter().any(|pattern| fits(pattern, id))
    }
}

/// Whether an id is one of a pattern.
pub(super) fn fits(pattern: &str, id: &str) -> bool {
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

    #[test]
    fn patterns_end_where_they_say() {
        assert!(
            fits("myo*Leg*Walk-v0", "myoSarcLegWalk-v0")
                && fits("myo*Leg*Walk-v0", "myoLegHillyTerrainWalk-v0")
        );
        assert!(!fits("myo*Leg*Walk-v0", "myoLegWalk-v1") && !fits("myo", "myoLegWalk-v0"));
    }
}
