//! What a store holds after an import, or why it would contradict itself.

use crate::error::StoreError;
use crate::licence::Licence;
use crate::manifest::{Entry, Manifest};
use std::collections::BTreeMap;
use std::path::Path;

/// A file that an import brings.
#[derive(Debug)]
pub(crate) struct Arrival {
    /// Virtual path.
    pub path: String,
    /// Path in the source.
    pub from: String,
    pub entry: Entry,
}

/// A manifest with what an import changed in it.
#[derive(Debug)]
pub(crate) struct Merged {
    pub manifest: Manifest,
    pub added: usize,
    pub unchanged: usize,
    /// Virtual paths whose content is another now.
    pub replaced: Vec<String>,
}

/// Adds the files of `source` to a manifest.
///
/// # Errors
/// [`StoreError::Conflict`]: files of the source contradict each other, stored ones (unless `replace`), or no system could
/// keep both.
pub(crate) fn merge(
    manifest: Manifest,
    arrivals: Vec<Arrival>,
    replace: bool,
    source: &Path,
) -> Result<Merged, StoreError> {
    let refuse = |files: Vec<String>, replaceable| match files.is_empty() {
        true => Ok(()),
        false => Err(StoreError::Conflict { source: source.to_owned(), files, replaceable }),
    };
    refuse(contradictions(&arrivals), false)?;
    let mut merged = Merged { manifest, added: 0, unchanged: 0, replaced: Vec::new() };
    let mut conflicts = Vec::new();
    let arrivals: BTreeMap<_, _> = arrivals.into_iter().map(|file| (file.path, file.entry)).collect();
    for (path, entry) in arrivals {
        match merged.manifest.entries.get_mut(&path) {
            None => {
                merged.added += 1;
                merged.manifest.entries.insert(path, entry);
            }
            Some(stored) if stored.digest == entry.digest => {
                merged.unchanged += 1;
                if stored.licence == Licence::Unknown {
                    stored.licence = entry.licence;
                }
            }
            Some(stored) => {
                let (old, new) = (stored.size, entry.size);
                conflicts
                    .push(format!("{path}: {old} bytes stored from {}, {new} bytes here", stored.source));
                *stored = entry;
                merged.replaced.push(path);
            }
        }
    }
    if !replace {
        refuse(conflicts, true)?;
    }
    refuse(clashes(&merged.manifest), false)?;
    Ok(merged)
}

/// Files of one source that claim the same virtual path with different contents.
fn contradictions(arrivals: &[Arrival]) -> Vec<String> {
    let mut first: BTreeMap<&str, &Arrival> = BTreeMap::new();
    let mut found = Vec::new();
    for arrival in arrivals {
        let known = first.entry(&arrival.path).or_insert(arrival);
        if known.entry.digest != arrival.entry.digest {
            found.push(format!("{}: {} and {} differ", arrival.path, known.from, arrival.from));
        }
    }
    found
}

/// Paths that cannot stand side by side: equal but for case, or a file where another path has a folder.
fn clashes(manifest: &Manifest) -> Vec<String> {
    let mut folded: BTreeMap<String, &str> = BTreeMap::new();
    let mut found = Vec::new();
    for path in manifest.entries.keys() {
        if let Some(other) = folded.insert(path.to_lowercase(), path) {
            found.push(format!("{other} and {path} are one name where case does not count"));
        }
    }
    for (lower, path) in &folded {
        let parents = lower.match_indices('/').map(|(at, _)| &lower[..at]);
        found.extend(
            parents
                .filter_map(|parent| folded.get(parent))
                .map(|file| format!("{file} is a file, and a folder in {path}")),
        );
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::digest::Digest;

    fn arrival(path: &str, content: &str) -> Arrival {
        let entry = Entry {
            digest: Digest::of(content.as_bytes()),
            size: content.len() as u64,
            licence: Licence::Unknown,
            source: "first".into(),
        };
        Arrival { path: path.into(), from: format!("src/{path}"), entry }
    }

    fn files(error: StoreError) -> (Vec<String>, bool) {
        match error {
            StoreError::Conflict { files, replaceable, .. } => (files, replaceable),
            other => panic!("{other}"),
        }
    }

    #[test]
    fn imports_merge_and_contradictions_need_leave() {
        let first = vec![arrival("envs/a.xml", "a"), arrival("envs/b.xml", "b")];
        let stored = merge(Manifest::default(), first, false, Path::new("")).unwrap();
        assert_eq!((stored.added, stored.unchanged, stored.replaced.len()), (2, 0, 0));

        let second =
            || vec![arrival("envs/a.xml", "other"), arrival("envs/b.xml", "b"), arrival("envs/c", "")];
        let refused = merge(stored.manifest.clone(), second(), false, Path::new("")).unwrap_err();
        let expected = "envs/a.xml: 1 bytes stored from first, 5 bytes here".to_owned();
        assert_eq!(files(refused), (vec![expected], true));

        let merged = merge(stored.manifest, second(), true, Path::new("")).unwrap();
        assert_eq!((merged.added, merged.unchanged, merged.replaced), (1, 1, vec!["envs/a.xml".to_owned()]));
        assert_eq!(merged.manifest.entries["envs/a.xml"].digest, Digest::of(b"other"));
    }

    #[test]
    fn a_licence_that_was_unknown_is_learnt() {
        let mut known = arrival("envs/a.xml", "a");
        known.entry.licence = Licence::Mit;
        let stored =
            merge(Manifest::default(), vec![arrival("envs/a.xml", "a")], false, Path::new("")).unwrap();
        let merged = merge(stored.manifest, vec![known], false, Path::new("")).unwrap();
        assert_eq!(merged.manifest.entries["envs/a.xml"].licence, Licence::Mit);
        let again = merge(merged.manifest, vec![arrival("envs/a.xml", "a")], false, Path::new("")).unwrap();
        assert_eq!(again.manifest.entries["envs/a.xml"].licence, Licence::Mit);
    }

    #[test]
    fn what_cannot_stand_side_by_side_is_refused() {
        let cases = [
            [("envs/a.xml", "1"), ("envs/a.xml", "2")],
            [("envs/a.xml", "1"), ("envs/A.xml", "1")],
            [("envs/a", "1"), ("envs/a/b", "1")],
            [("envs/A", "1"), ("envs/a/b", "1")],
        ];
        for case in cases {
            let arrivals = case.map(|(path, content)| arrival(path, content)).into();
            let (files, replaceable) =
                files(merge(Manifest::default(), arrivals, true, Path::new("")).unwrap_err());
            assert!(files.len() == 1 && !replaceable, "{files:?}");
        }
        let same = vec![arrival("envs/a.xml", "1"), arrival("envs/a.xml", "1")];
        assert_eq!(merge(Manifest::default(), same, false, Path::new("")).unwrap().added, 1);
    }
}
