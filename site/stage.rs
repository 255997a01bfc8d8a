//! What the site is made of: files of the repository that become pages, laid out in a folder as mdBook wants them.

use crate::block::Block;
use crate::link::{Links, PAGES};
use crate::page::{Generated, Page, read};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Files that become pages beside those in [`PAGES`], each with its page and why its blocks are not run.
const OTHERS: [(&str, &str, &str); 7] = [
    (
        "validation/README.md",
        "validation/method.md",
        "records from MuJoCo or compares whole collections of models",
    ),
    ("benches/README.md", "performance/measurements.md", "measures for minutes, beside MuJoCo"),
    ("CONTRIBUTING.md", "contributing/contributing.md", "is the checks themselves"),
    ("ARCHITECTURE.md", "contributing/architecture.md", "is the checks themselves"),
    ("CHANGELOG.md", "contributing/changelog.md", "shows what has changed"),
    ("SECURITY.md", "contributing/security.md", "is for reports"),
    ("THIRD_PARTY.md", "contributing/third_party.md", "credits others"),
];

/// Folder of the tables of results, all of which are pages.
const RESULTS: &str = "validation/results/";
/// Why their blocks are not run.
const RESULTS_EXCUSE: &str = "repeats a measurement that takes minutes to hours";

/// The pages of the site with the files that they are made of and, where none of their blocks is run, the reason.
pub struct Contents {
    pages: BTreeMap<String, (String, Option<&'static str>)>,
}

impl Contents {
    /// Of the repository at `root`.
    ///
    /// # Errors
    /// A folder cannot be read.
    pub fn of(root: &Path) -> Result<Self, String> {
        let mut pages = BTreeMap::new();
        for file in markdown(root, PAGES.trim_end_matches('/'))? {
            let page = file.trim_start_matches(PAGES).to_owned();
            pages.insert(file, (page, None));
        }
        for file in markdown(root, RESULTS.trim_end_matches('/'))? {
            let page = file.clone();
            pages.insert(file, (page, Some(RESULTS_EXCUSE)));
        }
        for (file, page, excuse) in OTHERS {
            pages.insert(file.to_owned(), (page.to_owned(), Some(excuse)));
        }
        Ok(Contents { pages })
    }

    /// The tables of results for the table of contents, by their titles.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn results(&self, root: &Path) -> Result<String, String> {
        let mut text = String::new();
        for (file, (page, _)) in self.pages.iter().filter(|(file, _)| file.starts_with(RESULTS)) {
            let content = fs::read_to_string(root.join(file)).map_err(|error| format!("{file}: {error}"))?;
            let title = content.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or(page);
            text += &format!("  - [{title}]({page})\n");
        }
        Ok(text)
    }

    /// Writes all pages and pictures below `folder` and returns the blocks of each page.
    ///
    /// # Errors
    /// A page is wrong, with file and line; all that are wrong are named.
    pub fn write(
        &self,
        root: &Path,
        folder: &Path,
        generated: &Generated,
    ) -> Result<Vec<(String, Vec<Block>)>, String> {
        let paths = self.pages.iter().map(|(file, (page, _))| (file.clone(), page.clone()));
        let pictures = pictures(root)?;
        let paths = paths.chain(pictures.iter().map(|(file, page)| (file.clone(), page.clone()))).collect();
        let links = Links::new(root.to_owned(), paths);
        let (mut blocks, mut wrong) = (Vec::new(), Vec::new());
        for (file, (page, excuse)) in &self.pages {
            match read(root, file, *excuse, &links, generated) {
                Ok(Page { text, blocks: own }) => {
                    save(&folder.join(page), text.as_bytes())?;
                    blocks.push((page.clone(), own));
                }
                Err(error) => wrong.push(error),
            }
        }
        for (file, page) in pictures {
            let bytes = fs::read(root.join(&file)).map_err(|error| format!("{file}: {error}"))?;
            save(&folder.join(page), &bytes)?;
        }
        if wrong.is_empty() { Ok(blocks) } else { Err(wrong.join("\n")) }
    }
}

/// Pictures of the repository that pages show, with their places on the site.
fn pictures(root: &Path) -> Result<Vec<(String, String)>, String> {
    let mut list = Vec::new();
    for (folder, place) in [("docs", "pictures/"), ("validation/results", RESULTS)] {
        for name in names(root, folder)? {
            if [".png", ".gif", ".svg"].iter().any(|end| name.ends_with(end)) {
                list.push((format!("{folder}/{name}"), format!("{place}{name}")));
            }
        }
    }
    Ok(list)
}

/// Markdown files in a folder of the repository and below it, sorted.
fn markdown(root: &Path, folder: &str) -> Result<Vec<String>, String> {
    let mut files = Vec::new();
    for name in names(root, folder)? {
        let file = format!("{folder}/{name}");
        if root.join(&file).is_dir() {
            files.extend(markdown(root, &file)?);
        } else if name.ends_with(".md") {
            files.push(file);
        }
    }
    files.sort();
    Ok(files)
}

/// What a folder of the repository holds.
pub fn names(root: &Path, folder: &str) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(root.join(folder)).map_err(|error| format!("{folder}: {error}"))?;
    let mut names: Vec<_> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    Ok(names)
}

/// Writes a file, and the folders that it is in.
///
/// # Errors
/// The file cannot be written.
pub fn save(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let written = path.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(path, bytes));
    written.map_err(|error| format!("{}: {error}", path.display()))
}

/// Copies a folder with all that is in it.
///
/// # Errors
/// A file cannot be read or written.
pub fn copy(from: &Path, to: &Path, wanted: &dyn Fn(&Path) -> bool) -> Result<(), String> {
    for entry in fs::read_dir(from).map_err(|error| format!("{}: {error}", from.display()))?.flatten() {
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        if !wanted(&path) {
            continue;
        }
        if path.is_dir() {
            copy(&path, &target, wanted)?;
        } else {
            let made = target.parent().map_or(Ok(()), fs::create_dir_all);
            made.and_then(|()| fs::copy(&path, &target).map(drop))
                .map_err(|error| format!("{}: {error}", path.display()))?;
        }
    }
    Ok(())
}
