//! Contacts of flexes: of their elements with geoms and with elements of other flexes and their own, of their vertices
//! with planes, and within them (MuJoCo documentation, Computation, "Deformable objects", collisions).
//!
//! Elements that may touch come from trees of boxes (`tree.rs`) or from a sweep (`sweep.rs`); `element.rs` and
//! `triangle.rs` find the points of contact, `internal.rs` those between neighbours; `thin.rs` keeps the number of
//! contacts of two bodies or flexes within bounds.

mod element;
mod internal;
mod tree;
mod triangle;
mod world;

pub use world::World;

use super::mixing::{Mixture, Parts, Surface};
use super::scratch::CollisionScratch;
use super::shape::PreContact;
use super::{sdf, thin};
use crate::collision::broad_phase::geoms;
use crate::math::{add_scaled, column, dot, sub};
use crate::model::flex::Flex;
use crate::model::{FlexSelf, GeomType};
use crate::sleep::{Awake, object};
use crate::stages::Contacts;
use world::{geom_matches, geom_reach, is_of_type};

/// Contacts of the geoms of a body with a flex.
pub(super) fn body_flex(
    at: World,
    body: usize,
    f: usize,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) {
    let m = at.m;
    if at.middle_phase() && m.body_bvhadr[body] >= 0 && m.flex_bvhadr[f] >= 0 {
        let before = con.contact.len();
        if m.body_dofnum[m.body_weldid[body] as usize] == 0 {
            for g in geoms(m, body).filter(|&g| is_of_type(m, g, GeomType::Plane)) {
                plane(at, g, f, con);
            }
        }
        for g in geoms(m, body).filter(|&g| is_of_type(m, g, GeomType::Sdf)) {
            field(at, g, f, scratch, con);
        }
        tree::body_flex(at, body, f, scratch, con);
        thin::keep_spread(&mut con.contact, before, &mut scratch.spread);
        thin::sort(&mut con.contact[before..]);
        return;
    }
    for g in geoms(m, body).filter(|&g| geom_matches(m, g, f)) {
        let before = con.contact.len();
        if is_of_type(m, g, GeomType::Plane) {
            plane(at, g, f, con);
        } else if is_of_type(m, g, GeomType::Sdf) {
            field(at, g, f, scratch, con);
        } else {
            for e in 0..at.flex(f).elements().len() {
                if !scratch.has_room(con) {
                    return;
                }
                element::with_geom(at, g, f, e, scratch, con);
            }
        }
        thin::keep_spread(&mut con.contact, before, &mut scratch.spread);
    }
}

/// Contacts of a signed distance geom with a sheet; lines and solids pass through it.
fn field(at: World, g: usize, f: usize, scratch: &mut CollisionScratch, con: &mut Contacts) {
    let (m, flex) = (at.m, at.flex(f));
    if flex.dim() != 2 {
        return;
    }
    let tree = (m.flex_bvhadr[f] >= 0).then(|| tree::tree_of(at, f));
    let sheet = sdf::Sheet { elements: flex.corners(), points: at.points(f), tree };
    let CollisionScratch { points, convex, .. } = scratch;
    points.clear();
    sdf::sheet_and_field(m, at.kin, g, sheet, &mut convex.field, points);
    let mixture = Mixture::of_flex(m, [Surface::geom(m, g), Surface::flex(m, f)], geom_reach(m, g, f)[0]);
    for (&e, point) in convex.field.elements.iter().zip(&*points) {
        let parts = Parts { geom: [g as i32, -1], flex: [-1, f as i32], elem: [-1, e as i32], ..Parts::NONE };
        con.contact.push(mixture.of_parts(parts, point));
    }
}

/// Contacts of the elements of two flexes.
pub(super) fn two_flexes(at: World, pair: [usize; 2], scratch: &mut CollisionScratch, con: &mut Contacts) {
    let before = con.contact.len();
    if at.middle_phase() && pair.iter().all(|&f| at.m.flex_bvhadr[f] >= 0) {
        tree::two_flexes(at, pair, scratch, con);
        thin::keep_spread(&mut con.contact, before, &mut scratch.spread);
        thin::sort(&mut con.contact[before..]);
        return;
    }
    let [n1, n2] = pair.map(|f| at.flex(f).elements().len());
    for e1 in 0..n1 {
        if !scratch.has_room(con) {
            return;
        }
        (0..n2).for_each(|e2| element::with_element(at, pair, [e1, e2], scratch, con));
    }
    thin::keep_spread(&mut con.contact, before, &mut scratch.spread);
}

