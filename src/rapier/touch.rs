//! Contacts that rapier solved, as contacts and constraint rows of a `Data`, for sensors and observations.

use crate::convert::array;
use crate::floating::Pace;
use crate::rules::{Geoms, mixture};
use physics::collision::PreContact;
use physics::constraint::push_applied;
use physics::data::{Constraints, Contact};
use physics::math::{Vec3, dot, row, scale};
use physics::model::{Cone, ConstraintType};
use physics::{Data, Model};
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{ContactManifold, NarrowPhase, RigidBodyHandle, RigidBodySet};

/// Rapier's contacts, and the geoms of their colliders.
#[derive(Clone, Copy)]
pub(crate) struct Found<'a> {
    pub narrow_phase: &'a NarrowPhase,
    pub bodies: &'a RigidBodySet,
    pub geoms: &'a Geoms,
}

/// Writes the contacts of the last step between geoms of a model, and their forces as rows after those of other
/// constraints.
pub(crate) fn write(m: &Model, found: Found<'_>, pace: Pace, d: &mut Data) {
    let Data { con, efc, .. } = d;
    con.contact.clear();
    for pair in found.narrow_phase.contact_pairs() {
        let geoms = [pair.collider1, pair.collider2].map(|handle| found.geoms.get(&handle).copied());
        let [Some(g1), Some(g2)] = geoms else { continue };
        let Some(mixture) = mixture(m, g1, g2) else { continue };
        // MuJoCo's contacts begin at the geom of the lower type.
        let swapped = m.geom_type[g1] > m.geom_type[g2];
        let (ids, sign) = if swapped { ([g2, g1], -1.0) } else { ([g1, g2], 1.0) };
        for manifold in pair.solver_manifolds() {
            let normal = scale(array(manifold.data.normal), sign);
            for touch in points(found.bodies, manifold, pace) {
                let point = PreContact { dist: touch.dist, pos: touch.pos, normal, tangent: [0.0; 3] };
                let mut contact = mixture.contact(ids, &point);
                // Rapier predicts contacts; one without penetration and impulse is not a contact in MuJoCo.
                if touch.dist > contact.includemargin && touch.normal == 0.0 {
                    continue;
                }
                if touch.normal > 0.0 {
                    let friction = scale(touch.friction, sign / pace.dt);
                    push_rows(m, &mut contact, con.contact.len(), (touch.normal / pace.dt, friction), efc);
                }
                con.contact.push(contact);
            }
        }
    }
}

/// Speed of points that slide rather than stick \[m/s\].
const SLIDING: f64 = 1e-3;

/// One point of contact.
struct Touch {
    pos: Vec3,
    dist: f64,
    /// Impulse along the normal over the whole step \[N s\].
    normal: f64,
    /// Impulse of friction on the second body, in the world \[N s\].
    friction: Vec3,
}

fn points<'a>(
    bodies: &'a RigidBodySet,
    manifold: &'a ContactManifold,
    pace: Pace,
) -> impl Iterator<Item = Touch> + 'a {
    let pressed: f64 = manifold.points.iter().map(|point| point.data.impulse).sum();
    manifold.data.solver_contacts.iter().filter_map(move |contact| {
        let [id] = contact.contact_indices();
        let data = &manifold.points.get(id as usize)?.data;
        let (p1, p2) = manifold.data.solver_contact_world_points(contact, bodies);
        let pos = (p1 + p2) / 2.0;
        let friction = match data.tangent_impulse.norm() {
            // Rapier's friction is that on the first body. For multibodies it has the magnitude over the whole step, and the direction of
            // the last iteration, in the world frame.
            size if size > 0.0 => -data.warmstart_tangent_world.normalize_or_zero() * size,
            // For bodies alone, that of the last iteration for all points together. Where they slide it is nothing at times, but
            // then friction is known.
            _ if pressed > 0.0 => {
                let slip = slip(bodies, manifold, pos);
                if slip.length() > SLIDING {
                    -slip.normalize() * manifold.data.friction * data.impulse
                } else {
                    -data.warmstart_tangent_world * pace.iterations as f64 * (data.impulse / pressed)
                }
            }
            _ => Vector::ZERO,
        };
        Some(Touch { pos: array(pos), dist: contact.dist, normal: data.impulse, friction: array(friction) })
    })
}

/// Velocity of the second body against the first along the surface, at a point.
fn slip(bodies: &RigidBodySet, manifold: &ContactManifold, at: Vector) -> Vector {
    let velocity = |handle: Option<RigidBodyHandle>| {
        handle.and_then(|handle| bodies.get(handle)).map_or(Vector::ZERO, |body| body.velocity_at_point(at))
    };
    let relative = velocity(manifold.data.rigid_body2) - velocity(manifold.data.rigid_body1);
    relative - manifold.data.normal * relative.dot(manifold.data.normal)
}

/// Rows whose forces add up to these in MuJoCo's cone: an elliptic one has a row for each direction, a pyramid two for each
/// tangent, whose sum is normal and whose difference is friction.
fn push_rows(
    m: &Model,
    contact: &mut Contact,
    id: usize,
    (normal, friction): (f64, Vec3),
    efc: &mut Constraints,
) {
    contact.efc_address = efc.nefc as i32;
    let tangents = [1, 2].map(|axis| dot(friction, row(&contact.frame, axis)));
    let dim = contact.dim as usize;
    if dim == 1 {
        push_applied(efc, ConstraintType::ContactFrictionless, id, contact.dist, normal);
    } else if m.opt.cone == Cone::Elliptic {
        for force in [normal, tangents[0], tangents[1], 0.0, 0.0, 0.0].into_iter().take(dim) {
            push_applied(efc, ConstraintType::ContactElliptic, id, contact.dist, force);
        }
    } else {
        let share = normal / (dim - 1) as f64;
        for k in 0..dim - 1 {
            let difference = tangents.get(k).map_or(0.0, |force| force / contact.friction[k]);
            for sign in [1.0, -1.0] {
                let force = (share + sign * difference) / 2.0;
                push_applied(efc, ConstraintType::ContactPyramidal, id, contact.dist, force);
            }
        }
    }
}
