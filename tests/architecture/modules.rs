//! Which module of a crate needs which, and whether any two need each other.
//!
//! An arrow goes from the file that writes a path to the file that defines what the path names. Re-exports are no arrows
//! of the file they stand in, and a name taken through one counts as taken from the file behind it. Code under `cfg(test)`
//! does not count; paths that macros are given do.

use super::tree::sources;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use syn::visit::Visit;

/// A path, or the place of a module in its crate: names from the outside in.
type Path = Vec<String>;

/// Modules, each with those it needs.
type Arrows = BTreeMap<Path, BTreeSet<Path>>;

/// More re-exports of re-exports than this are taken for a loop.
const RE_EXPORTS: usize = 16;

/// What a file says of other modules.
#[derive(Default)]
pub struct Paths {
    /// Paths that its code uses, those in private `use` spelt out.
    pub used: Vec<Path>,
    /// Names that it re-exports, each with its path.
    re_exported: BTreeMap<String, Path>,
    /// Modules whose items it re-exports all.
    globs: Vec<Path>,
    /// How many modules of the file itself are around what is read.
    depth: usize,
}

impl Paths {
    /// The paths of a file.
    pub fn of(file: &syn::File) -> Self {
        let mut paths = Paths::default();
        paths.visit_file(file);
        paths
    }

    /// Notes a path that is used. In a module of the file itself `super` leads to the file.
    fn note(&mut self, path: Path) {
        let inner = path.iter().take(self.depth).take_while(|name| *name == "super").count();
        let file = (inner > 0).then(|| "self".to_owned());
        self.used.push(file.into_iter().chain(path.into_iter().skip(inner)).collect());
    }

    fn import(&mut self, public: bool, before: &Path, tree: &syn::UseTree) {
        let with = |name: &syn::Ident| before.iter().cloned().chain([name.to_string()]).collect::<Path>();
        let mut name = |name: &syn::Ident, path: Path| match public {
            true => _ = self.re_exported.insert(name.to_string(), path),
            false => self.note(path),
        };
        match tree {
            syn::UseTree::Path(path) => self.import(public, &with(&path.ident), &path.tree),
            syn::UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.import(public, before, tree));
            }
            syn::UseTree::Name(leaf) => name(&leaf.ident, with(&leaf.ident)),
            syn::UseTree::Rename(leaf) => name(&leaf.rename, with(&leaf.ident)),
            syn::UseTree::Glob(_) if public => self.globs.push(before.clone()),
            syn::UseTree::Glob(_) => self.note(before.clone()),
        }
    }
}

