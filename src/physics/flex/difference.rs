//! Jacobian of the motion of a point of one body relative to a point of another, over the degrees of freedom that
//! move either body.

use super::weights;
use crate::math::{Vec3, add_scaled, rotational, scale, sub};
use crate::model::Model;
use crate::position::chain::{MergedChain, chain, com_offset, point_column};
use crate::stages::{Com, Contact, Flexes};

/// A sparse Jacobian difference: column `i` belongs to degree of freedom `dof[i]`, in increasing order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Difference {
    /// Degrees of freedom.
    pub dof: Vec<i32>,
    /// Columns of the translational part.
    pub translation: Vec<Vec3>,
    /// Columns of the rotational part.
    pub rotation: Vec<Vec3>,
}

/// A point fixed to a body.
#[derive(Clone, Copy)]
pub(crate) struct BodyPoint {
    pub body: usize,
    pub point: Vec3,
}

impl Difference {
    /// Jacobian of point `b` minus the Jacobian of point `a`. Degrees of freedom that move both bodies are left out when
    /// `skip_common`, as they cannot move one point of contact relative to itself.
    pub(crate) fn difference(&mut self, m: &Model, com: &Com, a: BodyPoint, b: BodyPoint, skip_common: bool) {
        self.dof.clear();
        self.translation.clear();
        self.rotation.clear();
        let (from_a, from_b) = (com_offset(m, com, a.body, a.point), com_offset(m, com, b.body, b.point));
        for (dof, moves) in MergedChain::new(m, a.body, b.body) {
            let axis = rotational(&com.cdof[dof]);
            let (t, r) = match moves {
                [true, true] if skip_common => break,
                [true, true] => {
                    (sub(point_column(com, dof, from_b), point_column(com, dof, from_a)), [0.0; 3])
                }
                [true, false] => (scale(point_column(com, dof, from_a), -1.0), scale(axis, -1.0)),
                [false, _] => (point_column(com, dof, from_b), axis),
            };
            self.dof.push(dof as i32);
            self.translation.push(t);
            self.rotation.push(r);
        }
        self.dof.reverse();
        self.translation.reverse();
        self.rotation.reverse();
    }

    /// How the second side of a contact moves relative to the first; `bodies` is working memory.
    pub fn of_contact(
        &mut self,
        m: &Model,
        com: &Com,
        flexes: &Flexes,
        contact: &Contact,
        bodies: &mut Vec<(usize, f64)>,
    ) {
        if let Some([a, b]) = weights::single_bodies(m, contact) {
            let at = |body| BodyPoint { body, point: contact.pos };
            self.difference(m, com, at(a), at(b), true);
        } else {
            bodies.clear();
            weights::bodies_of(m, flexes, contact, 0, -1.0, bodies);
            weights::bodies_of(m, flexes, contact, 1, 1.0, bodies);
            self.weighted(m, com, bodies, contact.pos);
        }
    }

    /// Sum of the Jacobians of `point` on several bodies, each times its weight.
    pub fn weighted(&mut self, m: &Model, com: &Com, bodies: &[(usize, f64)], point: Vec3) {
        self.dof.clear();
        self.translation.clear();
        self.rotation.clear();
        for &(body, weight) in bodies {
            let offset = com_offset(m, com, body, point);
            for dof in chain(m, body) {
                let (t, r) = (point_column(com, dof, offset), rotational(&com.cdof[dof]));
                match self.dof.binary_search(&(dof as i32)) {
                    Ok(k) => {
                        self.translation[k] = add_scaled(self.translation[k], t, weight);
                        self.rotation[k] = add_scaled(self.rotation[k], r, weight);
                    }
                    Err(k) => {
                        self.dof.insert(k, dof as i32);
                        self.translation.insert(k, scale(t, weight));
                        self.rotation.insert(k, scale(r, weight));
                    }
                }
            }
        }
    }
}
