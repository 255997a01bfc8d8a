//! Which bodies a point of contact on a flex belongs to, and with what weight.

use super::lattice::{Lattice, share_interior};
use crate::math::{Vec3, add_scaled, distance};
use crate::model::Model;
use crate::model::bounds::MINVAL;
use crate::model::flex::Flex;
use crate::stages::{Contact, Flexes};

/// Weights of nodes below this are left out.
const LEAST_SHARE: f64 = 1e-5;

/// Vertices of an element, at most.
const MAX_CORNERS: usize = 4;

/// Appends the bodies that move side `side` of a contact with their weights, which add up to `sign`.
pub(crate) fn bodies_of(
    m: &Model,
    flexes: &Flexes,
    contact: &Contact,
    side: usize,
    sign: f64,
    out: &mut Vec<(usize, f64)>,
) {
    if let Ok(geom) = usize::try_from(contact.geom[side]) {
        out.push((m.geom_bodyid[geom] as usize, sign));
        return;
    }
    let flex = Flex { m, id: contact.flex[side] as usize };
    let first = flex.vertices().start;
    let mut corners = Corners { vertices: [0; MAX_CORNERS], weights: [0.0; MAX_CORNERS], count: 0 };
    if let Ok(vertex) = usize::try_from(contact.vert[side]) {
        corners.push(first + vertex, sign);
    } else {
        corners.fill(flex, flexes, contact.elem[side] as usize, contact.vert[1 - side], contact.pos);
        corners.weights.iter_mut().for_each(|w| *w *= sign);
    }
    if flex.is_interpolated() {
        nodes_of(flex, &corners, sign, out);
    } else {
        out.extend(corners.iter().map(|(v, weight)| (m.flex_vertbodyid[v] as usize, weight)));
    }
}

/// The only body on each side of a contact of geoms and vertices that move themselves; `None` for others.
#[inline]
pub(crate) fn single_bodies(m: &Model, contact: &Contact) -> Option<[usize; 2]> {
    match contact.geom.map(usize::try_from) {
        [Ok(first), Ok(second)] => Some([first, second].map(|geom| m.geom_bodyid[geom] as usize)),
        _ => single_bodies_with_flex(m, contact),
    }
}

#[cold]
fn single_bodies_with_flex(m: &Model, contact: &Contact) -> Option<[usize; 2]> {
    let body = |side: usize| {
        if let Ok(geom) = usize::try_from(contact.geom[side]) {
            return Some(m.geom_bodyid[geom] as usize);
        }
        let flex = Flex { m, id: contact.flex[side] as usize };
        let vertex = usize::try_from(contact.vert[side]).ok().filter(|_| !flex.is_interpolated())?;
        Some(flex.vertex_bodies()[vertex] as usize)
    };
    Some([body(0)?, body(1)?])
}

/// Vertices with weights.
struct Corners {
    vertices: [usize; MAX_CORNERS],
    weights: [f64; MAX_CORNERS],
    count: usize,
}

impl Corners {
    fn push(&mut self, vertex: usize, weight: f64) {
        self.vertices[self.count] = vertex;
        self.weights[self.count] = weight;
        self.count += 1;
    }

    fn iter(&self) -> impl Iterator<Item = (usize, f64)> {
        self.vertices.into_iter().zip(self.weights).take(self.count)
    }

    /// The vertices of an element but for `without`, weighted by inverse distance from a point.
    fn fill(&mut self, flex: Flex, flexes: &Flexes, element: usize, without: i32, point: Vec3) {
        let first = flex.vertices().start;
        let corners = flex.element(element);
        let left_out = corners.iter().rposition(|&v| v == without);
        for (k, &v) in corners.iter().enumerate() {
            let vertex = first + v as usize;
            let gap = distance(point, flexes.flexvert_xpos[vertex]);
            if Some(k) != left_out {
                self.push(vertex, 1.0 / if gap > MINVAL { gap } else { MINVAL });
            }
        }
        let sum = self.iter().fold(0.0, |sum, (_, weight)| sum + weight);
        self.weights.iter_mut().for_each(|w| *w *= 1.0 / sum);
    }
}

/// Appends the bodies of the nodes around the weighted mean of some vertices.
fn nodes_of(flex: Flex, corners: &Corners, sign: f64, out: &mut Vec<(usize, f64)>) {
    let (lattice, bodies, start) = (Lattice::new(flex), flex.node_bodies(), out.len());
    let point =
        corners.iter().fold([0.0; 3], |sum, (v, weight)| add_scaled(sum, flex.m.flex_vert0[v], weight.abs()));
    let mut add = |node: usize, weight: f64| {
        let body = bodies[node] as usize;
        match out[start..].iter_mut().find(|(b, _)| *b == body) {
            Some((_, sum)) => *sum += weight,
            None => out.push((body, weight)),
        }
    };
    for (node, weight) in lattice.locate(point).weights().filter(|&(_, weight)| weight >= LEAST_SHARE) {
        if lattice.is_inside(node) {
            share_interior(&lattice, node, sign * weight, &mut add);
        } else {
            add(node, sign * weight);
        }
    }
}
