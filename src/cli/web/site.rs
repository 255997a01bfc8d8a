//! What is served: the page's files, and those of a model.

use super::model::{absolute, common_folder, files};
use crate::failure::Failure;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

/// Where files of a model stand in the site.
const OPEN: &str = "open";
/// What a folder with the page has.
const INDEX: &str = "index.html";

#[cfg(feature = "page")]
mod embedded {
    include!(concat!(env!("OUT_DIR"), "/page.rs"));
}

/// The page's files that are part of this program: names and contents.
#[cfg(feature = "page")]
const EMBEDDED: &[(&str, &[u8])] = embedded::FILES;
#[cfg(not(feature = "page"))]
const EMBEDDED: &[(&str, &[u8])] = &[];

/// Files by the paths at which they are served.
pub struct Site {
    files: BTreeMap<String, Content>,
    origin: String,
}

enum Content {
    Disk(PathBuf),
    Inside(&'static [u8]),
}

impl Site {
    /// The page in `folder`, or where it is otherwise.
    pub fn find(folder: Option<&Path>) -> Result<Self, Failure> {
        if let Some(folder) = folder {
            return Self::of(folder).ok_or_else(|| {
                Failure::usage(format!(
                    "{} does not hold the page: it has no {INDEX}. {HOW_TO_BUILD}",
                    folder.display()
                ))
            });
        }
        if !EMBEDDED.is_empty() {
            let files = EMBEDDED.iter().map(|&(name, bytes)| (name.to_owned(), Content::Inside(bytes)));
            return Ok(Site { files: files.collect(), origin: "this program".into() });
        }
        beside().iter().find_map(|folder| Self::of(folder)).ok_or_else(|| {
            Failure::new(format!(
                "the page has not been built, or is not where it is looked for. {HOW_TO_BUILD}"
            ))
        })
    }

    /// The files of a folder that has the page. Folders inside of it, and links, are not served.
    fn of(folder: &Path) -> Option<Self> {
        let entries = fs::read_dir(folder).ok()?.flatten();
        let plain = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()));
        let named = plain.filter_map(|entry| Some((entry.file_name().into_string().ok()?, entry.path())));
        let files: BTreeMap<_, _> = named.map(|(name, path)| (name, Content::Disk(path))).collect();
        files.contains_key(INDEX).then(|| Site { files, origin: folder.display().to_string() })
    }

    /// What the page comes from.
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// Adds the files that a model reads; the path at which the model is served.
    pub fn add_model(&mut self, model: &Path) -> Result<String, Failure> {
        let files = files(model);
        let root = common_folder(&files);
        let served = |file: &Path| {
            let inside = file.strip_prefix(&root).ok()?;
            let parts: Option<Vec<&str>> =
                inside.components().map(|part| part.as_os_str().to_str()).collect();
            Some(format!("{OPEN}/{}", parts?.join("/")))
        };
        for file in &files {
            if let Some(path) = served(file) {
                self.files.insert(path, Content::Disk(file.clone()));
            }
        }
        let path = absolute(model).and_then(|file| served(&file));
        path.ok_or_else(|| {
            Failure::usage(format!("{}: the path of a model must be UTF-8; rename it", model.display()))
        })
    }

    /// The content of what is served at `path`, without the slash it begins with, and its length.
    pub fn open(&self, path: &str) -> Option<(Box<dyn Read>, u64)> {
        match self.files.get(if path.is_empty() { INDEX } else { path })? {
            Content::Inside(bytes) => Some((Box::new(Cursor::new(*bytes)), bytes.len() as u64)),
            Content::Disk(path) => {
                let file = File::open(path).ok()?;
                let length = file.metadata().ok().filter(|about| about.is_file())?.len();
                Some((Box::new(file), length))
            }
        }
    }
}

const HOW_TO_BUILD: &str = "`cargo xtask web` builds it, in a checkout of RoboHive, into target/web; `robohive web --page FOLDER` \
serves it from anywhere";

/// Where the page is looked for: as an installation has it, and as a checkout does.
fn beside() -> Vec<PathBuf> {
    let program = std::env::current_exe().and_then(fs::canonicalize).unwrap_or_default();
    let Some(folder) = program.parent() else { return Vec::new() };
    vec![folder.join("../share/robohive/web"), folder.join("../web")]
}
