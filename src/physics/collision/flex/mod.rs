//! Contacts of flexes: of their elements with geoms and with elements of other flexes and their own, of their vertices
//! with planes, and within them (MuJoCo documentation, Computation, "Deformable objects", collisions).
//!
//! Elements that may touch come from trees of boxes (`tree.rs`) or from a sweep (`sweep.rs`); `element.rs` and
//! `triangle.rs` find the points of contact, `internal.rs` those between neighbours; `thin.rs` keeps the number of
//! contacts of two bodies or flexes within bounds.

mod element;
mod internal;
mod sweep;
mod thin;
mod tree;
mod triangle;

pub(super) use sweep::Sweep;
pub(super) use thin::Spread;

use super::mixing::{self, Mixture, Parts, Surface};
use super::{CollisionScratch, PreContact, sdf};
use crate::collision::broad_phase::{geoms, types_match};
use crate::data::{Contacts, Flexes, Kinematics};
use crate::flex::Flex;
use crate::math::{Vec3, add_scaled, column, dot, sub};
use crate::model::{Disable, FlexSelf, GeomType, Model};
use crate::sleep::{Awake, object};

/// What contacts are found in.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// The model.
    pub m: &'a Model,
    /// Where bodies and geoms are.
    pub kin: &'a Kinematics,
    /// Where vertices, elements and their boxes are.
    pub flexes: &'a Flexes,
}

impl<'a> World<'a> {
    fn flex(self, f: usize) -> Flex<'a> {
        Flex { m: self.m, id: f }
    }

    fn middle_phase(self) -> bool {
        !self.m.opt.disableflags.contains(Disable::MIDPHASE)
    }

    /// Positions of the vertices of a flex.
    fn points(self, f: usize) -> &'a [Vec3] {
        &self.flexes.flexvert_xpos[self.flex(f).vertices()]
    }

    /// Boxes of the elements of a flex.
    fn boxes(self, f: usize) -> &'a [[f64; 6]] {
        &self.flexes.flexelem_aabb[self.flex(f).elements()]
    }
}

/// Distance below which two surfaces make force, given the sum of their margins.
fn margin(m: &Model, sum: f64) -> f64 {
    if mixing::overridden(m) { m.opt.o_margin } else { sum }
}

/// Margin of a geom and a flex, and the gap beyond it.
fn geom_reach(m: &Model, g: usize, f: usize) -> [f64; 2] {
    [margin(m, m.geom_margin[g] + m.flex_margin[f]), m.geom_gap[g] + m.flex_gap[f]]
}

/// Boxes (centre, half sizes) along the same axes that are farther apart than `margin`.
fn boxes_apart(a: &[f64; 6], b: &[f64; 6], margin: f64) -> bool {
    (0..3).any(|k| a[k] + a[k + 3] + margin < b[k] - b[k + 3] || b[k] + b[k + 3] + margin < a[k] - a[k + 3])
}

/// A box around a ball and another box are apart.
fn ball_apart(centre: Vec3, bound: f64, aabb: &[f64; 6]) -> bool {
    (0..3).any(|k| centre[k] + bound < aabb[k] - aabb[k + 3] || centre[k] - bound > aabb[k] + aabb[k + 3])
}

fn geom_matches(m: &Model, g: usize, f: usize) -> bool {
    types_match(m.geom_contype[g], m.geom_conaffinity[g], m.flex_contype[f], m.flex_conaffinity[f])
}

fn is_of_type(m: &Model, g: usize, kind: GeomType) -> bool {
    m.geom_type[g] == kind.code()
}

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
            sweep::own_elements(at, f, scratch, con);
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