/// Contacts of each flex with itself.
pub(super) fn self_contacts(at: World, awake: Awake, scratch: &mut CollisionScratch, con: &mut Contacts) {
    let m = at.m;
    let collides = |f: &usize| !m.flex_rigid[*f] && m.flex_contype[*f] & m.flex_conaffinity[*f] != 0;
    let sleeps = |f: usize| awake.skips(|state| object::flex(m, state, f));
    for f in (0..m.nflex).filter(collides).filter(|&f| !sleeps(f)) {
        if m.flex_internal[f] {
            let before = con.contact.len();
            internal::neighbours(at, f, scratch, con);
            thin::keep_spread(&mut con.contact, before, &mut scratch.spread);
        }
        let mode = FlexSelf::from_code(m.flex_selfcollide[f]).unwrap_or(FlexSelf::None);
        if mode != FlexSelf::None {
            let before = con.contact.len();
            own_elements(at, f, mode, scratch, con);
            thin::keep_spread(&mut con.contact, before, &mut scratch.spread);
        }
    }
}

fn own_elements(at: World, f: usize, mode: FlexSelf, scratch: &mut CollisionScratch, con: &mut Contacts) {
    let (m, flex) = (at.m, at.flex(f));
    if at.middle_phase() && mode != FlexSelf::Narrow && m.flex_bvhadr[f] >= 0 {
        if mode == FlexSelf::Bvh || mode == FlexSelf::Auto && flex.dim() == 3 {
            tree::two_flexes(at, [f, f], scratch, con);
        } else {
            sweep_elements(at, f, scratch, con);
        }
        return;
    }
    let count = flex.elements().len();
    for e1 in (0..count).filter(|&e| is_active(flex, e)) {
        if !scratch.has_room(con) {
            return;
        }
        for e2 in (e1 + 1..count).filter(|&e| is_active(flex, e)) {
            element::with_element(at, [f, f], [e1, e2], scratch, con);
        }
    }
}

/// Contacts between elements of a flex that a sweep finds.
fn sweep_elements(at: World, f: usize, scratch: &mut CollisionScratch, con: &mut Contacts) {
    let flex = at.flex(f);
    let mut sweep = std::mem::take(&mut scratch.sweep);
    sweep.elements.clear();
    sweep.elements.extend((0..flex.elements().len()).filter(|&e| is_active(flex, e)).map(|e| e as u32));
    let (corners, bodies) = (flex.corners(), flex.vertex_bodies());
    sweep.bodies.clear();
    sweep.bodies.extend(corners.chunks_exact(flex.dim() + 1).map(|corners| {
        let body = |k: usize| bodies[corners[k % corners.len()] as usize];
        [body(0), body(1), body(2), body(3)]
    }));
    let root = &at.flexes.bvh_aabb_dyn[at.m.flex_bvhadr[f] as usize - at.m.nbvhstatic];
    sweep.find_pairs(at.boxes(f), longest_axis(root));
    for pair in &sweep.pairs {
        if !scratch.has_room(con) {
            break;
        }
        element::with_other_element(at, [f, f], pair.map(|e| e as usize), scratch, con);
    }
    scratch.sweep = sweep;
}

/// Longest axis of a box (centre, half sizes); of equal ones the last.
fn longest_axis(aabb: &[f64; 6]) -> usize {
    let [_, _, _, x, y, z] = *aabb;
    match () {
        () if x > y && x > z => 0,
        () if y > z => 1,
        () => 2,
    }
}

/// Elements that collide with others of the same flex: tetrahedra near the surface, all others.
fn is_active(flex: Flex, e: usize) -> bool {
    let m = flex.m;
    flex.dim() < 3 || m.flex_elemlayer[flex.elements().start + e] < m.flex_activelayers[flex.id]
}

/// Contacts of the vertices of a flex with a plane.
fn plane(at: World, g: usize, f: usize, con: &mut Contacts) {
    let m = at.m;
    let ([margin, gap], radius) = (geom_reach(m, g, f), at.flex(f).radius());
    let (origin, normal) = (at.kin.geom_xpos[g], column(&at.kin.geom_xmat[g], 2));
    let mixture = Mixture::of_flex(m, [Surface::geom(m, g), Surface::flex(m, f)], margin);
    for (v, &point) in at.points(f).iter().enumerate() {
        let height = dot(sub(point, origin), normal);
        if height > margin + gap + radius {
            continue;
        }
        let dist = height - radius;
        let pos = add_scaled(point, normal, -dist * 0.5 - radius);
        let parts = Parts { geom: [g as i32, -1], flex: [-1, f as i32], vert: [-1, v as i32], ..Parts::NONE };
        let found = PreContact { dist, pos, normal, tangent: [0.0; 3] };
        con.contact.push(mixture.of_parts(parts, &found));
    }
}