impl<'a> Visit<'a> for Paths {
    fn visit_item_use(&mut self, item: &'a syn::ItemUse) {
        let public = !matches!(item.vis, syn::Visibility::Inherited);
        self.import(public, &Vec::new(), &item.tree);
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        // A single name is a local one, or the `crate` of a visibility.
        if path.segments.len() > 1 {
            self.note(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        syn::visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'a syn::Macro) {
        let text: String = call.tokens.to_string().split_whitespace().collect();
        for (start, _) in text.match_indices("crate::").chain(text.match_indices("super::")) {
            let rest = &text[start..];
            let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
            let path = rest[..end.unwrap_or(rest.len())].split("::").filter(|name| !name.is_empty());
            self.note(path.map(str::to_owned).collect());
        }
        syn::visit::visit_macro(self, call);
    }

    fn visit_item_mod(&mut self, module: &'a syn::ItemMod) {
        let is_test = |attribute: &syn::Attribute| {
            attribute.path().is_ident("cfg")
                && matches!(&attribute.meta, syn::Meta::List(list) if list.tokens.to_string() == "test")
        };
        if !module.attrs.iter().any(is_test) {
            self.depth += 1;
            syn::visit::visit_item_mod(self, module);
            self.depth -= 1;
        }
    }
}

/// The modules of one crate.
struct Modules(BTreeMap<Path, Paths>);

impl Modules {
    /// The modules of the crate in `folder`, but for its tests, examples and build script.
    fn of(folder: &str) -> Self {
        let library = sources(folder).into_iter().filter(|file| {
            let inside = file.path.strip_prefix(folder).unwrap();
            !["/tests/", "/examples/", "/build.rs"].iter().any(|part| inside.starts_with(part))
        });
        Modules(library.map(|file| (place(folder, &file.path), Paths::of(&file.syntax()))).collect())
    }

    /// The module that defines what `path` names in module `from`; none where it leads out of the crate.
    fn resolve(&self, from: &[String], path: &[String], re_exports: usize) -> Option<Path> {
        let (mut place, mut rest) = (from.to_vec(), path);
        match path.first()?.as_str() {
            "crate" => (place, rest) = (Vec::new(), &path[1..]),
            "self" => rest = &path[1..],
            "super" => {}
            _ if self.0.contains_key(&[from, &path[..1]].concat()) => {}
            _ => return None,
        }
        while let [first, after @ ..] = rest
            && first == "super"
        {
            place.pop();
            rest = after;
        }
        while let [name, after @ ..] = rest {
            place.push(name.clone());
            if !self.0.contains_key(&place) {
                place.pop();
                return Some(self.behind(&place, rest, re_exports).unwrap_or(place));
            }
            rest = after;
        }
        Some(place)
    }

    /// The module behind a re-export: `path` begins with a name that `place` re-exports, by name or with all others.
    fn behind(&self, place: &Path, path: &[String], re_exports: usize) -> Option<Path> {
        let left = re_exports.checked_sub(1)?;
        let paths = self.0.get(place)?;
        if let Some(target) = paths.re_exported.get(&path[0]) {
            return self.resolve(place, &[target, &path[1..]].concat(), left);
        }
        let globs = paths.globs.iter().filter_map(|glob| self.resolve(place, glob, left));
        globs.filter(|to| to != place).find_map(|to| self.behind(&to, path, left))
    }

    fn arrows(&self) -> Arrows {
        let needs = |from: &Path, paths: &Paths| -> BTreeSet<Path> {
            let found = paths.used.iter().filter_map(|path| self.resolve(from, path, RE_EXPORTS));
            found.filter(|to| to != from).collect()
        };
        self.0.iter().map(|(from, paths)| (from.clone(), needs(from, paths))).collect()
    }
}

/// The place of the module in the file `path` of the crate in `folder`.
fn place(folder: &str, path: &str) -> Path {
    let inside = path.strip_prefix(folder).unwrap().trim_start_matches('/').trim_end_matches(".rs");
    let place: Path = inside.split('/').map(str::to_owned).collect();
    match place.last().map(String::as_str) {
        Some("lib" | "main") if place.len() == 1 => Vec::new(),
        Some("mod") => place[..place.len() - 1].to_vec(),
        _ => place,
    }
}

/// Everything in the crate in `folder` that needs itself: files that need each other, and parts that do. A part is a module
/// with all that is below it; those beside each other are compared.
pub fn circles(folder: &str) -> Vec<String> {
    let arrows = Modules::of(folder).arrows();
    assert!(
        arrows.len() < 3 || arrows.values().any(|to| !to.is_empty()),
        "no module of {folder} needs another"
    );
    let named = |kind: &str, circle: BTreeSet<Path>| {
        let names: Vec<_> = circle.iter().map(|place| place.join("::")).collect();
        format!("{folder}: {kind}: {}", names.join(", "))
    };
    let files = tangled(&arrows).into_iter().map(|circle| named("files", circle));
    let levels: BTreeSet<&[String]> =
        arrows.keys().filter_map(|place| place.split_last()).map(|(_, above)| above).collect();
    let parts = levels.into_iter().flat_map(|level| tangled(&among(level, &arrows)));
    files.chain(parts.map(|circle| named("parts", circle))).collect()
}

/// The arrows between the parts directly below `level`.
fn among(level: &[String], arrows: &Arrows) -> Arrows {
    let part = |place: &Path| -> Option<Path> {
        (place.len() > level.len() && place.starts_with(level)).then(|| place[..=level.len()].to_vec())
    };
    let mut between = Arrows::new();
    for (from, to) in arrows {
        if let Some(from) = part(from) {
            let others = to.iter().filter_map(part).filter(|to| *to != from).collect::<Vec<_>>();
            between.entry(from).or_default().extend(others);
        }
    }
    between
}

/// Sets of modules that need each other, directly or through others.
fn tangled(arrows: &Arrows) -> BTreeSet<BTreeSet<Path>> {
    let reached: BTreeMap<&Path, BTreeSet<&Path>> =
        arrows.keys().map(|from| (from, reach(arrows, from))).collect();
    let circle = |from: &Path| -> BTreeSet<Path> {
        let back = reached[from].iter().filter(|to| reached[**to].contains(from));
        back.map(|&to| to.clone()).chain([from.clone()]).collect()
    };
    reached.keys().map(|from| circle(from)).filter(|circle| circle.len() > 1).collect()
}

/// Every module that `from` needs, by itself or through others.
fn reach<'a>(arrows: &'a Arrows, from: &'a Path) -> BTreeSet<&'a Path> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(place) = open.pop() {
        open.extend(arrows[place].iter().filter(|to| found.insert(*to)));
    }
    found
}

fn path(text: impl Display) -> Path {
    text.to_string().split("::").map(str::to_owned).collect()
}

#[test]
fn paths_are_found() {
    let file = syn::parse_file(
        "use crate::a::{B, c::D as E};\npub use crate::h::I;\nfn f() { super::g::h(); print!(crate::m::N); }\n\
         mod inner { use super::j::K; use super::super::l::L; }\n#[cfg(test)]\nmod tests { use crate::z::Y; }",
    )
    .unwrap();
    let found = Paths::of(&file);
    let used: Vec<_> = found.used.iter().map(|path| path.join("::")).collect();
    assert_eq!(
        used,
        ["crate::a::B", "crate::a::c::D", "super::g::h", "crate::m::N", "self::j::K", "self::super::l::L"]
    );
    assert_eq!(found.re_exported, BTreeMap::from([("I".into(), path("crate::h::I"))]));
}

/// Modules by place, each with its text.
fn modules(texts: &[(&str, &str)]) -> Modules {
    let place = |name: &str| if name.is_empty() { Vec::new() } else { path(name) };
    let read = |text: &str| Paths::of(&syn::parse_file(text).unwrap());
    Modules(texts.iter().map(|(name, text)| (place(name), read(text))).collect())
}

#[test]
fn paths_lead_to_the_file_that_defines_what_they_name() {
    let found = modules(&[("", ""), ("a", "pub use c::D;\npub use self::c::deep::*;"), ("a::c", "")]);
    let mut found = found;
    found.0.insert(
        path("a::c::deep"),
        Paths::of(&syn::parse_file("pub use super::super::super::g::H;").unwrap()),
    );
    found.0.insert(path("g"), Paths::default());
    let resolve = |from: &str, to: &str| found.resolve(&path(from), &path(to), RE_EXPORTS);
    assert_eq!(resolve("a::c", "super::super::g::h"), Some(path("g")));
    assert_eq!(resolve("g", "crate::a::c::D"), Some(path("a::c")));
    assert_eq!(resolve("g", "crate::a::D"), Some(path("a::c")));
    assert_eq!(resolve("g", "crate::a::H"), Some(path("g")));
    assert_eq!(resolve("g", "crate::a::own"), Some(path("a")));
    assert_eq!(resolve("a", "c::D"), Some(path("a::c")));
    assert_eq!(resolve("a", "std::fs::read"), None);
}

#[test]
fn circles_of_files_and_of_parts_are_found() {
    let found = modules(&[
        ("", ""),
        ("a", ""),
        ("a::one", "use crate::b::one;"),
        ("a::two", ""),
        ("b", ""),
        ("b::one", ""),
        ("b::two", "use crate::a::two;"),
        ("c", "use self::below::f;"),
        ("c::below", "use super::Own;"),
    ]);
    let arrows = found.arrows();
    assert_eq!(tangled(&arrows), BTreeSet::from([BTreeSet::from([path("c"), path("c::below")])]));
    assert_eq!(tangled(&among(&[], &arrows)), BTreeSet::from([BTreeSet::from([path("a"), path("b")])]));
}
