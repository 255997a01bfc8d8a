//! Contacts of one element of a flex: with a geom, with another element, with a vertex of its own flex.

use super::triangle::Triangle;
use super::world::{World, ball_apart, boxes_apart, geom_reach, margin};
use crate::collision::capsule::capsule_capsule;
use crate::collision::capsule_box::capsule_box;
use crate::collision::convex::penetration;
use crate::collision::mixing::{Mixture, Parts, Surface};
use crate::collision::scratch::CollisionScratch;
use crate::collision::shape::Shape;
use crate::collision::sphere::sphere_capsule;
use crate::collision::support::{ConvexBody, Element};
use crate::collision::{hfield, round_normal};
use crate::math::{Vec3, add, normalize, quat_from_z, quat_to_mat, scale, sub};
use crate::model::{Disable, GeomType, Model};
use crate::stages::Contacts;

const IDENTITY: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Corners of an element, in the world.
pub(super) fn corners(at: World, f: usize, e: usize) -> ([Vec3; 4], usize) {
    let (points, vertices) = (at.points(f), at.flex(f).element(e));
    let mut corners = [[0.0; 3]; 4];
    for (corner, &v) in corners.iter_mut().zip(vertices) {
        *corner = points[v as usize];
    }
    (corners, vertices.len())
}

