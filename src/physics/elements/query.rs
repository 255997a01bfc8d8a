//! Jacobians and rays by id.

use super::element::Element;
use super::ids::{BodyId, GeomId, SiteId, geom_at};
use crate::data::Data;
use crate::math::Vec3;
use crate::model::Model;
use crate::position::jacobian::Jacobian;
use crate::ray::{Hit, Ray, RayFilter, ray};

/// What has a frame that moves with a body.
pub trait Framed {
    /// Writes the Jacobian of the origin and the orientation of the frame.
    ///
    /// # Panics
    /// In debug builds: the id belongs to another model.
    #[track_caller]
    fn jacobian(self, m: &Model, d: &Data, out: &mut Jacobian);
}

impl Framed for BodyId {
    #[track_caller]
    fn jacobian(self, m: &Model, d: &Data, out: &mut Jacobian) {
        self.check_model(m);
        out.body(m, &d.kin, &d.com, self.index());
    }
}

impl Framed for GeomId {
    #[track_caller]
    fn jacobian(self, m: &Model, d: &Data, out: &mut Jacobian) {
        self.check_model(m);
        out.geom(m, &d.kin, &d.com, self.index());
    }
}

impl Framed for SiteId {
    #[track_caller]
    fn jacobian(self, m: &Model, d: &Data, out: &mut Jacobian) {
        self.check_model(m);
        out.site(m, &d.kin, &d.com, self.index());
    }
}

impl Jacobian {
    /// Jacobian of the frame of a body, geom or site at the poses of the last [`forward`](crate::forward); memory is
    /// reused.
    ///
    /// # Panics
    /// In debug builds: the id belongs to another model.
    #[track_caller]
    pub fn set_to(&mut self, m: &Model, d: &Data, frame: impl Framed) {
        frame.jacobian(m, d, self);
    }

    /// Linear and angular velocity, world frame, that joint velocities `qvel` give the frame \[m/s, rad/s\].
    pub fn velocity(&self, qvel: &[f64]) -> [Vec3; 2] {
        let product = |matrix: &[f64]| {
            std::array::from_fn(|i| {
                let row = &matrix[i * qvel.len()..(i + 1) * qvel.len()];
                row.iter().zip(qvel).map(|(j, v)| j * v).sum()
            })
        };
        [product(&self.pos), product(&self.rot)]
    }

    /// Joint forces, added to `qfrc`, that a force at the origin of the frame and a torque, world frame, amount to
    /// \[N, N m\].
    pub fn add_wrench(&self, force: Vec3, torque: Vec3, qfrc: &mut [f64]) {
        let nv = qfrc.len();
        for (i, (f, t)) in force.into_iter().zip(torque).enumerate() {
            for (dof, q) in qfrc.iter_mut().enumerate() {
                *q += self.pos[i * nv + dof] * f + self.rot[i * nv + dof] * t;
            }
        }
    }
}

impl Data {
    /// Jacobian of the frame of a body, geom or site at the poses of the last [`forward`](crate::forward).
    ///
    /// # Panics
    /// In debug builds: the id belongs to another model.
    #[track_caller]
    pub fn jacobian(&self, m: &Model, frame: impl Framed) -> Jacobian {
        let mut jacobian = Jacobian::default();
        jacobian.set_to(m, self, frame);
        jacobian
    }

    /// The nearest visible geom that a ray hits, and where, at the poses of the last [`forward`](crate::forward).
    pub fn cast_ray(&self, m: &Model, cast: Ray, filter: RayFilter) -> Option<(GeomId, Hit)> {
        ray(m, &self.kin, cast, filter).map(|(geom, hit)| (geom_at(m.origin(), geom), hit))
    }
}
