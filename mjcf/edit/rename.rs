//! Another name for an element, wherever it is named.

use physics::model::ObjType;

use super::find::{missing, word};
use super::refuse;
use super::spaces::by_space;
use crate::diagnostic::Diagnostics;
use crate::schema::Space;
use crate::spec::{Body, Spec, asset_name};

impl Spec {
    /// Gives the element called `old` the name `new`, and changes every reference to it.
    ///
    /// # Errors
    /// There is no such element; another has the new name; the new name is empty; the world is renamed.
    pub fn rename(&mut self, kind: ObjType, old: &str, new: &str) -> Result<(), Diagnostics> {
        let Some(space) = Space::of(kind) else {
            return refuse(format!("elements of kind {kind:?} have no names"));
        };
        let names = self.all_names();
        let what = word(kind);
        if !names.contains(&(space, old.to_owned())) {
            let known = names.iter().filter(|(s, _)| *s == space).map(|(_, name)| name.as_str());
            return Err(missing(kind, old, known));
        }
        if new.is_empty() || (space == Space::Body && old == self.world.name) {
            return refuse(format!("the {what} '{old}' cannot be called '{new}'"));
        }
        if names.contains(&(space, new.to_owned())) {
            return refuse(format!("there is a {what} '{new}' already"));
        }
        self.each_name(space, &mut |name| {
            if name == old {
                new.clone_into(name);
            }
        });
        self.each_reference(&mut |of, name| {
            if of == space && name == old {
                new.clone_into(name);
            }
        });
        Ok(())
    }

    /// Calls `visit` for the own name of every element of a space.
    fn each_name(&mut self, space: Space, visit: &mut dyn FnMut(&mut String)) {
        macro_rules! list {
            ($list:ident) => {
                self.$list.iter_mut().for_each(|x| visit(&mut x.name))
            };
        }
        macro_rules! assets {
            ($list:ident) => {
                for asset in &mut self.$list {
                    // What is called by its file gets a name of its own when that changes.
                    let mut name = asset_name(&asset.name, &asset.path);
                    let called = name.clone();
                    visit(&mut name);
                    if name != called {
                        asset.name = name;
                    }
                }
            };
        }
        macro_rules! held {
            ($list:ident) => {
                each_body(&mut self.world, &mut |b| b.$list.iter_mut().for_each(|x| visit(&mut x.name)))
            };
        }
        by_space!(space, bodies held, assets assets, lists list, {
            Space::Body => each_body(&mut self.world, &mut |body| visit(&mut body.name)),
            Space::Frame => list!(frames),
            Space::Key => {
                list!(keys);
                list!(kept_keys);
            }
            // Classes are found by `Spec::classes`.
            Space::Class => {}
        });
    }
}

/// Calls `visit` for `body` and all below it.
pub(super) fn each_body(body: &mut Body, visit: &mut dyn FnMut(&mut Body)) {
    visit(body);
    body.bodies.iter_mut().for_each(|child| each_body(child, visit));
}
