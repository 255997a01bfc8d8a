//! Signed distance between two geoms and the segment that spans it (documentation: `mj_geomDistance`).
//!
//! ```
//! use robohive_physics::collision::distance::{DistanceScratch, geom_distance};
//! use robohive_physics::{Data, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let (floor, ball) = (model.geom("floor").ok_or("no floor")?, model.geom("ball").ok_or("no ball")?);
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let mut scratch = DistanceScratch::default();
//! let (distance, [on_floor, _]) =
//!     geom_distance(&model, &data.kin, floor.index(), ball.index(), 10.0, &mut scratch);
//! assert!((distance - 1.9).abs() < 1e-12 && on_floor == [0.0; 3]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::convex::convex_distance;
use super::pair_function;
use super::scratch::ConvexScratch;
use super::shape::PreContact;
use crate::math::{Vec3, add_scaled};
use crate::model::{Disable, GeomType, Model};
use crate::stages::Kinematics;

/// Reused memory of distance queries.
#[derive(Clone, Debug, Default)]
pub struct DistanceScratch {
    convex: ConvexScratch,
    points: Vec<PreContact>,
}

/// Signed distance between geoms `g1` and `g2` \[m\], at most `limit`, and the nearest points in the world: on `g1`, on `g2`.
/// Overlapping geoms have a negative distance; their points would meet if one geom moved by that depth.
///
/// Filters do not matter: any two geoms can be measured. Points are zeros where the geoms are farther apart than `limit`,
/// and where the pair has no distance (two planes or height fields), which is then `limit`. With native convex collision
/// disabled, convex pairs are inflated by the limit and their distance is rough, as in MuJoCo. A height field is as near as
/// the nearest prism that the limit reaches, so that a large limit is slow.
///
/// # Panics
/// An index is out of range.
pub fn geom_distance(
    m: &Model,
    kin: &Kinematics,
    g1: usize,
    g2: usize,
    limit: f64,
    scratch: &mut DistanceScratch,
) -> (f64, [Vec3; 2]) {
    let types = [m.geom_type[g1], m.geom_type[g2]];
    let flip = types[0] > types[1];
    let sorted = if flip { [types[1], types[0]] } else { types };
    let Some(function) = pair_function(sorted[0], sorted[1]) else { return (limit, [[0.0; 3]; 2]) };
    let native = !m.opt.disableflags.contains(Disable::NATIVECCD);
    if native && is_convex_pair(sorted) {
        let (dist, segment) = convex_distance(m, kin, g1, g2, limit, &mut scratch.convex);
        return (dist, segment.unwrap_or_default());
    }
    let (low, high) = if flip { (g2, g1) } else { (g1, g2) };
    scratch.points.clear();
    function(m, kin, low, high, limit, &mut scratch.convex, &mut scratch.points);
    let (mut dist, mut segment) = (limit, [[0.0; 3]; 2]);
    for point in &scratch.points {
        if point.dist < dist {
            dist = point.dist;
            let half = if flip { -0.5 * dist } else { 0.5 * dist };
            segment = [add_scaled(point.pos, point.normal, -half), add_scaled(point.pos, point.normal, half)];
        }
    }
    (dist, segment)
}

/// Pairs of types, the lower first, whose distance comes from GJK: those without an analytic pair function, and
/// boxes, whose own function finds no distance.
fn is_convex_pair([low, high]: [i32; 2]) -> bool {
    const SPHERE: i32 = GeomType::Sphere.code();
    const CAPSULE: i32 = GeomType::Capsule.code();
    const CYLINDER: i32 = GeomType::Cylinder.code();
    const BOX: i32 = GeomType::Box.code();
    match (low, high) {
        (SPHERE, SPHERE | CAPSULE | CYLINDER | BOX) | (CAPSULE, CAPSULE | BOX) => false,
        _ => low >= SPHERE,
    }
}
