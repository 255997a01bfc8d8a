//! The list of what a store holds.
//!
//! A text of lines with tabs between fields, sorted by path:
//!
//! ```text
//! robohive-store 1
//! DIGEST  SIZE  LICENCE  PATH  SOURCE
//! end  DIGEST-OF-ALL-LINES-ABOVE
//! ```

use crate::digest::Digest;
use crate::entry_path;
use crate::error::StoreError;
use crate::licence::Licence;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

const HEADER: &str = "robohive-store 1";

/// A file of the store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Digest of its content.
    pub digest: Digest,
    /// Bytes.
    pub size: u64,
    /// Licence that its source states for it.
    pub licence: Licence,
    /// Folder or archive that it was imported from.
    pub source: String,
}

/// Entries by virtual path.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Manifest {
    pub entries: BTreeMap<String, Entry>,
}

impl Manifest {
    /// Reads a manifest; a store without a manifest has an empty one.
    ///
    /// # Errors
    /// The file cannot be read, or is not one that [`Self::text`] wrote.
    pub(crate) fn read(path: &Path) -> Result<Self, StoreError> {
        match std::fs::read(path) {
            Ok(bytes) => Self::parse(&String::from_utf8_lossy(&bytes))
                .map_err(|(line, reason)| StoreError::Manifest { path: path.to_owned(), line, reason }),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Self::default()),
            Err(error) => Err(StoreError::io(path)(error)),
        }
    }

    /// The manifest as a text.
    pub(crate) fn text(&self) -> String {
        let mut text = format!("{HEADER}\n");
        for (path, Entry { digest, size, licence, source }) in &self.entries {
            // Whoever names a folder may put line ends into it.
            let source = source.replace(char::is_control, "?");
            _ = writeln!(text, "{digest}\t{size}\t{licence}\t{path}\t{source}");
        }
        let digest = Digest::of(text.as_bytes());
        _ = writeln!(text, "end\t{digest}");
        text
    }

    /// The digest that the tree of this manifest is stamped with.
    pub(crate) fn digest(&self) -> Digest {
        Digest::of(self.text().as_bytes())
    }

    fn parse(text: &str) -> Result<Self, (usize, String)> {
        let mut entries = BTreeMap::new();
        let mut lines = text.lines().enumerate();
        if lines.next().is_none_or(|(_, line)| line != HEADER) {
            return Err((1, format!("the first line must be {HEADER:?}: another version, or damaged")));
        }
        for (i, line) in lines {
            let wrong = || (i + 1, "damaged".to_owned());
            let fields: Vec<_> = line.split('\t').collect();
            match fields[..] {
                ["end", digest] => {
                    let above = text.find("\nend\t").map_or(0, |at| at + 1);
                    let sound = Digest::parse(digest) == Some(Digest::of(&text.as_bytes()[..above]));
                    return if sound { Ok(Manifest { entries }) } else { Err(wrong()) };
                }
                [digest, size, licence, path, source] => {
                    let entry = Entry {
                        digest: Digest::parse(digest).ok_or_else(wrong)?,
                        size: size.parse().map_err(|_| wrong())?,
                        licence: Licence::from_id(licence).ok_or_else(wrong)?,
                        source: source.to_owned(),
                    };
                    // The digest at the end guards against accidents; a path out of the store is refused in any case.
                    if entry_path::fold(path).as_deref() != Ok(path) {
                        return Err(wrong());
                    }
                    entries.insert(path.to_owned(), entry);
                }
                _ => return Err(wrong()),
            }
        }
        Err((text.lines().count(), "the end of the manifest is missing".into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest() -> Manifest {
        let entry = |content: &str, licence| Entry {
            digest: Digest::of(content.as_bytes()),
            size: content.len() as u64,
            licence,
            source: "a source.tar".into(),
        };
        let entries = [
            ("envs/a b.xml".to_owned(), entry("a", Licence::Mit)),
            ("simhive/é.stl".to_owned(), entry("b", Licence::Unknown)),
        ];
        Manifest { entries: entries.into() }
    }

    #[test]
    fn a_manifest_survives_its_text() {
        assert_eq!(Manifest::parse(&manifest().text()), Ok(manifest()));
        assert_eq!(Manifest::parse(&Manifest::default().text()), Ok(Manifest::default()));
        assert_ne!(manifest().digest(), Manifest::default().digest());
    }

    #[test]
    fn names_of_sources_cannot_break_lines() {
        let mut odd = manifest();
        odd.entries.values_mut().for_each(|entry| entry.source = "a\tb\n".into());
        let read = Manifest::parse(&odd.text()).unwrap();
        assert!(read.entries.values().all(|entry| entry.source == "a?b?"));
    }

    #[test]
    fn damage_is_found_wherever_it_is() {
        let text = manifest().text();
        assert!(text.is_char_boundary(text.len()) && text.lines().count() == 4);
        for end in (0..text.len() - 1).filter(|&end| text.is_char_boundary(end)) {
            assert!(Manifest::parse(&text[..end]).is_err(), "cut at {end}");
        }
        for (from, to) in [("a b", "a c"), ("MIT", "BSD"), ("\t1\t", "\t2\t"), ("store 1", "store 2")] {
            assert!(text.contains(from) && Manifest::parse(&text.replacen(from, to, 1)).is_err(), "{from}");
        }
    }

    #[test]
    fn a_manifest_cannot_lead_out_of_the_store() {
        let mut evil = Manifest::default();
        for path in ["envs/../../x", "/etc/passwd", "other/a", "envs/./a"] {
            evil.entries = [(path.to_owned(), manifest().entries["envs/a b.xml"].clone())].into();
            assert!(Manifest::parse(&evil.text()).is_err(), "{path}");
        }
    }
}
