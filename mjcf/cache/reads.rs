//! What a compile read and looked for, and whether it is still so.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crate::digest::{Digest, digest, digest_of};
use crate::files::{FileError, FileProvider, Stamp};

/// Every path that was read or looked for, and what was found there.
pub(crate) type Reads = BTreeMap<String, Seen>;

/// What a path led to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Seen {
    /// The digest of the file's content, `None` where it could not be read, and its stamp, if that settles that the
    /// file has not changed since.
    Content(Option<Digest>, Option<Stamp>),
    /// Whether there is a file; its content was not asked for.
    Exists(bool),
}

impl Seen {
    /// Whether the path still leads to the same.
    pub(super) fn holds(&self, files: &dyn FileProvider, path: &str) -> bool {
        match self {
            Seen::Content(_, Some(stamp)) if files.stamp(path) == Some(*stamp) => true,
            Seen::Content(digest, _) => digest_now(files, path) == *digest,
            Seen::Exists(exists) => files.exists(path) == *exists,
        }
    }
}

/// The digest of the file at `path`, read piece by piece.
fn digest_now(files: &dyn FileProvider, path: &str) -> Option<Digest> {
    let (source, _) = files.open(path).ok()?;
    digest_of(source).ok()
}

/// A file that changed so shortly before it was read may have changed again without its time telling.
const SETTLED: Duration = Duration::from_secs(2);

/// The latest change that settles, in nanoseconds since 1970; `None` where there is no clock.
fn settled() -> Option<i128> {
    if cfg!(all(target_family = "wasm", target_os = "unknown")) {
        return None;
    }
    let now = std::time::SystemTime::now().duration_since(std::time::SystemTime::UNIX_EPOCH).ok()?;
    Some(now.saturating_sub(SETTLED).as_nanos() as i128)
}

/// Files whose reading is noted.
pub(crate) struct Noted<'a> {
    files: &'a dyn FileProvider,
    reads: RefCell<Reads>,
}

impl<'a> Noted<'a> {
    pub(crate) fn new(files: &'a dyn FileProvider) -> Self {
        Noted { files, reads: RefCell::default() }
    }

    /// What was read and looked for so far.
    pub(crate) fn reads(self) -> Reads {
        self.reads.into_inner()
    }
}

impl FileProvider for Noted<'_> {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        // The stamp is taken before the file is read: a change in between then shows.
        let settled = settled();
        let stamp =
            self.files.stamp(path).filter(|stamp| settled.is_some_and(|at| i128::from(stamp.changed) < at));
        let read = self.files.read(path);
        let content = read.as_ref().ok().map(|bytes| digest(bytes));
        self.reads.borrow_mut().insert(path.to_owned(), Seen::Content(content, stamp));
        read
    }

    fn exists(&self, path: &str) -> bool {
        let exists = self.files.exists(path);
        self.reads.borrow_mut().entry(path.to_owned()).or_insert(Seen::Exists(exists));
        exists
    }
}
