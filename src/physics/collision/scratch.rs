//! Working memory of collision detection: what its parts keep from call to call.

use super::broad_phase::BroadPhase;
use super::element_sweep::Sweep;
use super::gjk::Vertex;
use super::multicontact::{Clipper, Witness};
use super::polytope::Polytope;
use super::shape::PreContact;
use super::thin::Spread;
use crate::math::Vec3;
use crate::stages::{Contact, Contacts, Demand, OverBudget, StepBudget};

/// Bytes of a contact while their list grows.
const CONTACT_BYTES: usize = 3 * size_of::<Contact>();

/// Working memory of collision detection, reused from step to step.
#[derive(Clone, Debug, Default)]
pub struct CollisionScratch {
    pub(super) broad: BroadPhase,
    pub(super) stack: Vec<(usize, usize)>,
    pub(super) candidates: Vec<(usize, usize)>,
    pub(super) convex: ConvexScratch,
    pub(super) points: Vec<PreContact>,
    pub(super) spread: Spread,
    pub(super) sweep: Sweep,
    pub(super) budget: StepBudget,
}

impl CollisionScratch {
    /// Contacts that fit in the budget.
    pub(super) fn most_contacts(&self) -> usize {
        self.budget.count(CONTACT_BYTES)
    }

    /// Whether the contacts found so far fit in the budget, in a loop that may find too many.
    pub(super) fn has_room(&self, con: &Contacts) -> bool {
        con.contact.len() <= self.most_contacts()
    }

    /// Whether the contacts found so far fit in the budget.
    pub(super) fn check(&self, con: &Contacts) -> Result<(), OverBudget> {
        let found = con.contact.len();
        if found <= self.most_contacts() {
            return Ok(());
        }
        Err(self.budget.exceeded(Demand::Contacts, found, CONTACT_BYTES))
    }
}

/// Working memory of the convex algorithms, reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct ConvexScratch {
    pub(super) simplex: [Vertex; 4],
    pub(super) polytope: Polytope,
    pub(super) clipper: Clipper,
    pub(super) witness: Vec<Witness>,
    /// Of the functions for signed distances.
    pub(super) field: FieldScratch,
}

/// Working memory of contacts with fields, reused from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct FieldScratch {
    /// Points that are contacts already.
    pub(super) known: Vec<Vec3>,
    /// Points of a triangle, or of all of a mesh, that lie inside.
    pub(super) candidates: Vec<Candidate>,
    /// Triangles of a sheet with their deepest points.
    pub(super) deepest: Vec<(usize, Candidate)>,
    /// Which triangle of the sheet each contact belongs to.
    pub elements: Vec<usize>,
}

/// A point of a triangle inside the field, in the frame of that.
#[derive(Clone, Debug)]
pub(crate) struct Candidate {
    pub(super) at: Vec3,
    pub(super) depth: f64,
}
