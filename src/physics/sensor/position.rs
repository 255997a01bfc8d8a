//! Sensors that read positions.

use super::objects::{limit_row, object, reference};
use super::scratch::SensorScratch;
use super::{distance, pinhole, rangefinder, zone};
use crate::math::{column, mul_mat_t_vec, quat_conj, quat_mul, quat_normalize, sub};
use crate::model::bounds::MINVAL;
use crate::model::{ConstraintType, Model, ObjType, SensorType};
use crate::on_demand::energy;
use crate::position::frame::{self, frame};
use crate::stages::{Constraints, PositionInputs};

/// Reads sensor `i` into zeroed `out`.
pub(super) fn read(
    m: &Model,
    d: &PositionInputs,
    i: usize,
    kind: SensorType,
    scratch: &mut SensorScratch,
    out: &mut [f64],
) {
    let id = usize::try_from(m.sensor_objid[i]).unwrap_or(0);
    match kind {
        SensorType::Magnetometer => {
            out.copy_from_slice(&mul_mat_t_vec(&d.kin.site_xmat[id], m.opt.magnetic));
        }
        SensorType::Camprojection => {
            let camera = m.sensor_refid[i] as usize;
            out.copy_from_slice(&pinhole::project(m, d.kin, camera, d.kin.site_xpos[id]));
        }
        SensorType::Rangefinder => rangefinder::rangefinder(m, d.kin, i, out),
        SensorType::Jointpos => out[0] = d.state.qpos[m.jnt_qposadr[id] as usize],
        SensorType::Tendonpos => out[0] = d.ten.ten_length[id],
        SensorType::Actuatorpos => {
            let first = m.actuator_outadr[id] as usize;
            out.copy_from_slice(&d.trn.actuator_length[first..first + out.len()]);
        }
        SensorType::Ballquat => {
            let first = m.jnt_qposadr[id] as usize;
            out.copy_from_slice(&quat_normalize(std::array::from_fn(|k| d.state.qpos[first + k])));
        }
        SensorType::Jointlimitpos => out[0] = limit_distance(d.efc, ConstraintType::LimitJoint, id),
        SensorType::Tendonlimitpos => out[0] = limit_distance(d.efc, ConstraintType::LimitTendon, id),
        SensorType::Framepos | SensorType::Framexaxis | SensorType::Frameyaxis | SensorType::Framezaxis => {
            read_frame(m, d, i, kind, out);
        }
        SensorType::Framequat => read_quat(m, d, i, out),
        SensorType::Subtreecom => out.copy_from_slice(&d.com.subtree_com[id]),
        SensorType::Insidesite => out[0] = f64::from(u8::from(is_inside(m, d, i, id))),
        SensorType::Geomdist => out[0] = distance::nearest(m, d.kin, i, scratch).0,
        SensorType::Geomnormal => {
            let (_, segment) = distance::nearest(m, d.kin, i, scratch);
            out.copy_from_slice(&distance::direction(segment));
        }
        SensorType::Geomfromto => {
            let (_, segment) = distance::nearest(m, d.kin, i, scratch);
            out.copy_from_slice(segment.as_flattened());
        }
        SensorType::EPotential => out[0] = energy::potential(m, &d.configuration()),
        SensorType::EKinetic => out[0] = energy::kinetic(m, d.state, d.inertia, &mut scratch.momentum),
        SensorType::Clock => out[0] = d.state.time,
        // Users' sensors read zero; the others belong to later stages.
        _ => {}
    }
}

/// Distance to the limit less the margin; zero when the limit is not active.
fn limit_distance(efc: &Constraints, kind: ConstraintType, id: usize) -> f64 {
    limit_row(efc, kind, id).map_or(0.0, |row| efc.efc_pos[row] - efc.efc_margin[row])
}

fn read_frame(m: &Model, d: &PositionInputs, i: usize, kind: SensorType, out: &mut [f64]) {
    let (object_kind, id) = object(m, i);
    let Some(object) = frame(m, d.kin, object_kind, id) else { return };
    let base = reference(m, i).and_then(|(kind, id)| frame(m, d.kin, kind, id));
    let value = match kind {
        SensorType::Framexaxis => column(&object.mat, 0),
        SensorType::Frameyaxis => column(&object.mat, 1),
        SensorType::Framezaxis => column(&object.mat, 2),
        _ => base.map_or(object.pos, |base| sub(object.pos, base.pos)),
    };
    out.copy_from_slice(&base.map_or(value, |base| mul_mat_t_vec(&base.mat, value)));
}

fn read_quat(m: &Model, d: &PositionInputs, i: usize, out: &mut [f64]) {
    let (kind, id) = object(m, i);
    let Some(object) = frame::quat(m, d.kin, kind, id) else { return };
    let base = reference(m, i).and_then(|(kind, id)| frame::quat(m, d.kin, kind, id));
    out.copy_from_slice(&base.map_or(object, |base| quat_mul(quat_conj(base), object)));
}

/// True when the object of an `insidesite` sensor lies in its site. A body without mass of its own stands for its
/// subtree.
fn is_inside(m: &Model, d: &PositionInputs, i: usize, id: usize) -> bool {
    let (kind, _) = object(m, i);
    let Some(object) = frame(m, d.kin, kind, id) else { return false };
    let stands_for_subtree =
        kind == ObjType::Body && id > 0 && m.body_mass[id] < MINVAL && m.body_subtreemass[id] >= MINVAL;
    let point = if stands_for_subtree { d.com.subtree_com[id] } else { object.pos };
    zone::inside_site(m, d.kin, m.sensor_refid[i] as usize, point)
}
