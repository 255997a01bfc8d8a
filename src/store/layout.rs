//! Which files of a source are models' and where they belong.
//!
//! Whatever a source is called and however deep its folders lie, RoboHive's models stand in a folder `envs` and the
//! repositories that they include in `simhive`. Those two names are the roots of the store's virtual paths, in which the
//! relative includes between them (`../../simhive/…`) hold.

use std::collections::BTreeSet;

/// Extensions of the files that models and tasks read.
const KINDS: [&str; 8] = ["xml", "stl", "obj", "msh", "png", "npz", "npy", "config"];

/// Folders that hold no models, whatever lies in them.
const FOREIGN: [&str; 4] = [".git", "__pycache__", "node_modules", "__MACOSX"];

/// Folders of simhive.
const REPOSITORIES: [&str; 14] = [
    "Adroit",
    "MPL_sim",
    "YCB_sim",
    "dmanus_sim",
    "fetch_sim",
    "franka_sim",
    "furniture_sim",
    "myo_sim",
    "object_sim",
    "robel_sim",
    "robotiq_sim",
    "sawyer_sim",
    "scene_sim",
    "trifinger_sim",
];

/// Folders that make an `envs` RoboHive's: others, MyoSuite's among them, have a folder of that name too.
const SUITES: [&str; 7] = ["arms", "claws", "fm", "hands", "multi_task", "quadrupeds", "tcdm"];

/// Name of a file or folder.
fn name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// Whether the folder is not worth entering.
pub(crate) fn is_foreign(folder: &str) -> bool {
    FOREIGN.contains(&name(folder))
}

/// Whether models or tasks may read a file of this kind, or it is a licence.
pub(crate) fn is_kept(path: &str) -> bool {
    let extension = name(path).rsplit_once('.').map_or(String::new(), |(_, e)| e.to_ascii_lowercase());
    let inside_foreign = path.split('/').any(|part| FOREIGN.contains(&part));
    !inside_foreign && (KINDS.contains(&extension.as_str()) || is_licence(path))
}

/// Whether the file states a licence.
pub(crate) fn is_licence(path: &str) -> bool {
    let name = name(path).to_ascii_uppercase();
    let (stem, extension) = name.rsplit_once('.').unwrap_or((&name, ""));
    let named = ["LICENSE", "LICENCE", "COPYING"].iter().any(|start| stem.starts_with(start));
    named && ["", "TXT", "MD", "RST"].contains(&extension)
}

/// How a file that is not kept is counted: by its extension, or as what it is.
pub(crate) fn skipped_kind(path: &str) -> String {
    match path.split('/').find(|part| FOREIGN.contains(part)) {
        Some(folder) => format!("in {folder}/"),
        None => match name(path).rsplit_once('.') {
            Some((stem, extension)) if !stem.is_empty() => format!(".{}", extension.to_ascii_lowercase()),
            _ => "without extension".into(),
        },
    }
}

/// Where the roots of a source lie.
pub(crate) struct Layout {
    /// Paths of RoboHive's `envs` folders.
    envs: BTreeSet<String>,
}

impl Layout {
    /// Finds the roots among the paths of a source.
    pub(crate) fn of<'a>(paths: impl Iterator<Item = &'a str>) -> Self {
        let mut envs = BTreeSet::new();
        for path in paths {
            let parts: Vec<_> = path.split('/').collect();
            let at = parts.windows(2).position(|pair| pair[0] == "envs" && SUITES.contains(&pair[1]));
            // The suite is a folder: something follows it.
            if let Some(at) = at.filter(|at| at + 2 < parts.len()) {
                envs.insert(parts[..=at].join("/"));
            }
        }
        Layout { envs }
    }

    /// The virtual path of a file; `None` when it lies outside of all roots.
    pub(crate) fn place(&self, path: &str) -> Option<String> {
        let parts: Vec<_> = path.split('/').collect();
        for at in 0..parts.len() - 1 {
            if parts[at] == "simhive" {
                return Some(parts[at..].join("/"));
            }
            if REPOSITORIES.contains(&parts[at]) {
                return Some(format!("simhive/{}", parts[at..].join("/")));
            }
            if parts[at] == "envs" && self.envs.contains(&parts[..=at].join("/")) {
                return Some(parts[at..].join("/"));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(paths: &[&str]) -> Vec<Option<String>> {
        let layout = Layout::of(paths.iter().copied());
        paths.iter().map(|path| layout.place(path)).collect()
    }

    #[test]
    fn checkouts_wheels_and_archives_have_the_same_virtual_paths() {
        for prefix in ["", "robohive/", "robohive-main/robohive/", "a/b/c/"] {
            let paths = ["envs/arms/reach.xml", "envs/myo/assets/elbow.xml", "simhive/Adroit/hand.xml"];
            let paths = paths.map(|path| format!("{prefix}{path}"));
            let found = places(&[&paths[0], &paths[1], &paths[2], "setup.xml", "docs/envs/a.png"]);
            let virtual_path = |path: &String| Some(path[prefix.len()..].to_owned());
            assert_eq!(found[..3], [&paths[0], &paths[1], &paths[2]].map(virtual_path), "{prefix}");
            assert_eq!(found[3..], [None, None]);
        }
    }

    #[test]
    fn a_simhive_without_its_name_is_known_by_its_folders() {
        let found = places(&["Adroit/LICENSE", "models/myo_sim/elbow/elbow.xml", "README.xml"]);
        let path = |path: &str| Some(path.to_owned());
        assert_eq!(found, [path("simhive/Adroit/LICENSE"), path("simhive/myo_sim/elbow/elbow.xml"), None]);
    }

    #[test]
    fn myosuite_gives_its_simhive_alone() {
        let found = places(&["myosuite/envs/myo/assets/elbow.xml", "myosuite/simhive/myo_sim/elbow.xml"]);
        assert_eq!(found, [None, Some("simhive/myo_sim/elbow.xml".to_owned())]);
        // No suite, but files of that name.
        assert_eq!(places(&["envs/hands", "envs/arms.xml"]), [None, None]);
    }

    #[test]
    fn code_and_caches_are_not_kept() {
        for path in ["a/b.XML", "a.stl", "motion.npz", "x.config", "LICENSE", "COPYING.txt", "License.md"] {
            assert!(is_kept(path), "{path}");
        }
        for path in
            ["a.py", "a.pyc", "a.pkl", ".git/a.xml", "a/__pycache__/b.npz", "xml", "LICENSE.py", ".xml.swp"]
        {
            assert!(!is_kept(path), "{path}");
        }
        let kinds = ["a.PY", "a/.git/x.xml", "Makefile", ".gitignore"].map(skipped_kind);
        assert_eq!(kinds, [".py", "in .git/", "without extension", "without extension"]);
    }
}
