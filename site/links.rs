//! Links of the finished site, without a network: pages, fragments, pictures, scripts and styles are there, and nothing is
//! loaded from other hosts.

use crate::html::{Tag, tags};
use crate::link::joined;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Where tags name what a page loads.
const LOADED: [(&str, &str); 8] = [
    ("img", "src"),
    ("script", "src"),
    ("iframe", "src"),
    ("source", "src"),
    ("video", "src"),
    ("link", "href"),
    ("object", "data"),
    ("robohive-viewer", "src"),
];

/// The folder of rustdoc's pages: what is linked there must exist, what they link is rustdoc's to check.
const API: &str = "api";

/// What was looked at.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Pages.
    pub pages: usize,
    /// Links to pages, fragments and files of the site.
    pub inside: usize,
    /// Links to other hosts, which are not followed.
    pub outside: usize,
}

/// Checks all pages of the site in `folder`.
///
/// # Errors
/// All links that lead nowhere, and all that is loaded from elsewhere.
pub fn check(folder: &Path) -> Result<Counts, String> {
    let mut pages = BTreeMap::new();
    let mut styles = Vec::new();
    collect(folder, "", &mut pages, &mut styles)?;
    let mut check =
        Check { folder, fragments: BTreeMap::new(), counts: Counts::default(), wrong: BTreeSet::new() };
    for (page, text) in &pages {
        check.counts.pages += 1;
        tags(text).iter().for_each(|tag| check.tag(page, tag));
    }
    for (style, text) in &styles {
        let loads = text.split("url(").skip(1).filter_map(|rest| rest.split(')').next());
        loads.for_each(|address| check.loaded(style, address.trim_matches(['"', '\''])));
    }
    match check.wrong.is_empty() {
        true => Ok(check.counts),
        false => Err(check.wrong.into_iter().collect::<Vec<_>>().join("\n")),
    }
}

/// The pages and styles of the site but those of rustdoc and of the viewer's own page.
fn collect(
    folder: &Path,
    inside: &str,
    pages: &mut BTreeMap<String, String>,
    styles: &mut Vec<(String, String)>,
) -> Result<(), String> {
    for name in crate::stage::names(folder, inside)? {
        let path = if inside.is_empty() { name } else { format!("{inside}/{name}") };
        let text = || std::fs::read_to_string(folder.join(&path)).map_err(|error| format!("{path}: {error}"));
        if folder.join(&path).is_dir() {
            if path != API && path != "live" {
                collect(folder, &path, pages, styles)?;
            }
        } else if path.ends_with(".html") {
            pages.insert(path.clone(), text()?);
        } else if path.ends_with(".css") {
            styles.push((path.clone(), text()?));
        }
    }
    Ok(())
}

struct Check<'a> {
    folder: &'a Path,
    /// Fragments of the pages that were asked for.
    fragments: BTreeMap<String, BTreeSet<String>>,
    counts: Counts,
    wrong: BTreeSet<String>,
}

impl Check<'_> {
    fn tag(&mut self, page: &str, tag: &Tag) {
        let loaded = LOADED.iter().find(|(name, _)| *name == tag.name).and_then(|(_, from)| tag.value(from));
        if let Some(address) = loaded {
            self.loaded(page, address);
        } else if let Some(address) = tag.value("href") {
            self.linked(page, address);
        }
    }

    fn loaded(&mut self, page: &str, address: &str) {
        if address.starts_with("data:") {
            return;
        }
        if address.contains("://") || address.starts_with("//") {
            self.wrong.insert(format!("{page} loads {address} from another host"));
        } else {
            self.linked(page, address);
        }
    }

    fn linked(&mut self, page: &str, address: &str) {
        if address.contains("://") || address.starts_with("mailto:") {
            self.counts.outside += 1;
            return;
        }
        if address.is_empty() {
            return;
        }
        self.counts.inside += 1;
        let (path, fragment) =
            address.split_once('#').map_or((address, ""), |(path, fragment)| (path, fragment));
        let path = path.split('?').next().unwrap_or_default();
        let file = if path.is_empty() { page.to_owned() } else { joined(page, path) };
        let file = if self.folder.join(&file).is_dir() { format!("{file}/index.html") } else { file };
        if !self.folder.join(&file).is_file() {
            self.wrong.insert(format!("{page} links {address}, and there is no {file}"));
        } else if !fragment.is_empty() && file.ends_with(".html") && !self.has(&file, fragment) {
            self.wrong.insert(format!("{page} links {address}, and {file} has no such fragment"));
        }
    }

    fn has(&mut self, file: &str, fragment: &str) -> bool {
        let folder = self.folder;
        let known = self.fragments.entry(file.to_owned()).or_insert_with(|| {
            let text = std::fs::read_to_string(folder.join(file)).unwrap_or_default();
            let names = |tag: Tag| [tag.value("id").map(str::to_owned), tag.value("name").map(str::to_owned)];
            tags(&text).into_iter().flat_map(names).flatten().collect()
        });
        known.contains(fragment)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_leads_nowhere_or_elsewhere_is_found() {
        let folder = std::env::temp_dir().join(format!("robohive-links-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("a")).unwrap();
        let write = |path: &str, text: &str| std::fs::write(folder.join(path), text).unwrap();
        write(
            "index.html",
            "<h1 id='top'></h1><a href='a/b.html#here'>b</a> <a href='https://x.org'>x</a><img src='c.png'>",
        );
        write(
            "a/b.html",
            "<p id='here'></p><a href='../index.html#top'>t</a><a href='#here'>h</a><script src='../s.js'></script>",
        );
        write("c.png", "");
        write("s.js", "");
        let counts = check(&folder).unwrap();
        assert_eq!((counts.pages, counts.inside, counts.outside), (2, 5, 1));
        write("a/b.html", "<p></p><a href='../none.html'>n</a><script src='https://cdn.org/s.js'></script>");
        write("s.css", "@font-face { src: url('//fonts.org/f.woff2') }");
        let wrong = check(&folder).unwrap_err();
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(wrong.lines().count(), 4, "{wrong}");
        for part in ["no such fragment", "no none.html", "cdn.org", "fonts.org"] {
            assert!(wrong.contains(part), "{wrong}");
        }
    }
}
