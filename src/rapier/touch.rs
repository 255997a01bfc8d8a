//! Contacts that rapier solved, as contacts and constraint rows of a `Data`, for sensors and observations.

use crate::convert::array;
use crate::rules::{Geoms, mixture};
use physics::collision::PreContact;
use physics::data::{Constraints, Contact};
use physics::math::{Vec3, dot, row, scale};
use physics::model::{Cone, ConstraintState, ConstraintType};
use physics::{Data, Model};
use rapier3d_f64::prelude::{ContactManifold, NarrowPhase, RigidBodySet};

/// Where rapier has contacts and what they are between.
#[derive(Clone, Copy)]
pub(crate) struct Found<'a> {
    pub narrow_phase: &'a NarrowPhase,
    pub bodies: &'a RigidBodySet,
    pub geoms: &'a Geoms,
}

/// Writes the contacts of the last step of `dt` seconds between geoms of a model, and their forces as rows after those of other
/// constraints.
pub(crate) fn write(m: &Model, found: Found<'_>, dt: f64, d: &mut Data) {
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
            for touch in points(found.bodies, manifold) {
                let point = PreContact { dist: touch.dist, pos: touch.pos, normal, tangent: [0.0; 3] };
                let mut contact = mixture.contact(ids, &point);
                // Rapier looks ahead; what neither touches nor was held off is no contact of MuJoCo's.
                if touch.dist > contact.includemargin && touch.normal == 0.0 {
                    continue;
                }
                if touch.normal > 0.0 {
                    let friction = scale(touch.friction, sign / dt);
                    push_rows(m, &mut contact, con.contact.len(), (touch.normal / dt, friction), efc);
                }
                con.contact.push(contact);
            }
        }
    }
}

/// One point of contact.
struct Touch {
    pos: Vec3,
    dist: f64,
    /// Impulse along the normal over the whole step \[N s\].
    normal: f64,
    /// Impulse of friction on the second body, in the world \[N s\].
    friction: Vec3,
}

fn points<'a>(bodies: &'a RigidBodySet, manifold: &'a ContactManifold) -> impl Iterator<Item = Touch> + 'a {
    manifold.data.solver_contacts.iter().filter_map(move |contact| {
        let [id] = contact.contact_indices();
        let data = &manifold.points.get(id as usize)?.data;
        let (p1, p2) = manifold.data.solver_contact_world_points(contact, bodies);
        // Rapier keeps friction in the world for the last of its iterations alone, and its size for the whole step.
        let size = data.tangent_impulse.norm();
        let direction = data.warmstart_tangent_world.normalize_or_zero();
        Some(Touch {
            pos: array((p1 + p2) / 2.0),
            dist: contact.dist,
            normal: data.impulse,
            friction: array(direction * size),
        })
    })
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
        push(efc, ConstraintType::ContactFrictionless, id, contact.dist, normal);
    } else if m.opt.cone == Cone::Elliptic {
        for force in [normal, tangents[0], tangents[1], 0.0, 0.0, 0.0].into_iter().take(dim) {
            push(efc, ConstraintType::ContactElliptic, id, contact.dist, force);
        }
    } else {
        let share = normal / (dim - 1) as f64;
        for k in 0..dim - 1 {
            let difference = tangents.get(k).map_or(0.0, |force| force / contact.friction[k]);
            for sign in [1.0, -1.0] {
                let force = (share + sign * difference) / 2.0;
                push(efc, ConstraintType::ContactPyramidal, id, contact.dist, force);
            }
        }
    }
}

/// A row that has a force and acts on nothing: rapier has done that.
fn push(efc: &mut Constraints, kind: ConstraintType, id: usize, dist: f64, force: f64) {
    efc.efc_type.push(kind.code());
    efc.efc_id.push(id as i32);
    efc.efc_J_rownnz.push(0);
    efc.efc_J_rowadr.push(efc.efc_J.len() as i32);
    efc.efc_pos.push(dist);
    efc.efc_state.push(ConstraintState::Quadratic.code());
    efc.efc_KBIP.push([0.0; 4]);
    for values in [
        &mut efc.efc_margin,
        &mut efc.efc_frictionloss,
        &mut efc.efc_diagA,
        &mut efc.efc_D,
        &mut efc.efc_R,
        &mut efc.efc_vel,
        &mut efc.efc_aref,
        &mut efc.efc_b,
    ] {
        values.push(0.0);
    }
    efc.efc_force.push(force);
    efc.nefc += 1;
}
