//! Links of pages: from one file of the repository to another, as they work there, to one page of the site to another.

use std::collections::BTreeMap;
use std::path::PathBuf;

/// Where files of the repository are shown that are no pages.
const REPOSITORY: &str = "https://github.com/robohive/robohive-rs";

/// Folder of the pages that are written for the site.
pub const PAGES: &str = "site/pages/";

/// Folders of the site that are made when it is built; what is linked there is looked up in the finished site.
const MADE: [&str; 3] = ["api/", "live/", "pictures/"];

/// Which files of the repository are pages.
pub struct Links {
    root: PathBuf,
    pages: BTreeMap<String, String>,
}

impl Links {
    /// Of the repository at `root`, with the page of each file that is one.
    pub fn new(root: PathBuf, pages: BTreeMap<String, String>) -> Self {
        Links { root, pages }
    }

    /// A line of `source` with its links as the site needs them.
    ///
    /// # Errors
    /// A link that leads nowhere.
    pub fn rewritten(&self, source: &str, line: &str) -> Result<String, String> {
        let mut out = String::new();
        let mut rest = line;
        while let Some((place, end)) = next_target(rest) {
            let target = &rest[place..end];
            out += &rest[..place];
            out += &self.resolved(source, target)?;
            rest = &rest[end..];
        }
        Ok(out + rest)
    }

    /// Where a link of `source` leads on the site.
    fn resolved(&self, source: &str, target: &str) -> Result<String, String> {
        if target.is_empty()
            || target.starts_with('#')
            || target.contains("://")
            || target.starts_with("mailto:")
        {
            return Ok(target.to_owned());
        }
        let (path, fragment) =
            target.split_once('#').map_or((target, None), |(path, part)| (path, Some(part)));
        let fragment = fragment.map_or(String::new(), |part| format!("#{part}"));
        let file = joined(source, path);
        // The table of contents names pages.
        let is_page =
            file.strip_prefix(PAGES).is_some_and(|path| self.pages.values().any(|page| page == path));
        let made =
            file.strip_prefix(PAGES).is_some_and(|path| MADE.iter().any(|folder| path.starts_with(folder)));
        if made || is_page && !self.pages.contains_key(&file) {
            return Ok(target.to_owned());
        }
        if let Some(page) = self.pages.get(&file) {
            let here = self.pages.get(source).ok_or_else(|| format!("{source} is no page"))?;
            return Ok(relative(here, page) + &fragment);
        }
        let on_disk = self.root.join(&file);
        match (on_disk.is_dir(), on_disk.is_file()) {
            (true, _) => Ok(format!("{REPOSITORY}/tree/main/{file}{fragment}")),
            (_, true) => Ok(format!("{REPOSITORY}/blob/main/{file}{fragment}")),
            _ => Err(format!("{file} is neither a page nor a file")),
        }
    }
}

/// The bytes of the first target of a link in a line: of `[…](TARGET)`, `href="TARGET"` or `src="TARGET"`, outside of code.
fn next_target(line: &str) -> Option<(usize, usize)> {
    let mut at = 0;
    while at < line.len() {
        let rest = &line[at..];
        if rest.starts_with('`') {
            let ticks = rest.len() - rest.trim_start_matches('`').len();
            let fence = "`".repeat(ticks);
            at += ticks + rest[ticks..].find(&fence).map_or(0, |end| end + ticks);
        } else if let Some(target) = rest.strip_prefix("](") {
            return Some((at + 2, at + 2 + target.find([')', ' ']).unwrap_or(target.len())));
        } else if let Some(start) = [" href=\"", " src=\""].iter().find(|start| rest.starts_with(**start)) {
            let target = &rest[start.len()..];
            return Some((at + start.len(), at + start.len() + target.find('"').unwrap_or(target.len())));
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    None
}

/// `path` as it is written in the file `source`, from the folder that `source` is counted from.
pub fn joined(source: &str, path: &str) -> String {
    let folder = source.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(path.split('/')) {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

/// The way from the page `here` to the page or file `there`, both counted from the same folder.
pub fn relative(here: &str, there: &str) -> String {
    let folder: Vec<&str> = here.split('/').collect();
    let folder = &folder[..folder.len() - 1];
    let there: Vec<&str> = there.split('/').collect();
    let shared = folder.iter().zip(&there[..there.len() - 1]).take_while(|(a, b)| a == b).count();
    let up = vec![".."; folder.len() - shared];
    up.into_iter().chain(there[shared..].iter().copied()).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_joined_and_told_from_one_page_to_another() {
        assert_eq!(joined("site/pages/a/b.md", "../../../docs/x.png"), "docs/x.png");
        assert_eq!(joined("README.md", "docs/x.png"), "docs/x.png");
        assert_eq!(relative("a/b/c.md", "a/d.md"), "../d.md");
        assert_eq!(relative("c.md", "a/d.md"), "a/d.md");
        assert_eq!(relative("a/c.md", "a/d.md"), "d.md");
    }

    #[test]
    fn links_lead_to_pages_to_files_or_nowhere() {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
        let pages = [("README.md", "x/readme.md"), ("site/pages/b.md", "b.md")];
        let pages = pages.map(|(file, page)| (file.to_owned(), page.to_owned())).into();
        let links = Links::new(root, pages);
        let line = |source, line| links.rewritten(source, line);
        assert_eq!(
            line("README.md", "a [b](site/pages/b.md#c) `[d](e)`").unwrap(),
            "a [b](../b.md#c) `[d](e)`"
        );
        assert_eq!(
            line("site/pages/b.md", "<img src=\"pictures/a.png\">").unwrap(),
            "<img src=\"pictures/a.png\">"
        );
        let file = format!("[a]({REPOSITORY}/blob/main/LICENSE)");
        assert_eq!(line("site/pages/b.md", "[a](../../LICENSE)").unwrap(), file);
        assert_eq!(
            line("README.md", "[a](https://mujoco.org) [b](#c)").unwrap(),
            "[a](https://mujoco.org) [b](#c)"
        );
        assert!(line("README.md", "[a](nothing.md)").unwrap_err().contains("nothing.md"));
    }
}
