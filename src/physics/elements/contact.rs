//! Contacts of the last evaluation, with ids.

use super::ids::{GeomId, geom_at};
use crate::acceleration::contact_force::contact_force;
use crate::data::{Contact, Data};
use crate::math::{Mat3, Vec3, row};
use crate::model::Model;

/// One contact of a simulation.
#[derive(Clone, Copy, Debug)]
pub struct ContactView<'d> {
    d: &'d Data,
    contact: &'d Contact,
}

impl Data {
    /// Contacts of the last [`forward`](crate::forward) or [`step`](crate::step), those within a margin included.
    pub fn contacts(&self) -> impl ExactSizeIterator<Item = ContactView<'_>> {
        self.con.contact.iter().map(|contact| ContactView { d: self, contact })
    }
}

impl<'d> ContactView<'d> {
    /// The two geoms; none on the side of a flex.
    pub fn geoms(self) -> [Option<GeomId>; 2] {
        self.contact.geom.map(|geom| usize::try_from(geom).ok().map(|geom| geom_at(self.d.origin, geom)))
    }

    /// True when `geom` is one of the two.
    ///
    /// # Panics
    /// In debug builds: the id belongs to another model.
    #[track_caller]
    pub fn touches(self, geom: GeomId) -> bool {
        geom.origin.check(self.d.origin);
        self.geoms().contains(&Some(geom))
    }

    /// Midpoint between the surfaces, world frame \[m\].
    pub fn pos(self) -> &'d Vec3 {
        &self.contact.pos
    }

    /// Rows are the normal, from the first geom to the second, and two tangents; world frame.
    pub fn frame(self) -> &'d Mat3 {
        &self.contact.frame
    }

    /// Unit normal, from the first geom to the second, world frame.
    pub fn normal(self) -> Vec3 {
        row(&self.contact.frame, 0)
    }

    /// Distance of the surfaces, negative in penetration \[m\].
    pub fn dist(self) -> f64 {
        self.contact.dist
    }

    /// Force and torque of the first geom on the second in the contact frame, normal first \[N, N m\]; zero where the
    /// contact makes no force.
    pub fn force(self, m: &Model) -> [f64; 6] {
        contact_force(m, &self.d.efc, self.contact)
    }

    /// All parameters of the contact.
    pub fn parameters(self) -> &'d Contact {
        self.contact
    }
}
