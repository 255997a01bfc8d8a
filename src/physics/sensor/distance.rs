//! Sensors of the distance between geoms or bodies.

use super::scratch::SensorScratch;
use crate::collision::distance::geom_distance;
use crate::math::{Vec3, normalize, sub};
use crate::model::{Model, ObjType};
use crate::stages::Kinematics;

/// Distance of the nearest pair of geoms of sensor `i`, at most its cut-off, and the segment between the surfaces
/// (zero when nothing is near enough).
pub(super) fn nearest(
    m: &Model,
    kin: &Kinematics,
    i: usize,
    scratch: &mut SensorScratch,
) -> (f64, [Vec3; 2]) {
    let cutoff = m.sensor_cutoff[i];
    let mut best = (cutoff, [[0.0; 3]; 2]);
    for g1 in geoms(m, m.sensor_objtype[i], m.sensor_objid[i]) {
        for g2 in geoms(m, m.sensor_reftype[i], m.sensor_refid[i]) {
            let (dist, segment) = geom_distance(m, kin, g1, g2, cutoff, &mut scratch.distance);
            if dist < best.0 {
                best = (dist, segment);
            }
        }
    }
    best
}

/// Direction of a segment; zero for one of no length.
pub(super) fn direction(segment: [Vec3; 2]) -> Vec3 {
    let along = sub(segment[1], segment[0]);
    if along == [0.0; 3] { along } else { normalize(along).0 }
}

fn geoms(m: &Model, kind: i32, id: i32) -> std::ops::Range<usize> {
    if kind == ObjType::Body.code() {
        let first = usize::try_from(m.body_geomadr[id as usize]).unwrap_or(0);
        first..first + m.body_geomnum[id as usize] as usize
    } else {
        id as usize..id as usize + 1
    }
}
