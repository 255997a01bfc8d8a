//! Decorations: what MuJoCo draws beside the elements that have a shape of their own.

mod actuator;
mod body;
mod camera;
mod contact;
mod force;
mod frame;
mod joint;
mod light;
mod ray;
mod tree;

use super::item::Category;
use super::sink::{Items, Source};

/// Adds the decorations that are asked for, in MuJoCo's order.
pub(super) fn decorations(from: Source<'_>, items: &mut Items<'_>) {
    if !from.shows(Category::Decor) {
        return;
    }
    frame::of_geoms_and_sites(from, items);
    tree::of_bodies(from, items);
    tree::of_flexes(from, items);
    tree::of_meshes(from, items);
    body::inertias(from, items);
    body::pull(from, items);
    frame::of_bodies(from, items);
    body::selected_point(from, items);
    body::labels(from, items);
    joint::joints(from, items);
    actuator::actuators(from, items);
    body::island_labels(from, items);
    camera::cameras(from, items);
    light::lights(from, items);
    body::centers_of_mass(from, items);
    body::connections(from, items);
    ray::rays(from, items);
    force::applied(from, items);
    force::constraints(from, items);
    contact::contacts(from, items);
}
