//! Sensors that read accelerations and forces.

use super::objects::{limit_row, object};
use super::scratch::SensorScratch;
use super::{contact, tactile};
use crate::math::{Spatial, linear, move_force, rotational};
use crate::model::{ConstraintType, Model, ObjType, SensorType, TrnType};
use crate::position::frame::frame;
use crate::stages::AccelerationInputs;

/// What the pass after the solver found for every body.
pub(super) struct BodyForces<'a> {
    /// Com-based accelerations.
    pub cacc: &'a [Spatial],
    /// Com-based wrenches between a body and its parent.
    pub cfrc_int: &'a [Spatial],
}

/// Reads sensor `i` of type `kind` into zeroed `out`.
pub(super) fn read(
    m: &Model,
    d: &AccelerationInputs,
    bodies: &BodyForces,
    i: usize,
    kind: SensorType,
    scratch: &mut SensorScratch,
    out: &mut [f64],
) {
    let BodyForces { cacc, cfrc_int } = *bodies;
    let id = usize::try_from(m.sensor_objid[i]).unwrap_or(0);
    let limit_force =
        |kind: ConstraintType| limit_row(d.efc, kind, id).map_or(0.0, |row| d.efc.efc_force[row]);
    match kind {
        SensorType::Touch => out[0] = contact::touch(m, d, id),
        SensorType::Contact => contact::contact(m, d, i, &mut scratch.matches, out),
        SensorType::Tactile => tactile::tactile(m, d, i, &mut scratch.touched, out),
        SensorType::Accelerometer => {
            if let Some(at) = frame(m, d.kin, ObjType::Site, id) {
                out.copy_from_slice(&linear(&at.local_acceleration(m, d.com, &d.vel.cvel, cacc)));
            }
        }
        SensorType::Framelinacc | SensorType::Frameangacc => {
            if let Some(at) = frame(m, d.kin, object(m, i).0, id) {
                let a = at.acceleration(m, d.com, &d.vel.cvel, cacc);
                let half = if kind == SensorType::Framelinacc { linear(&a) } else { rotational(&a) };
                out.copy_from_slice(&half);
            }
        }
        SensorType::Force => out.copy_from_slice(&linear(&joint_wrench(m, d, cfrc_int, id))),
        SensorType::Torque => out.copy_from_slice(&rotational(&joint_wrench(m, d, cfrc_int, id))),
        SensorType::Actuatorfrc => {
            let first = m.actuator_outadr[id] as usize;
            out.copy_from_slice(&d.actuation.actuator_force[first..first + out.len()]);
        }
        SensorType::Jointactfrc => out[0] = d.actuation.qfrc_actuator[m.jnt_dofadr[id] as usize],
        SensorType::Tendonactfrc => out[0] = tendon_force(m, d, id),
        SensorType::Jointlimitfrc => out[0] = limit_force(ConstraintType::LimitJoint),
        SensorType::Tendonlimitfrc => out[0] = limit_force(ConstraintType::LimitTendon),
        // Users' sensors read zero; the others belong to earlier stages.
        _ => {}
    }
}

/// Wrench between the body of a site and its parent, at the site and in its orientation.
fn joint_wrench(m: &Model, d: &AccelerationInputs, cfrc_int: &[Spatial], site: usize) -> Spatial {
    let Some(at) = frame(m, d.kin, ObjType::Site, site) else { return [0.0; 6] };
    let reference = d.com.subtree_com[m.body_rootid[at.body] as usize];
    at.local(&move_force(&cfrc_int[at.body], reference, at.pos))
}

/// Sum of the forces of all actuators on a tendon.
fn tendon_force(m: &Model, d: &AccelerationInputs, tendon: usize) -> f64 {
    (0..m.nactuator)
        .filter(|&a| {
            m.actuator_trntype[a] == TrnType::Tendon.code() && m.actuator_trnid[a][0] as usize == tendon
        })
        .fold(0.0, |sum, a| sum + d.actuation.actuator_force[m.actuator_outadr[a] as usize])
}
