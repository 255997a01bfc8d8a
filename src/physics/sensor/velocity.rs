//! Sensors that read velocities.

use super::objects::{limit_row, object, reference};
use crate::math::{Spatial, Vec3, add, cross, linear, rotational, spatial, sub};
use crate::model::{ConstraintType, Model, ObjType, SensorType};
use crate::position::frame::frame;
use crate::stages::VelocityInputs;

/// Reads sensor `i` into zeroed `out`. `subtree` holds the linear velocity and angular momentum of all subtrees.
pub(super) fn read(
    m: &Model,
    d: &VelocityInputs,
    subtree: [&[Vec3]; 2],
    i: usize,
    kind: SensorType,
    out: &mut [f64],
) {
    let id = usize::try_from(m.sensor_objid[i]).unwrap_or(0);
    let limit_velocity =
        |kind: ConstraintType| limit_row(d.efc, kind, id).map_or(0.0, |row| d.efc.efc_vel[row]);
    match kind {
        SensorType::Velocimeter => out.copy_from_slice(&linear(&site_velocity(m, d, id))),
        SensorType::Gyro => out.copy_from_slice(&rotational(&site_velocity(m, d, id))),
        SensorType::Jointvel => out[0] = d.state.qvel[m.jnt_dofadr[id] as usize],
        SensorType::Tendonvel => out[0] = d.vel.ten_velocity[id],
        SensorType::Actuatorvel => {
            let first = m.actuator_outadr[id] as usize;
            out.copy_from_slice(&d.vel.actuator_velocity[first..first + out.len()]);
        }
        SensorType::Ballangvel => {
            let first = m.jnt_dofadr[id] as usize;
            out.copy_from_slice(&d.state.qvel[first..first + 3]);
        }
        SensorType::Jointlimitvel => out[0] = limit_velocity(ConstraintType::LimitJoint),
        SensorType::Tendonlimitvel => out[0] = limit_velocity(ConstraintType::LimitTendon),
        SensorType::Framelinvel => out.copy_from_slice(&linear(&frame_velocity(m, d, i))),
        SensorType::Frameangvel => out.copy_from_slice(&rotational(&frame_velocity(m, d, i))),
        SensorType::Subtreelinvel => out.copy_from_slice(&subtree[0][id]),
        SensorType::Subtreeangmom => out.copy_from_slice(&subtree[1][id]),
        // Users' sensors read zero; the others belong to other stages.
        _ => {}
    }
}

/// Velocity of a site in its own orientation.
fn site_velocity(m: &Model, d: &VelocityInputs, site: usize) -> Spatial {
    let at = frame(m, d.kin, ObjType::Site, site);
    at.map_or([0.0; 6], |at| at.local(&at.velocity(m, d.com, &d.vel.cvel)))
}

/// Velocity of the object, seen from its turning reference frame if it has one.
fn frame_velocity(m: &Model, d: &VelocityInputs, i: usize) -> Spatial {
    let (kind, id) = object(m, i);
    let Some(at) = frame(m, d.kin, kind, id) else { return [0.0; 6] };
    let v = at.velocity(m, d.com, &d.vel.cvel);
    let Some(base) = reference(m, i).and_then(|(kind, id)| frame(m, d.kin, kind, id)) else { return v };
    let u = base.velocity(m, d.com, &d.vel.cvel);
    let turning = cross(sub(at.pos, base.pos), rotational(&u));
    let relative = add(sub(linear(&v), linear(&u)), turning);
    base.local(&spatial(sub(rotational(&v), rotational(&u)), relative))
}
