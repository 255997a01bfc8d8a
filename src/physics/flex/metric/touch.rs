//! Contacts of flexes that ask for it are springs instead of constraints: between flexes, within a flex, and with static
//! geoms. The stiffness is chosen so that the lightest vertex in contact oscillates with a given frequency.

use super::stiffened::has_soft_contacts;
use crate::flex::difference::Difference;
use crate::inertia;
use crate::math::{Vec3, dot, row};
use crate::model::Model;
use crate::model::flex::Flex;
use crate::stages::{Com, Contact, Contacts, Flexes, Inertia};
use std::ops::Range;

/// Square of the frequency \[1/s²\].
const FREQUENCY_SQUARED: f64 = 5e7;

/// `exclude` of a contact that is a spring, and of one that moves nothing.
const SPRING: i32 = 4;
const NO_DOF: i32 = 3;

/// Marks the contacts that are springs.
pub(crate) fn mark(m: &Model, con: &mut Contacts) {
    let soft = |f: i32| usize::try_from(f).is_ok_and(|id| m.flex_passive[id] != 0);
    let still = |g: i32| usize::try_from(g).is_ok_and(|g| m.body_weldid[m.geom_bodyid[g] as usize] == 0);
    for contact in &mut con.contact {
        let both = contact.flex.iter().all(|&f| f >= 0);
        let on_still = (0..2).any(|side| contact.flex[side] < 0 && still(contact.geom[side]));
        if contact.flex.into_iter().any(soft) && (both || on_still) {
            contact.exclude = SPRING;
        }
    }
}

/// A contact that is a spring.
#[derive(Clone, Debug)]
pub(super) struct Touch {
    /// Number of the contact.
    contact: usize,
    /// \[N/m\].
    pub stiffness: f64,
    /// Where its derivative is.
    row: Range<usize>,
}

/// The contacts that are springs, with the derivatives of their distances.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touches {
    all: Vec<Touch>,
    columns: Vec<i32>,
    values: Vec<f64>,
    /// Working memory.
    bodies: Vec<(usize, f64)>,
    sum: Difference,
}

impl Touch {
    /// Calls `f` with the bodies of the vertices that touch.
    pub fn for_vertices(&self, m: &Model, con: &Contacts, mut f: impl FnMut(i32)) {
        vertices(m, &con.contact[self.contact], &mut f);
    }
}

/// Calls `f` with the bodies of the vertices of a contact.
fn vertices(m: &Model, contact: &Contact, mut f: impl FnMut(i32)) {
    for side in 0..2 {
        let Ok(id) = usize::try_from(contact.flex[side]) else { continue };
        let flex = Flex { m, id };
        let bodies = flex.vertex_bodies();
        if let Ok(vertex) = usize::try_from(contact.vert[side]) {
            f(bodies[vertex]);
        } else if let Ok(element) = usize::try_from(contact.elem[side]) {
            flex.element(element).iter().for_each(|&v| f(bodies[v as usize]));
        }
    }
}

/// Stiffness of a contact, zero without mass that moves.
fn stiffness(m: &Model, inertia: &Inertia, contact: &Contact) -> f64 {
    let mut least = 0.0;
    vertices(m, contact, |body| {
        let Ok(body) = usize::try_from(body) else { return };
        if m.body_dofnum[body] == 3 {
            let mass = inertia.M[inertia::row(m, m.body_dofadr[body] as usize).end - 1];
            if mass > 0.0 && (least == 0.0 || mass < least) {
                least = mass;
            }
        }
    });
    FREQUENCY_SQUARED * least
}

impl Touches {
    pub fn clear(&mut self) {
        self.all.clear();
        self.columns.clear();
        self.values.clear();
    }

    pub(super) fn all(&self) -> &[Touch] {
        &self.all
    }

    /// Finds the contacts that are springs.
    pub(super) fn find(
        &mut self,
        m: &Model,
        com: &Com,
        flexes: &Flexes,
        inertia: &Inertia,
        con: &mut Contacts,
    ) {
        if !Flex::all(m).any(has_soft_contacts) {
            return;
        }
        for (k, contact) in con.contact.iter_mut().enumerate().filter(|(_, c)| c.exclude == SPRING) {
            contact.efc_address = -1;
            self.sum.of_contact(m, com, flexes, contact, &mut self.bodies);
            if self.sum.dof.is_empty() {
                contact.exclude = NO_DOF;
                continue;
            }
            let first = self.columns.len();
            let normal = row(&contact.frame, 0);
            self.columns.extend_from_slice(&self.sum.dof);
            self.values.extend(self.sum.translation.iter().map(|&column| dot(normal, column)));
            let row = first..self.columns.len();
            self.all.push(Touch { contact: k, stiffness: stiffness(m, inertia, contact), row });
        }
    }

    /// Adds the forces of the springs.
    pub fn add_forces(&self, con: &Contacts, qfrc: &mut [f64]) {
        for touch in &self.all {
            let force = -touch.stiffness * con.contact[touch.contact].dist;
            self.add_row(touch, force, qfrc);
        }
    }

    fn add_row(&self, touch: &Touch, s: f64, out: &mut [f64]) {
        let (columns, values) = (&self.columns[touch.row.clone()], &self.values[touch.row.clone()]);
        for (&dof, &value) in columns.iter().zip(values) {
            out[dof as usize] += value * s;
        }
    }

    /// Adds `scale` times the stiffness of the springs times `v`.
    pub(super) fn add_product(&self, scale: f64, v: &[f64], out: &mut [f64]) {
        for touch in self.all.iter().filter(|touch| touch.stiffness > 0.0) {
            let (columns, values) = (&self.columns[touch.row.clone()], &self.values[touch.row.clone()]);
            let terms = columns.iter().zip(values);
            let speed = terms.fold(0.0, |sum, (&dof, &value)| sum + value * v[dof as usize]);
            self.add_row(touch, scale * touch.stiffness * speed, out);
        }
    }

    /// The derivative of the distance by the three degrees of freedom from `dof`.
    pub(super) fn normal(&self, touch: &Touch, dof: i32) -> Vec3 {
        let (columns, values) = (&self.columns[touch.row.clone()], &self.values[touch.row.clone()]);
        [0, 1, 2].map(|k| columns.binary_search(&(dof + k)).map_or(0.0, |at| values[at]))
    }
}
