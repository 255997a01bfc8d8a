//! Pairs of elements of flexes, and of geoms, that may touch: descent of trees of boxes.

use super::element;
use super::world::{World, ball_apart, boxes_apart, geom_matches, geom_reach, is_of_type, margin};
use crate::collision::mid_phase::{Centres, Relation, Tree, walk};
use crate::collision::scratch::CollisionScratch;
use crate::model::GeomType;
use crate::stages::Contacts;

const IDENTITY: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// The tree of a flex, whose boxes lie along the world's axes.
pub(super) fn tree_of(at: World<'_>, f: usize) -> Tree<'_> {
    let start = at.m.flex_bvhadr[f] as usize;
    Tree {
        children: &at.m.bvh_child[start..],
        ids: &at.m.bvh_nodeid[start..],
        boxes: &at.flexes.bvh_aabb_dyn[start - at.m.nbvhstatic..],
    }
}

/// Contacts of the geoms of a body, planes and fields aside, with the elements of a flex.
pub(super) fn body_flex(
    at: World,
    body: usize,
    f: usize,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) {
    let (m, kin, boxes) = (at.m, at.kin, at.boxes(f));
    let body_margin = margin(m, m.body_margin[body] + m.flex_margin[f]);
    let relation =
        Relation::new([kin.xipos[body], [0.0; 3]], [&kin.ximat[body], &IDENTITY], Centres::InFrame);
    let touches = |g: usize, e: usize| {
        let [margin, gap] = geom_reach(m, g, f);
        let reach = margin + gap;
        if !geom_matches(m, g, f) || ball_apart(kin.geom_xpos[g], m.geom_rbound[g] + margin + gap, &boxes[e])
        {
            return false;
        }
        let (pos, mat) = (kin.geom_xpos[g], &kin.geom_xmat[g]);
        Relation::new([pos, [0.0; 3]], [mat, &IDENTITY], Centres::InWorld)
            .overlap([&m.geom_aabb[g], &boxes[e]], reach)
    };
    let mut stack = std::mem::take(&mut scratch.stack);
    walk::<false>(
        [Tree::of_body(m, body), tree_of(at, f)],
        &mut stack,
        |a, b| relation.overlap([a, b], body_margin),
        |g, e| {
            let as_a_whole = is_of_type(m, g, GeomType::Plane) || is_of_type(m, g, GeomType::Sdf);
            if !as_a_whole && touches(g, e) {
                element::with_geom(at, g, f, e, scratch, con);
            }
            scratch.has_room(con)
        },
    );
    scratch.stack = stack;
}

/// Contacts of the elements of two flexes, or of a flex with itself.
pub(super) fn two_flexes(at: World, pair: [usize; 2], scratch: &mut CollisionScratch, con: &mut Contacts) {
    let m = at.m;
    let reach = margin(m, m.flex_margin[pair[0]] + m.flex_margin[pair[1]]);
    let trees = pair.map(|f| tree_of(at, f));
    let mut stack = std::mem::take(&mut scratch.stack);
    let near = |a: &[f64; 6], b: &[f64; 6]| !boxes_apart(a, b, reach);
    let found = |e1: usize, e2: usize| {
        element::with_element(at, pair, [e1, e2], scratch, con);
        scratch.has_room(con)
    };
    if pair[0] == pair[1] {
        walk::<true>(trees, &mut stack, near, found);
    } else {
        walk::<false>(trees, &mut stack, near, found);
    }
    scratch.stack = stack;
}
