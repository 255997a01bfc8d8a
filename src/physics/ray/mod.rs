//! Nearest surface along a ray (documentation: programming, `mj_ray`).
//!
//! [`ray`] finds the nearest geom, [`multi_ray`] does so for many rays from one point, [`ray_geom`] meets one geom, and
//! [`ray_shape`] a shape that is no geom. A direction of no length, or one that is not a number, hits nothing.
//!
//! Every shape is met in its own frame. A ray `origin + x · direction` is not normalised: distances count in
//! lengths of `direction`.
//!
//! ```
//! use robohive_physics::ray::{Ray, RayFilter};
//! use robohive_physics::{Data, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let down = Ray { origin: [0.0, 0.0, 3.0], direction: [0.0, 0.0, -1.0] };
//! let (geom, hit) = data.cast_ray(&model, down, RayFilter::default()).ok_or("nothing")?;
//! assert_eq!(model.geom(geom).name(), "ball");
//! assert!((hit.distance - 0.9).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod hfield;
mod hit;
mod mesh;
mod primitive;
mod sdf;

pub use hit::{Hit, Ray};

use crate::math::{Mat3, Vec3, distance, normalize, sub};
use crate::model::{GeomType, Model};
use crate::stages::Kinematics;

/// Which geoms a ray can hit. Invisible geoms (alpha zero) are never hit.
#[derive(Clone, Copy, Debug, Default)]
pub struct RayFilter {
    /// Geom groups that can be hit; `None` for all.
    pub groups: Option<[bool; 6]>,
    /// Passes through geoms of static bodies.
    pub skip_static: bool,
    /// Body whose geoms are passed through.
    pub exclude_body: Option<usize>,
}

/// Nearest visible geom that `ray` hits, and where.
pub fn ray(m: &Model, kin: &Kinematics, ray: Ray, filter: RayFilter) -> Option<(usize, Hit)> {
    nearest(m, kin, (0..m.ngeom).filter(|&g| passes(m, g, filter)), ray)
}

/// Nearest visible geom that each ray from `origin` hits, and where. Rays pass through geoms whose bounding spheres are
/// farther away than `cutoff`; with `f64::INFINITY` through none.
pub fn multi_ray(
    m: &Model,
    kin: &Kinematics,
    origin: Vec3,
    directions: &[Vec3],
    filter: RayFilter,
    cutoff: f64,
) -> Vec<Option<(usize, Hit)>> {
    let bounded = |g: usize| m.body_bvhadr[m.geom_bodyid[g] as usize] >= 0;
    let near = |g: usize| !(bounded(g) && distance(kin.geom_xpos[g], origin) > cutoff + m.geom_rbound[g]);
    let candidates: Vec<usize> = (0..m.ngeom).filter(|&g| passes(m, g, filter) && near(g)).collect();
    let cast = |&direction: &Vec3| nearest(m, kin, candidates.iter().copied(), Ray { origin, direction });
    directions.iter().map(cast).collect()
}

/// Nearest of `geoms` that `ray` hits; the first of those equally far.
fn nearest(
    m: &Model,
    kin: &Kinematics,
    geoms: impl Iterator<Item = usize>,
    ray: Ray,
) -> Option<(usize, Hit)> {
    let mut best: Option<(usize, Hit)> = None;
    for geom in geoms {
        if let Some(hit) = ray_geom(m, kin, geom, ray)
            && best.is_none_or(|(_, b)| hit.distance < b.distance)
        {
            best = Some((geom, hit));
        }
    }
    best
}

/// Where `ray` hits geom `geom`, visible or not.
///
/// # Panics
/// The index is out of range.
pub fn ray_geom(m: &Model, kin: &Kinematics, geom: usize, ray: Ray) -> Option<Hit> {
    let (pos, mat, size) = (kin.geom_xpos[geom], &kin.geom_xmat[geom], m.geom_size[geom]);
    let data = usize::try_from(m.geom_dataid[geom]).ok();
    match (GeomType::from_code(m.geom_type[geom])?, data) {
        (GeomType::Mesh, Some(mesh)) => {
            let local = ray.local(pos, mat);
            primitive::cuboid(size, local).and_then(|_| mesh::mesh(m, mesh, local)).map(|hit| hit.global(mat))
        }
        (GeomType::Sdf, _) => {
            let local = ray.local(pos, mat);
            primitive::cuboid(size, local).and_then(|_| sdf::field(m, geom, local)).map(|hit| hit.global(mat))
        }
        (GeomType::Hfield, Some(field)) => hfield::hfield(m, field, ray, pos, mat).map(|hit| hit.global(mat)),
        (shape, _) => ray_shape(shape, size, pos, mat, ray),
    }
}

