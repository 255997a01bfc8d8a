//! What RoboHive's tasks do otherwise than they mean to, and what happens here.

mod hands;
mod myobase;
mod myochallenge;
mod quirk;
mod robots;

pub use quirk::Quirk;

/// All of them, by suites.
pub fn quirks() -> impl Iterator<Item = &'static Quirk> {
    [robots::QUIRKS, hands::QUIRKS, myobase::QUIRKS, myochallenge::QUIRKS].into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::quirk::fits;
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
}
