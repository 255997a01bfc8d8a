//! Contacts within a flex between neighbours: elements with the vertices that the compiler paired them with, and
//! tetrahedra whose corners come near the opposite face, so that they do not turn inside out.

use super::element;
use super::world::World;
use crate::collision::mixing::{Mixture, Parts, Surface};
use crate::collision::scratch::CollisionScratch;
use crate::collision::shape::PreContact;
use crate::math::{Vec3, add_scaled, cross, dot, normalize, scale, sub};
use crate::stages::Contacts;

/// Faces of a tetrahedron, each followed by the opposite corner.
const FACES: [[usize; 4]; 4] = [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 3, 2, 0]];

/// Contacts of neighbours in flex `f`.
pub(super) fn neighbours(at: World, f: usize, scratch: &mut CollisionScratch, con: &mut Contacts) {
    let (m, flex) = (at.m, at.flex(f));
    let first = m.flex_evpairadr[f].max(0) as usize;
    for &[e, v] in &m.flex_evpair[first..first + m.flex_evpairnum[f] as usize] {
        if !scratch.has_room(con) {
            return;
        }
        element::with_vertex(at, f, e as usize, v as usize, scratch, con);
    }
    if flex.dim() != 3 {
        return;
    }
    let mixture = Mixture::of_flex(m, [Surface::flex(m, f); 2], 0.0).frictionless();
    for e in 0..flex.elements().len() {
        let (corners, vertices) = (element::corners(at, f, e).0, flex.element(e));
        for [a, b, c, apex] in FACES {
            let face = [corners[a], corners[b], corners[c]];
            if let Some(found) = apex_above(face, corners[apex], flex.radius()) {
                let (elem, vert) = ([e as i32, -1], [-1, vertices[apex]]);
                let parts = Parts { flex: [f as i32; 2], elem, vert, ..Parts::NONE };
                con.contact.push(mixture.of_parts(parts, &found));
            }
        }
    }
}

/// A corner that is above its face, or below it by less than twice the radius.
fn apex_above([a, b, c]: [Vec3; 3], apex: Vec3, radius: f64) -> Option<PreContact> {
    let (normal, _) = normalize(cross(sub(b, a), sub(c, a)));
    let height = dot(sub(apex, a), normal);
    (height > -2.0 * radius).then(|| PreContact {
        dist: -height - 2.0 * radius,
        normal: scale(normal, -1.0),
        pos: add_scaled(apex, normal, -0.5 * height),
        tangent: [0.0; 3],
    })
}
