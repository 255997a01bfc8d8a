//! What is under the pointer.

use physics::math::{Vec3, add, add_scaled, cross, mul_mat_t_vec, normalize, scale, sub};
use physics::ray::{Ray, RayFilter, ray};
use physics::{Data, Model};
use render::View;
use render::scene::SceneOptions;

/// A geom that the pointer meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// The geom.
    pub geom: usize,
    /// Its body, the world among them.
    pub body: usize,
    /// Where it is met, world frame \[m\].
    pub point: Vec3,
    /// The same in the frame of the body \[m\].
    pub local: Vec3,
}

/// The ray from the eye through a place of the picture (documentation: programming, `mjv_select`).
///
/// `at` is measured from the lower left corner, 1 at the right and the upper edge; `aspect` is the width of the picture by its
/// height.
pub fn ray_through(view: &View, aspect: f64, at: [f64; 2]) -> Ray {
    let frustum = &view.frustum;
    let right = normalize(cross(view.forward, view.up)).0;
    let height = frustum.top - frustum.bottom;
    let half_width = frustum.half_width.unwrap_or(0.5 * aspect * height);
    let across = frustum.center + (2.0 * at[0] - 1.0) * half_width;
    let upward = frustum.bottom + at[1] * height;
    let offset = add(scale(right, across), scale(view.up, upward));
    if frustum.orthographic {
        Ray { origin: add(view.eye, offset), direction: view.forward }
    } else {
        let direction = normalize(add_scaled(offset, view.forward, frustum.near)).0;
        Ray { origin: view.eye, direction }
    }
}

/// The nearest geom at a place of the picture among those that `options` show, at the poses of the last evaluation.
pub fn pick(
    model: &Model,
    data: &Data,
    view: &View,
    options: &SceneOptions,
    aspect: f64,
    at: [f64; 2],
) -> Option<Picked> {
    let cast = ray_through(view, aspect, at);
    let filter = RayFilter {
        groups: Some(options.groups.geoms),
        skip_static: !options.show.static_bodies,
        exclude_body: None,
    };
    let (geom, hit) = ray(model, &data.kin, cast, filter)?;
    let body = model.geom_bodyid[geom] as usize;
    let point = cast.at(hit.distance);
    let local = mul_mat_t_vec(&data.kin.xmat[body], sub(point, data.kin.xpos[body]));
    Some(Picked { geom, body, point, local })
}
