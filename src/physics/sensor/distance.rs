//! Sensors of the distance between geoms or bodies.

use super::SensorScratch;
use crate::collision::convex::convex_distance;
use crate::collision::pair_function;
use crate::data::Kinematics;
use crate::math::{Vec3, add_scaled, normalize, sub};
use crate::model::{GeomType, Model, ObjType};

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
            let (dist, segment) = geom_distance(m, kin, [g1, g2], cutoff, scratch);
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

/// Signed distance of two geoms, at most `limit`, and the segment from the first to the second.
pub fn geom_distance(
    m: &Model,
    kin: &Kinematics,
    geoms: [usize; 2],
    limit: f64,
    scratch: &mut SensorScratch,
) -> (f64, [Vec3; 2]) {
    let flip = m.geom_type[geoms[0]] > m.geom_type[geoms[1]];
    let [g1, g2] = if flip { [geoms[1], geoms[0]] } else { geoms };
    let Some(function) = pair_function(m.geom_type[g1], m.geom_type[g2]) else {
        return (limit, [[0.0; 3]; 2]);
    };
    if is_convex_pair(m.geom_type[g1], m.geom_type[g2]) {
        let (dist, segment) = convex_distance(m, kin, geoms[0], geoms[1], limit, &mut scratch.convex);
        return (dist, segment.unwrap_or_default());
    }
    scratch.points.clear();
    function(m, kin, g1, g2, limit, &mut scratch.convex, &mut scratch.points);
    let sign = if flip { -0.5 } else { 0.5 };
    let mut best = (limit, [[0.0; 3]; 2]);
    for p in &scratch.points {
        if p.dist < best.0 {
            let half = sign * p.dist;
            best = (p.dist, [add_scaled(p.pos, p.normal, -half), add_scaled(p.pos, p.normal, half)]);
        }
    }
    best
}

/// True for pairs, lower type first, whose distance the general convex algorithm measures: those without a function
/// of their own, and two boxes.
fn is_convex_pair(type1: i32, type2: i32) -> bool {
    use GeomType::{Box, Capsule, Cylinder, Sphere};
    let own_function = matches!(
        (GeomType::from_code(type1), GeomType::from_code(type2)),
        (Some(GeomType::Plane | GeomType::Hfield), _)
            | (Some(Sphere), Some(Sphere | Capsule | Cylinder | Box))
            | (Some(Capsule), Some(Capsule | Box))
    );
    !own_function
}
