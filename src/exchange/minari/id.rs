//! Names of datasets.

use std::fmt;

/// The name of a dataset, such as `robohive/door/random-v0`: folders, a name, a version.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DatasetId(String);

/// A name that Minari would not load.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DatasetIdError {
    id: String,
    why: &'static str,
}

impl fmt::Display for DatasetIdError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no dataset id: {:?}: {}, as in robohive/door/random-v0", self.id, self.why)
    }
}

impl std::error::Error for DatasetIdError {}

impl DatasetId {
    /// Checks a name.
    ///
    /// # Errors
    /// Minari would not load it; the message says which part is wrong.
    pub fn new(id: &str) -> Result<Self, DatasetIdError> {
        let fail = |why| Err(DatasetIdError { id: id.to_owned(), why });
        let Some((name, version)) = id.rsplit_once("-v") else { return fail("it ends in -v and a number") };
        if version.is_empty() || !version.bytes().all(|b| b.is_ascii_digit()) {
            return fail("it ends in -v and a number");
        }
        let plain = |part: &str| {
            !part.is_empty() && part.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_')
        };
        if !name.split('/').all(plain) {
            return fail("its parts are letters, digits, - and _, with / between them");
        }
        if name.rsplit_once('/').is_some_and(|(folders, _)| folders.len() < 2) {
            return fail("the folders before its name have two letters at least");
        }
        Ok(DatasetId(id.to_owned()))
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The folders that lead to it, the outermost first.
    pub fn folders(&self) -> impl Iterator<Item = &str> {
        self.0.match_indices('/').map(|(at, _)| &self.0[..at])
    }
}

impl fmt::Display for DatasetId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_that_minari_takes() {
        let id = DatasetId::new("robohive/door/random-v10").unwrap();
        assert_eq!(id.folders().collect::<Vec<_>>(), ["robohive", "robohive/door"]);
        for wrong in
            ["door", "door-v", "door-vx", "robohive//door-v0", "../door-v0", "a b-v0", "-v0x", "r/door-v0"]
        {
            assert!(DatasetId::new(wrong).is_err(), "{wrong}");
        }
    }
}
