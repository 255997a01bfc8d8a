//! Which module of a crate needs which.

use super::tree::sources;
use std::collections::{BTreeMap, BTreeSet};
use syn::visit::Visit;

/// A path, or the place of a module in its crate: names from the outside in.
type Path = Vec<String>;

/// All paths of a file, those in `use` spelt out; tests and what macros are given apart.
pub fn paths(file: &syn::File) -> Vec<Path> {
    let mut collector = Collector(Vec::new());
    collector.visit_file(file);
    collector.0
}

struct Collector(Vec<Path>);

impl Collector {
    fn spell_out(&mut self, before: &Path, tree: &syn::UseTree) {
        let with = |name: &syn::Ident| before.iter().cloned().chain([name.to_string()]).collect::<Path>();
        match tree {
            syn::UseTree::Path(path) => self.spell_out(&with(&path.ident), &path.tree),
            syn::UseTree::Group(group) => group.items.iter().for_each(|tree| self.spell_out(before, tree)),
            syn::UseTree::Name(name) => self.0.push(with(&name.ident)),
            syn::UseTree::Rename(name) => self.0.push(with(&name.ident)),
            syn::UseTree::Glob(_) => self.0.push(before.clone()),
        }
    }
}

impl<'a> Visit<'a> for Collector {
    fn visit_item_use(&mut self, item: &'a syn::ItemUse) {
        self.spell_out(&Vec::new(), &item.tree);
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        // A single name is a local one, or the `crate` of a visibility.
        if path.segments.len() > 1 {
            self.0.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        syn::visit::visit_path(self, path);
    }

    fn visit_item_mod(&mut self, module: &'a syn::ItemMod) {
        let is_test = |attribute: &syn::Attribute| {
            attribute.path().is_ident("cfg")
                && matches!(&attribute.meta, syn::Meta::List(list) if list.tokens.to_string() == "test")
        };
        if !module.attrs.iter().any(is_test) {
            syn::visit::visit_item_mod(self, module);
        }
    }
}

/// The module that `path` leads to from module `from`; none where it leads out of the crate.
fn resolve(modules: &BTreeMap<Path, Vec<Path>>, from: &Path, path: &[String]) -> Option<Path> {
    let (mut place, mut rest) = (from.clone(), path);
    match path.first()?.as_str() {
        "crate" => (place, rest) = (Vec::new(), &path[1..]),
        "self" => rest = &path[1..],
        "super" => {
            while let [first, after @ ..] = rest
                && first == "super"
            {
                place.pop();
                rest = after;
            }
        }
        _ if modules.contains_key(&[from.as_slice(), &path[..1]].concat()) => {}
        _ => return None,
    }
    while let [name, after @ ..] = rest {
        place.push(name.clone());
        if !modules.contains_key(&place) {
            place.pop();
            break;
        }
        rest = after;
    }
    Some(place)
}

/// Sets of modules of the crate in `folder` that need each other, by the paths in them.
pub fn circles(folder: &str) -> Vec<Vec<String>> {
    let inside = |path: &str| {
        let path =
            path.strip_prefix(folder).unwrap().trim_start_matches('/').trim_end_matches(".rs").to_owned();
        let place: Path = path.split('/').map(str::to_owned).collect();
        match place.last().map(String::as_str) {
            Some("lib" | "main") if place.len() == 1 => Vec::new(),
            Some("mod") => place[..place.len() - 1].to_vec(),
            _ => place,
        }
    };
    let library = sources(folder).into_iter().filter(|file| {
        !file.path.contains("/tests/")
            && !file.path.contains("/examples/")
            && !file.path.ends_with("/build.rs")
    });
    let modules: BTreeMap<Path, Vec<Path>> =
        library.map(|file| (inside(&file.path), paths(&file.syntax()))).collect();
    // A module belongs to those around it, whatever it takes from them.
    let others = |from: &Path, paths: &[Path]| -> BTreeSet<Path> {
        let found = paths.iter().filter_map(|path| resolve(&modules, from, path));
        found.filter(|to| !from.starts_with(to)).collect()
    };
    let needs: BTreeMap<&Path, BTreeSet<Path>> =
        modules.iter().map(|(from, paths)| (from, others(from, paths))).collect();
    let reached: BTreeMap<&Path, BTreeSet<Path>> =
        needs.keys().map(|&from| (from, reach(&needs, from))).collect();
    let circle = |from: &Path| -> Vec<String> {
        let back = reached[from].iter().filter(|to| *to != from && reached[*to].contains(from));
        back.chain([from]).map(|place| place.join("::")).collect::<BTreeSet<_>>().into_iter().collect()
    };
    let found: BTreeSet<_> =
        reached.keys().map(|from| circle(from)).filter(|circle| circle.len() > 1).collect();
    assert!(
        modules.len() < 3 || needs.values().any(|needed| !needed.is_empty()),
        "no module of {folder} needs another"
    );
    found.into_iter().collect()
}

/// Every module that `from` needs, by itself or through others.
fn reach(needs: &BTreeMap<&Path, BTreeSet<Path>>, from: &Path) -> BTreeSet<Path> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from.clone()]);
    while let Some(place) = open.pop() {
        open.extend(needs[&place].iter().filter(|to| found.insert((*to).clone())).cloned());
    }
    found
}

#[test]
fn paths_are_found_and_resolved() {
    let file = syn::parse_file("use crate::a::{B, c::D as E};\nfn f() { super::g::h(); }\n#[cfg(test)]\nmod tests { use crate::z::Y; }").unwrap();
    let found: Vec<_> = paths(&file).iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["crate::a::B", "crate::a::c::D", "super::g::h"]);
    let place = |text: &str| -> Path { text.split("::").map(str::to_owned).collect() };
    let modules: BTreeMap<Path, Vec<Path>> = [vec![], place("a"), place("a::c"), place("g")]
        .into_iter()
        .map(|module| (module, Vec::new()))
        .collect();
    assert_eq!(resolve(&modules, &place("a::c"), &place("super::super::g::h")), Some(place("g")));
    assert_eq!(resolve(&modules, &place("g"), &place("crate::a::c::D")), Some(place("a::c")));
    assert_eq!(resolve(&modules, &place("a"), &place("c::D")), Some(place("a::c")));
    assert_eq!(resolve(&modules, &place("a"), &place("std::fs::read")), None);
}
