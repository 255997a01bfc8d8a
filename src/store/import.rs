//! From a folder or an archive into a store.

use crate::commit::{Staging, commit, manifest_path};
use crate::error::StoreError;
use crate::intake::{Intake, Skipped, Staged};
use crate::layout::{Layout, is_licence};
use crate::licence::{MAX_TEXT, Stated};
use crate::limits::Limits;
use crate::lock::Lock;
use crate::manifest::{Entry, Manifest};
use crate::merge::{Arrival, merge};
use crate::progress::Watch;
use crate::source;
use crate::surroundings;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// How an import is done.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct ImportOptions {
    /// What the source may ask for.
    pub limits: Limits,
    /// Whether files that contradict stored ones replace them.
    pub replace: bool,
}

impl ImportOptions {
    /// What the source may ask for.
    #[must_use]
    pub fn with_limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Whether files that contradict stored ones replace them.
    #[must_use]
    pub fn with_replace(mut self, replace: bool) -> Self {
        self.replace = replace;
        self
    }
}

/// What an import did.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Imported {
    /// Files that the store did not have.
    pub added: usize,
    /// Files that it had with the same content.
    pub unchanged: usize,
    /// Virtual paths whose content is another now.
    pub replaced: Vec<String>,
    /// Bytes of all files that the source brought.
    pub bytes: u64,
    /// What was not taken.
    pub skipped: Skipped,
}

/// Imports `source` into the folder `store`, which is created if need be; the manifest from then on, and what was done.
///
/// # Errors
/// The source is unreadable, hostile, unknown or contradictory, another import runs, or the file system refuses. Unless the
/// failure came after the manifest was in place, the store holds what it held before.
pub(crate) fn run(
    store: &Path,
    source: &Path,
    options: &ImportOptions,
    watch: Watch<'_>,
) -> Result<(Manifest, Imported), StoreError> {
    let source = &fs::canonicalize(source).map_err(StoreError::io(source))?;
    fs::create_dir_all(store).map_err(StoreError::io(store))?;
    let _lock = Lock::take(store)?;
    let before = Manifest::read(&manifest_path(store))?;
    let staging = Staging::clear(store)?;

    let mut intake = Intake::new(source, staging.folder().to_owned(), options.limits, watch);
    source::read(source, &mut intake)?;
    let stated = licences(&intake)?;
    let arrivals = arrivals(source, &mut intake, &stated)?;
    let bytes = arrivals.iter().map(|file| file.entry.size).sum();
    let arrived: BTreeSet<_> = arrivals.iter().map(|file| file.entry.digest).collect();

    let merged = merge(before, arrivals, options.replace, source)?;
    commit(store, &staging, &arrived, &merged.manifest)?;
    let (added, unchanged, replaced) = (merged.added, merged.unchanged, merged.replaced);
    Ok((merged.manifest, Imported { added, unchanged, replaced, bytes, skipped: intake.skipped }))
}

/// Reads the licence texts among the staged files, and those around an imported folder.
fn licences(intake: &Intake<'_>) -> Result<Stated, StoreError> {
    let mut stated = Stated::default();
    for Staged { path, digest, .. } in intake.files.iter().filter(|file| is_licence(&file.path)) {
        let staged = intake.staged(*digest);
        let mut text = Vec::new();
        let file = File::open(&staged).map_err(StoreError::io(&staged))?;
        file.take(MAX_TEXT).read_to_end(&mut text).map_err(StoreError::io(&staged))?;
        stated.note(path, &String::from_utf8_lossy(&text));
    }
    if intake.source.is_dir() {
        surroundings::licences(intake.source).into_iter().for_each(|licence| stated.note_whole(licence));
    }
    Ok(stated)
}

/// Gives the staged files their virtual paths.
fn arrivals(source: &Path, intake: &mut Intake<'_>, stated: &Stated) -> Result<Vec<Arrival>, StoreError> {
    // A folder inside of a root has its place from its own name and its parent's: `simhive/Adroit`, `robohive/envs`.
    let prefixes = [String::new(), if source.is_dir() { last_names(source) } else { String::new() }];
    let place = |prefix: &String| {
        let paths: Vec<_> = intake.files.iter().map(|file| format!("{prefix}{}", file.path)).collect();
        let layout = Layout::of(paths.iter().map(String::as_str));
        paths.iter().map(|path| layout.place(path)).collect::<Vec<_>>()
    };
    let mut places = prefixes.iter().map(place);
    let models = |places: &Vec<Option<String>>| places.iter().flatten().any(|path| !is_licence(path));
    let Some(places) = places.find(models) else {
        return Err(StoreError::Layout { source: source.to_owned(), files: intake.files.len() });
    };
    let mut arrivals = Vec::new();
    for (file, place) in std::mem::take(&mut intake.files).into_iter().zip(places) {
        let Some(path) = place else {
            if !is_licence(&file.path) {
                intake.skipped.count("outside of RoboHive's envs and simhive");
            }
            continue;
        };
        let entry = Entry {
            digest: file.digest,
            size: file.size,
            licence: stated.of(&file.path),
            source: source.display().to_string(),
        };
        arrivals.push(Arrival { path, from: file.path, entry });
    }
    Ok(arrivals)
}

/// The last two names of a path, each with a slash after it.
fn last_names(path: &Path) -> String {
    let names: Vec<_> = path.iter().filter_map(|name| name.to_str()).collect();
    names[names.len().saturating_sub(2)..].iter().map(|name| format!("{name}/")).collect()
}
