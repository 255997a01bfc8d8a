//! Volumes of sites that act as sensor zones.

use crate::math::{Vec3, clip, dot, mul_mat_t_vec, sub};
use crate::model::{GeomType, Model};
use crate::stages::Kinematics;

/// True when `point` lies inside the volume of `site`.
pub(super) fn inside_site(m: &Model, kin: &Kinematics, site: usize, point: Vec3) -> bool {
    let offset = sub(point, kin.site_xpos[site]);
    let (p, size) = (mul_mat_t_vec(&kin.site_xmat[site], offset), m.site_size[site]);
    let radial = p[0] * p[0] + p[1] * p[1];
    match GeomType::from_code(m.site_type[site]) {
        Some(GeomType::Sphere) => dot(offset, offset) < size[0] * size[0],
        Some(GeomType::Capsule) => {
            let beyond = p[2] - clip(p[2], [-size[1], size[1]]);
            radial + beyond * beyond < size[0] * size[0]
        }
        Some(GeomType::Ellipsoid) => (0..3).fold(0.0, |sum, k| sum + p[k] * p[k] / (size[k] * size[k])) < 1.0,
        Some(GeomType::Cylinder) => p[2].abs() < size[1] && radial < size[0] * size[0],
        Some(GeomType::Box) => (0..3).all(|k| p[k].abs() < size[k]),
        Some(GeomType::Plane) => p[2] < 0.0,
        Some(GeomType::Mesh | GeomType::Hfield | GeomType::Sdf | GeomType::None) | None => false,
    }
}