/// Where `ray` hits a primitive shape of half-sizes `size` at a pose; `None` for shapes that need more data.
pub fn ray_shape(shape: GeomType, size: Vec3, pos: Vec3, mat: &Mat3, ray: Ray) -> Option<Hit> {
    if shape == GeomType::Sphere {
        // Without orientation, so that rounding does not depend on it.
        let hit = primitive::sphere(size[0] * size[0], Ray { origin: sub(ray.origin, pos), ..ray })?;
        let normal = normalize(sub(ray.at(hit.distance), pos)).0;
        return Some(Hit { distance: hit.distance, normal });
    }
    let local = ray.local(pos, mat);
    let hit = match shape {
        GeomType::Plane => primitive::plane(size, local),
        GeomType::Capsule => primitive::capsule(size, local),
        GeomType::Ellipsoid => primitive::ellipsoid(size, local),
        GeomType::Cylinder => primitive::cylinder(size, local),
        GeomType::Box => primitive::cuboid(size, local),
        _ => None,
    };
    hit.map(|hit| hit.global(mat))
}

fn passes(m: &Model, geom: usize, filter: RayFilter) -> bool {
    let body = m.geom_bodyid[geom] as usize;
    let alpha = match usize::try_from(m.geom_matid[geom]) {
        Ok(material) => m.mat_rgba[material][3],
        Err(_) => m.geom_rgba[geom][3],
    };
    let group = m.geom_group[geom].clamp(0, 5) as usize;
    filter.exclude_body != Some(body)
        && alpha != 0.0
        && !(filter.skip_static && m.body_weldid[body] == 0)
        && filter.groups.is_none_or(|groups| groups[group])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{add_scaled, dot, norm};

    const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

    /// Implicit function of each solid, negative inside.
    fn outside(shape: GeomType, s: Vec3, p: Vec3) -> f64 {
        let radial = p[0].hypot(p[1]);
        match shape {
            GeomType::Sphere => norm(p) - s[0],
            GeomType::Capsule => radial.hypot(p[2] - p[2].clamp(-s[1], s[1])) - s[0],
            GeomType::Ellipsoid => norm([p[0] / s[0], p[1] / s[1], p[2] / s[2]]) - 1.0,
            GeomType::Cylinder => (radial - s[0]).max(p[2].abs() - s[1]),
            _ => (0..3).map(|k| p[k].abs() - s[k]).fold(f64::MIN, f64::max),
        }
    }

    #[test]
    fn rays_end_on_the_first_surface_and_see_it_from_outside() {
        let shapes =
            [GeomType::Sphere, GeomType::Capsule, GeomType::Ellipsoid, GeomType::Cylinder, GeomType::Box];
        let (size, origin) = ([0.3, 0.5, 0.4], [1.0, -0.7, 0.9]);
        for shape in shapes {
            let mut hits = 0;
            for k in 0..400 {
                let target = [
                    0.013 * f64::from(k % 20) - 0.13,
                    0.021 * f64::from(k / 20) - 0.2,
                    0.002 * f64::from(k) - 0.4,
                ];
                let ray = Ray { origin, direction: sub(target, origin) };
                let march =
                    (0..4000).map(|i| f64::from(i) * 5e-4).find(|&x| outside(shape, size, ray.at(x)) <= 0.0);
                match ray_shape(shape, size, [0.0; 3], &UPRIGHT, ray) {
                    Some(hit) => {
                        hits += 1;
                        let surface = add_scaled(origin, ray.direction, hit.distance);
                        assert!(outside(shape, size, surface).abs() < 1e-12, "{shape:?}");
                        assert!(march.is_none_or(|x| (x - hit.distance).abs() < 6e-4), "{shape:?}");
                        assert!(
                            dot(hit.normal, ray.direction) < 0.0 && (norm(hit.normal) - 1.0).abs() < 1e-12
                        );
                    }
                    None => assert_eq!(march, None, "{shape:?}"),
                }
            }
            assert!(hits > 100, "{shape:?} {hits}");
        }
    }

    #[test]
    fn directions_without_length_hit_nothing() {
        let solids = [
            GeomType::Plane,
            GeomType::Sphere,
            GeomType::Capsule,
            GeomType::Ellipsoid,
            GeomType::Cylinder,
            GeomType::Box,
        ];
        for origin in [[0.0; 3], [0.0, 0.0, 2.0]] {
            let cast =
                |shape, direction| ray_shape(shape, [0.5; 3], [0.0; 3], &UPRIGHT, Ray { origin, direction });
            for shape in solids {
                assert_eq!(cast(shape, [0.0; 3]), None, "{shape:?}");
                assert_eq!(cast(shape, [f64::NAN; 3]), None, "{shape:?}");
                assert!(origin[2] == 0.0 || cast(shape, [0.0, 0.0, -1.0]).is_some(), "{shape:?}");
            }
        }
    }
}
