//! Decorations of bodies: inertias, centres of mass, connections, the selected body and labels.

use crate::scene::item::{Item, Shape};
use crate::scene::options::{LabelChoice, Pull, Selection};
use crate::scene::sink::{Form, Items, Source, UPRIGHT, element, unnamed};
use physics::math::{Vec3, add, mul_mat_vec, ops, quat_to_mat, scale};
use physics::model::ObjType;
use physics::model::bounds::MINVAL;
use std::f64::consts::PI;

/// Density of water \[kg/m³\].
const WATER: f64 = 1000.0;

/// Half sizes of the box or ellipsoid of the same mass and inertia as a body.
fn equivalent(from: Source<'_>, body: usize) -> Vec3 {
    let (mass, [x, y, z]) = (from.m.body_mass[body], from.m.body_inertia[body]);
    let ellipsoid = is_ellipsoid(from);
    let (ratio, volume) = if ellipsoid { (5.0, 4.0 / 3.0 * PI) } else { (3.0, 8.0) };
    let half =
        [y + z - x, x + z - y, x + y - z].map(|twice| ops::sqrt(twice / (2.0 * mass)) * ops::sqrt(ratio));
    if !from.options.show.scaled_inertias {
        return half;
    }
    let density = mass / (volume * half[0] * half[1] * half[2]).max(MINVAL);
    scale(half, ops::pow(density / WATER, 1.0 / 3.0))
}

fn is_ellipsoid(from: Source<'_>) -> bool {
    from.m.vis.global.ellipsoidinertia == 1
}

/// Adds the equivalent inertias of bodies with mass.
pub(super) fn inertias(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.inertias {
        return;
    }
    let shape = if is_ellipsoid(from) { Shape::Sphere } else { Shape::Box };
    for i in (1..m.nbody).filter(|&i| m.body_mass[i] > MINVAL && from.shows_body(i as i32)) {
        let form = Form { shape, size: equivalent(from, i), pos: d.kin.xipos[i], mat: d.kin.ximat[i] };
        let item = items.decor(&form, m.vis.rgba.inertia, element(ObjType::Body, i));
        item.look.emission += from.glow(i as i32);
        if is_labelled(from, i) {
            item.label = from.label(ObjType::Body, i);
        }
    }
}

/// True when a body gets a label.
fn is_labelled(from: Source<'_>, body: usize) -> bool {
    match from.options.label {
        LabelChoice::Body => true,
        LabelChoice::Selection => from.selection().is_some_and(|s| s.body == body),
        _ => false,
    }
}

/// An item that is nothing but its label.
fn bare_label<'i>(items: &'i mut Items<'_>, body: usize, pos: Vec3, mat: &[f64; 9]) -> &'i mut Item {
    let form = Form { shape: Shape::Label, size: [0.1; 3], pos, mat: *mat };
    items.decor(&form, [0.5, 0.5, 0.5, 1.0], unnamed(body))
}

/// Adds labels of bodies where inertias do not carry them.
pub(super) fn labels(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if options.show.inertias {
        return;
    }
    for i in (1..m.nbody).filter(|&i| is_labelled(from, i) && from.shows_body(i as i32)) {
        bare_label(items, i, d.kin.xpos[i], &d.kin.xmat[i]).label = from.label(ObjType::Body, i);
    }
}

/// Adds numbers of constraint islands at the bodies in them.
pub(super) fn island_labels(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if options.label != LabelChoice::Island {
        return;
    }
    for i in 1..m.nbody {
        let weld = m.body_weldid[i] as usize;
        let dof = usize::try_from(m.body_dofadr[weld]).ok().filter(|_| m.body_dofnum[weld] > 0);
        if let Some(island) = dof.and_then(|dof| from.island_of_dof(dof)) {
            bare_label(items, i, d.kin.xipos[i], &d.kin.ximat[i]).label = island.to_string();
        }
    }
}

/// Adds the centre of mass of every kinematic tree.
pub(super) fn centers_of_mass(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.centers_of_mass {
        return;
    }
    for i in (1..m.nbody).filter(|&i| m.body_rootid[i] == i as i32) {
        let form = Form::ball(from.size(m.vis.scale.com), d.com.subtree_com[i], &UPRIGHT);
        items.decor(&form, m.vis.rgba.com, unnamed(i));
    }
}

