//! Licences of files: what the nearest licence text upwards says.

use crate::layout::is_licence;
use std::collections::BTreeMap;
use std::fmt;

/// Most bytes of a text that are looked at.
pub(crate) const MAX_TEXT: u64 = 1 << 18;

/// A licence by its SPDX identifier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Licence {
    /// Apache License 2.0.
    Apache2,
    /// BSD with two clauses.
    Bsd2,
    /// BSD with three clauses.
    Bsd3,
    /// MIT.
    Mit,
    /// No text says, or one that is not known.
    Unknown,
}

impl Licence {
    const ALL: [Licence; 5] =
        [Licence::Apache2, Licence::Bsd2, Licence::Bsd3, Licence::Mit, Licence::Unknown];

    /// The SPDX identifier, or `unknown`.
    pub fn id(self) -> &'static str {
        match self {
            Licence::Apache2 => "Apache-2.0",
            Licence::Bsd2 => "BSD-2-Clause",
            Licence::Bsd3 => "BSD-3-Clause",
            Licence::Mit => "MIT",
            Licence::Unknown => "unknown",
        }
    }

    /// The licence with an SPDX identifier.
    pub(crate) fn from_id(id: &str) -> Option<Self> {
        Licence::ALL.into_iter().find(|licence| licence.id() == id)
    }

    /// The licence that a text states, by the sentences that no other has.
    pub(crate) fn of_text(text: &str) -> Self {
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
        let has = |phrase: &str| words.contains(phrase);
        if has("apache license") && has("version 2.0") {
            Licence::Apache2
        } else if has("permission is hereby granted, free of charge, to any person obtaining a copy") {
            Licence::Mit
        } else if !has("redistribution and use in source and binary forms") {
            Licence::Unknown
        } else if has("neither the name") {
            Licence::Bsd3
        } else {
            Licence::Bsd2
        }
    }
}

impl fmt::Display for Licence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.id())
    }
}

/// The licences that a source states, by folder.
#[derive(Default)]
pub(crate) struct Stated {
    folders: BTreeMap<String, Licence>,
    /// What is stated for all of it: by the metadata of a wheel, or around the source.
    whole: Option<Licence>,
}

impl Stated {
    /// Notes the text of the licence file at `path`. Where a folder has several, one that is known wins.
    pub(crate) fn note(&mut self, path: &str, text: &str) {
        debug_assert!(is_licence(path));
        let licence = Licence::of_text(text);
        let (folder, _) = path.rsplit_once('/').unwrap_or(("", path));
        if folder.split('/').next().is_some_and(|top| top.ends_with(".dist-info")) {
            self.note_whole(licence);
        }
        let stated = self.folders.entry(folder.to_owned()).or_insert(licence);
        if *stated == Licence::Unknown {
            *stated = licence;
        }
    }

    /// Notes what is stated for the whole source.
    pub(crate) fn note_whole(&mut self, licence: Licence) {
        self.whole = self.whole.filter(|known| *known != Licence::Unknown).or(Some(licence));
    }

    /// The licence of the file at `path`: stated by the nearest folder above it that states one.
    pub(crate) fn of(&self, path: &str) -> Licence {
        let mut folder = path;
        while !folder.is_empty() {
            folder = folder.rsplit_once('/').map_or("", |(parent, _)| parent);
            if let Some(licence) = self.folders.get(folder) {
                return *licence;
            }
        }
        self.whole.unwrap_or(Licence::Unknown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIT: &str =
        "Permission is hereby granted, free of charge, to any\nperson obtaining a copy of this software";
    const BSD: &str =
        "Redistribution and use in source and binary forms, with or without modification, are permitted";
    const APACHE: &str = "                 Apache License\n           Version 2.0, January 2004\n";

    #[test]
    fn texts_are_known_by_their_sentences() {
        assert_eq!(Licence::of_text(include_str!("../../LICENSE")), Licence::Apache2);
        assert_eq!(Licence::of_text(MIT), Licence::Mit);
        assert_eq!(Licence::of_text(BSD), Licence::Bsd2);
        assert_eq!(Licence::of_text(&format!("{BSD}\nNeither the\nname of")), Licence::Bsd3);
        assert_eq!(Licence::of_text("All rights reserved."), Licence::Unknown);
        for licence in Licence::ALL {
            assert_eq!(Licence::from_id(licence.id()), Some(licence));
        }
    }

    #[test]
    fn the_nearest_text_upwards_counts() {
        let mut stated = Stated::default();
        assert_eq!(stated.of("simhive/a/b.xml"), Licence::Unknown);
        stated.note("robohive-1.dist-info/licenses/LICENSE", APACHE);
        assert_eq!(stated.of("simhive/a/b.xml"), Licence::Apache2);
        stated.note("simhive/a/COPYING", "text of nobody");
        stated.note("simhive/a/LICENSE", MIT);
        stated.note("simhive/LICENSE", BSD);
        assert_eq!(stated.of("simhive/a/b/c.xml"), Licence::Mit);
        assert_eq!(stated.of("simhive/ab/c.xml"), Licence::Bsd2);
        assert_eq!(stated.of("top.xml"), Licence::Apache2);
        stated.note("LICENSE", "text of nobody");
        assert_eq!(stated.of("top.xml"), Licence::Unknown);
    }
}
