//! A ray that meets a signed distance field, by steps as long as the distance (Hart 1996, "Sphere tracing").

use super::hit::{LocalHit, Ray};
use crate::collision::sdf::Distance;
use crate::math::{add_scaled, normalize};
use crate::model::Model;

/// Most steps.
const STEPS: usize = 40;
/// A point as near as this lies on the surface \[m\].
const NEAR: f64 = 1e-7;
/// Beyond this the ray has passed \[m\].
const FAR: f64 = 1e6;

/// Where `ray`, in the frame of geom `g`, first meets its field. Unlike all others, the distance is in metres whatever the
/// length of the direction, as in MuJoCo.
pub(super) fn field(m: &Model, g: usize, ray: Ray) -> Option<LocalHit> {
    let field = Distance::of(m, g)?;
    let (direction, _) = normalize(ray.direction);
    let mut total = 0.0;
    for _ in 0..STEPS {
        let step = field.at(add_scaled(ray.origin, direction, total)).abs();
        total += step;
        if step < NEAR {
            let normal = field.gradient(add_scaled(ray.origin, direction, total));
            return Some(LocalHit { distance: total, normal });
        }
        if step > FAR {
            return None;
        }
    }
    None
}