/// Adds capsules from the centre of mass of each body through its joints, the last first, to its parent's.
pub(super) fn connections(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.connections {
        return;
    }
    let width = from.size(m.vis.scale.connect);
    for i in (1..m.nbody).filter(|&i| m.body_parentid[i] != 0) {
        let first = m.body_jntadr[i].max(0) as usize;
        let joints = (first..first + m.body_jntnum[i] as usize).rev().map(|j| d.kin.xanchor[j]);
        let mut start = d.kin.xipos[i];
        for end in joints.chain([d.kin.xipos[m.body_parentid[i] as usize]]) {
            let form = Form::connector(Shape::Capsule, width, start, end);
            items.decor(&form, m.vis.rgba.connect, unnamed(i));
            start = end;
        }
    }
}

impl Source<'_> {
    /// The selected body, where it is one of the model and not the world.
    fn selection(&self) -> Option<&Selection> {
        self.options.selection.as_ref().filter(|s| (1..self.m.nbody).contains(&s.body))
    }

    /// The selected point, world frame \[m\].
    fn selected(&self, selection: &Selection) -> Vec3 {
        let kin = &self.d.kin;
        add(mul_mat_vec(&kin.xmat[selection.body], selection.point), kin.xpos[selection.body])
    }
}

/// Colour of a pull by either hand: red and green change places for the second.
fn pull_color(rgba: [f32; 4], first: bool, second: bool) -> [f32; 4] {
    let [r, g, b, a] = rgba;
    match (first, second) {
        (true, true) => [r.max(g), g.max(r), b, a],
        (true, false) => rgba,
        (false, true) => [g.max(0.0), r.max(0.0), b, a],
        (false, false) => [0.0, 0.0, b, a],
    }
}

/// Adds what the selected body is pulled to: a spring to a ball, and its box in the wanted orientation.
pub(super) fn pull(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    let Some(s) = from.selection().filter(|_| options.show.perturbation) else { return };
    let (object, target) = (unnamed(s.body), quat_to_mat(s.orientation));
    let active =
        |hand: fn(&Pull) -> bool| Some([hand(&s.pull), hand(&s.second_pull)]).filter(|on| on[0] || on[1]);
    if let Some([first, second]) = active(|pull| pull.translation) {
        let rgba = pull_color(m.vis.rgba.constraint, first, second);
        let width = from.size(m.vis.scale.constraint);
        items.decor(&Form::connector(Shape::Capsule, width, from.selected(s), s.target), rgba, object);
        items.decor(&Form::ball(2.0 * width, s.target, &target), rgba, object);
    }
    if let Some([first, second]) = active(|pull| pull.rotation) {
        let rgba = pull_color(m.vis.rgba.inertia, first, second);
        let (mut offset, mut size) = ([0.0; 3], [m.stat.meansize; 3]);
        if m.body_bvhnum[s.body] > 0 {
            let [x, y, z, a, b, c] = m.bvh_aabb[m.body_bvhadr[s.body] as usize];
            (offset, size) = (mul_mat_vec(&d.kin.ximat[s.body], [x, y, z]), [a, b, c]);
        }
        let pos = add(offset, d.kin.xipos[s.body]);
        items.decor(&Form { shape: Shape::LineBox, size, pos, mat: target }, rgba, object);
    }
}

/// Adds the selected point.
pub(super) fn selected_point(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, options, .. } = from;
    let Some(s) = from.selection().filter(|_| options.show.selected_point) else { return };
    let pos = from.selected(s);
    let form = Form::ball(from.size(m.vis.scale.selectpoint), pos, &UPRIGHT);
    let item = items.decor(&form, m.vis.rgba.selectpoint, unnamed(s.body));
    if options.label == LabelChoice::SelectedPoint {
        let ([x, y, z], [a, b, c]) = (pos, s.point);
        item.label = format!("{x:.3} {y:.3} {z:.3} (local {a:.3} {b:.3} {c:.3})");
    }
}
