//! What comes in: every entry of a source is checked and counted, and the files that are kept are staged by digest.

use crate::digest::Digest;
use crate::entry_path::{self, BadPath};
use crate::error::StoreError;
use crate::layout;
use crate::limits::{Bounded, Count, Exceeded, Limits};
use crate::progress::{Progress, Watch};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Name of the file that is being staged.
const UNFINISHED: &str = "unfinished";

/// What an import did not take.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Skipped {
    /// Number of files by kind: an extension (`.py`), a folder that is not entered (`in .git/`), or a reason in words.
    pub kinds: BTreeMap<String, u64>,
    /// Links of an imported folder that lead out of it, or to nothing.
    pub links: Vec<String>,
}

impl Skipped {
    /// Counts one file.
    pub(crate) fn count(&mut self, kind: impl Into<String>) {
        *self.kinds.entry(kind.into()).or_default() += 1;
    }
}

/// A file that waits in the staging folder under its digest.
#[derive(Debug)]
pub(crate) struct Staged {
    /// Path in the source.
    pub path: String,
    pub digest: Digest,
    pub size: u64,
}

/// Takes the entries of a source.
pub(crate) struct Intake<'a> {
    /// Folder or archive, for messages.
    pub source: &'a Path,
    pub limits: Limits,
    /// Unpacked bytes so far.
    pub unpacked: Count,
    /// Bytes of the source that were read, of `total`.
    pub position: Count,
    pub total: u64,
    pub skipped: Skipped,
    pub files: Vec<Staged>,
    staging: PathBuf,
    entries: u64,
    watch: Watch<'a>,
}

impl<'a> Intake<'a> {
    /// Stages what comes from `source` in the folder `staging`, which exists.
    pub(crate) fn new(source: &'a Path, staging: PathBuf, limits: Limits, watch: Watch<'a>) -> Self {
        Intake {
            source,
            limits,
            unpacked: Count::default(),
            position: Count::default(),
            total: 0,
            skipped: Skipped::default(),
            files: Vec::new(),
            staging,
            entries: 0,
            watch,
        }
    }

    /// The path of the next entry, checked and counted.
    ///
    /// # Errors
    /// The path is hostile, or there are too many entries.
    pub(crate) fn entry(&mut self, raw: &[u8]) -> Result<String, StoreError> {
        let shown = String::from_utf8_lossy(raw);
        self.entries += 1;
        if self.entries > self.limits.files {
            return Err(self.exceeded(&shown, Exceeded { limit: "files", value: self.limits.files }));
        }
        entry_path::entry(raw, &self.limits).map_err(|bad| match bad {
            BadPath::Refused(reason) => self.refused(&shown, reason),
            BadPath::Exceeded(exceeded) => self.exceeded(&shown, exceeded),
        })
    }

    /// Takes a file, or counts it as skipped without reading it.
    ///
    /// # Errors
    /// It cannot be read or staged, or asks for more than the limits allow.
    pub(crate) fn file(&mut self, path: String, content: &mut dyn Read) -> Result<(), StoreError> {
        (self.watch)(Progress { done: self.position.get(), total: self.total });
        if !layout::is_kept(&path) {
            self.skipped.count(layout::skipped_kind(&path));
            return Ok(());
        }
        if let Some(reason) = entry_path::unportable(&path) {
            return Err(self.refused(&path, reason));
        }
        let unfinished = self.staging.join(UNFINISHED);
        let mut file = File::create(&unfinished).map_err(StoreError::io(&unfinished))?;
        let (digest, size) =
            Digest::copy(content, &mut file).map_err(|error| self.unreadable(&path, error))?;
        let staged = self.staged(digest);
        fs::rename(&unfinished, &staged).map_err(StoreError::io(staged))?;
        self.files.push(Staged { path, digest, size });
        Ok(())
    }

    /// Where the staged content with this digest lies.
    pub(crate) fn staged(&self, digest: Digest) -> PathBuf {
        self.staging.join(digest.to_string())
    }

    /// `reader`, bounded by the limits; `packed` counts the bytes that it unpacks.
    pub(crate) fn bounded<R: Read>(&self, reader: R, packed: Option<Count>) -> Bounded<R> {
        Bounded { inner: reader, limits: self.limits, unpacked: self.unpacked.clone(), packed, own: 0 }
    }

    /// An entry that is refused.
    pub(crate) fn refused(&self, entry: &str, reason: impl Into<String>) -> StoreError {
        StoreError::Entry { source: self.source.to_owned(), entry: entry.to_owned(), reason: reason.into() }
    }

    /// An entry that is neither a plain file nor a folder.
    pub(crate) fn not_plain(&self, entry: &str, what: &str) -> StoreError {
        let remedy = "which an import does not take; make an archive of plain files and folders";
        self.refused(entry, format!("it is {what}, {remedy}"))
    }

    /// An entry that cannot be read to its end.
    pub(crate) fn unreadable(&self, entry: &str, error: io::Error) -> StoreError {
        if let Some(exceeded) = error.get_ref().and_then(|inner| inner.downcast_ref::<Exceeded>()) {
            return self.exceeded(entry, *exceeded);
        }
        match error.kind() {
            io::ErrorKind::UnexpectedEof => self.refused(entry, "the archive ends here: it is truncated"),
            _ => self.refused(entry, error.to_string()),
        }
    }

    fn exceeded(&self, entry: &str, Exceeded { limit, value }: Exceeded) -> StoreError {
        StoreError::Limit { source: self.source.to_owned(), entry: entry.to_owned(), limit, value }
    }
}