/// The capsule around a line.
fn capsule(at: World<'_>, f: usize, e: usize) -> Shape<'_> {
    let ([a, b, ..], _) = corners(at, f, e);
    let (axis, length) = normalize(sub(a, b));
    Shape {
        kind: GeomType::Capsule,
        pos: scale(add(a, b), 0.5),
        mat: quat_to_mat(quat_from_z(axis)),
        size: [at.flex(f).radius(), 0.5 * length, 0.0],
        geom: 0,
        m: at.m,
    }
}

/// A triangle with its radius.
fn triangle(at: World, f: usize, e: usize) -> Triangle {
    let ([a, b, c, _], _) = corners(at, f, e);
    Triangle { corners: [a, b, c], radius: at.flex(f).radius() }
}

/// An element for the convex algorithms, and its centre.
fn convex(at: World, f: usize, e: usize, margin: f64) -> (Element, Vec3) {
    let (corners, count) = corners(at, f, e);
    let [x, y, z, ..] = at.boxes(f)[e];
    (Element { corners, count, inflation: at.flex(f).radius() + 0.5 * margin }, [x, y, z])
}

/// Some vertex of the element is fixed to the body.
fn is_on_body(at: World, f: usize, e: usize, body: i32) -> bool {
    let flex = at.flex(f);
    body >= 0 && flex.element(e).iter().any(|&v| flex.vertex_bodies()[v as usize] == body)
}

/// Contacts of element `e` of flex `f` with geom `g`.
pub(super) fn with_geom(
    at: World,
    g: usize,
    f: usize,
    e: usize,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) {
    let (m, dim) = (at.m, at.flex(f).dim());
    let [margin, gap] = geom_reach(m, g, f);
    let without_trees = !at.middle_phase();
    if without_trees && ball_apart(at.kin.geom_xpos[g], m.geom_rbound[g] + margin + gap, &at.boxes(f)[e])
        || is_on_body(at, f, e, m.geom_bodyid[g])
    {
        return;
    }
    let (geom, reach) = (Shape::new(m, at.kin, g), margin + gap);
    let out = &mut scratch.points;
    out.clear();
    match (geom.kind, dim) {
        (GeomType::Sphere, 1) => sphere_capsule(&geom, &capsule(at, f, e), reach, out),
        (GeomType::Capsule, 1) => capsule_capsule(&geom, &capsule(at, f, e), reach, out),
        (GeomType::Box, 1) => {
            capsule_box(&capsule(at, f, e), &geom, reach, out);
            out.iter_mut().for_each(|found| found.normal = scale(found.normal, -1.0));
        }
        (GeomType::Hfield, _) => {
            let (element, centre) = convex(at, f, e, reach);
            hfield::element(m, &geom, &element, centre, reach, &mut scratch.convex, out);
        }
        (GeomType::Sphere, 2) => out.extend(triangle(at, f, e).ball(geom.pos, geom.size[0], reach)),
        (GeomType::Box, 2) => triangle(at, f, e).cuboid(&geom, reach, out),
        (GeomType::Capsule, 2) => triangle(at, f, e).capsule(&geom, reach, out),
        _ => {
            let (element, centre) = convex(at, f, e, reach);
            let Some(mut body) = ConvexBody::new(&geom, reach) else { return };
            let mut other = ConvexBody::element(&element, centre);
            penetration(&m.opt, &mut body, &mut other, 1, reach, &mut scratch.convex, out);
            if dim == 2 && !m.opt.disableflags.contains(Disable::NATIVECCD) {
                out.iter_mut().for_each(|found| round_normal::correct_first(found, &geom));
            }
        }
    }
    let surfaces = [Surface::geom(m, g), Surface::flex(m, f)];
    let parts = Parts { geom: [g as i32, -1], flex: [-1, f as i32], elem: [-1, e as i32], ..Parts::NONE };
    append(at, surfaces, margin, parts, scratch, con);
}

/// Margin of two flexes, and the gap beyond it; none within one flex.
fn flex_reach(m: &Model, [f1, f2]: [usize; 2]) -> [f64; 2] {
    if f1 == f2 {
        return [0.0; 2];
    }
    [margin(m, m.flex_margin[f1] + m.flex_margin[f2]), m.flex_gap[f1] + m.flex_gap[f2]]
}

/// Contacts of two elements, of two flexes or of the same; none where they have a body in common.
pub(super) fn with_element(
    at: World,
    pair: [usize; 2],
    [e1, e2]: [usize; 2],
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) {
    let [f1, f2] = pair;
    let [margin, gap] = flex_reach(at.m, pair);
    let first = at.flex(f1);
    let shares_body =
        || first.element(e1).iter().any(|&v| is_on_body(at, f2, e2, first.vertex_bodies()[v as usize]));
    if !boxes_apart(&at.boxes(f1)[e1], &at.boxes(f2)[e2], margin + gap) && !shares_body() {
        with_other_element(at, pair, [e1, e2], scratch, con);
    }
}

/// The same where they have no body in common.
pub(super) fn with_other_element(
    at: World,
    [f1, f2]: [usize; 2],
    [e1, e2]: [usize; 2],
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) {
    let m = at.m;
    let [margin, gap] = flex_reach(m, [f1, f2]);
    let (first, reach) = (at.flex(f1), margin + gap);
    if boxes_apart(&at.boxes(f1)[e1], &at.boxes(f2)[e2], reach) {
        return;
    }
    scratch.points.clear();
    if first.dim() == 1 && at.flex(f2).dim() == 1 {
        capsule_capsule(&capsule(at, f1, e1), &capsule(at, f2, e2), reach, &mut scratch.points);
    } else {
        let [(a, centre_a), (b, centre_b)] = [convex(at, f1, e1, reach), convex(at, f2, e2, reach)];
        let (mut a, mut b) = (ConvexBody::element(&a, centre_a), ConvexBody::element(&b, centre_b));
        penetration(&m.opt, &mut a, &mut b, 1, reach, &mut scratch.convex, &mut scratch.points);
    }
    let flex = [f1 as i32, f2 as i32];
    let parts = Parts { flex, elem: [e1 as i32, e2 as i32], ..Parts::NONE };
    append(at, [Surface::flex(m, f1), Surface::flex(m, f2)], margin, parts, scratch, con);
}

/// Contacts of an element and a vertex of the same flex, without margin.
pub(super) fn with_vertex(
    at: World,
    f: usize,
    e: usize,
    v: usize,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) {
    let (m, flex) = (at.m, at.flex(f));
    let (radius, point, aabb) = (flex.radius(), at.points(f)[v], &at.boxes(f)[e]);
    let bound = margin(m, m.flex_margin[f]) + radius;
    if ball_apart(point, bound, aabb) {
        return;
    }
    scratch.points.clear();
    let out = &mut scratch.points;
    match flex.dim() {
        1 => {
            let ball = Shape {
                kind: GeomType::Sphere,
                pos: point,
                mat: IDENTITY,
                size: [radius, 0.0, 0.0],
                geom: 0,
                m,
            };
            sphere_capsule(&ball, &capsule(at, f, e), 0.0, out);
        }
        2 => out.extend(triangle(at, f, e).ball(point, radius, 0.0)),
        _ => {
            let vertex = Element { corners: [point; 4], count: 1, inflation: radius };
            let (element, centre) = convex(at, f, e, 0.0);
            let mut a = ConvexBody::element(&vertex, point);
            let mut b = ConvexBody::element(&element, centre);
            penetration(&m.opt, &mut a, &mut b, 1, 0.0, &mut scratch.convex, out);
        }
    }
    let parts = Parts { flex: [f as i32; 2], elem: [-1, e as i32], vert: [v as i32, -1], ..Parts::NONE };
    append(at, [Surface::flex(m, f); 2], 0.0, parts, scratch, con);
}

/// Appends contacts at the points that were found.
fn append(
    at: World,
    surfaces: [Surface; 2],
    margin: f64,
    parts: Parts,
    scratch: &CollisionScratch,
    con: &mut Contacts,
) {
    if !scratch.points.is_empty() {
        let mixture = Mixture::of_flex(at.m, surfaces, margin);
        con.contact.extend(scratch.points.iter().map(|point| mixture.of_parts(parts, point)));
    }
}
