//! How far things reach.

use super::frame::Frame;
use physics::elements::BodyId;
use physics::math::{Vec3, add_scaled, dot, mul_mat_t_vec, ops, quat_from_axis_angle};
use physics::{Data, Model};

/// The box round a body's geoms, with its x axis level: its middle, its width along x and half its height \[m\].
pub fn around(m: &Model, data: &Data, body: BodyId, yaw: f64) -> (Frame, f64, f64) {
    let along = |direction: Vec3| {
        let geoms = (0..m.ngeom).filter(|&geom| m.geom_bodyid[geom] as usize == body.index());
        let ends = |geom: usize| {
            let [x, y, z, a, b, c] = m.geom_aabb[geom];
            let local = mul_mat_t_vec(&data.kin.geom_xmat[geom], direction);
            let middle = dot(data.kin.geom_xpos[geom], direction) + dot([x, y, z], local);
            let half = dot([a, b, c], local.map(f64::abs));
            [middle - half, middle + half]
        };
        geoms.map(ends).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]).unwrap_or([0.0; 2])
    };
    let (sine, cosine) = ops::sincos(yaw);
    let axes = [[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]];
    let [x, y, z] = axes.map(along);
    let middles = [x, y, z].map(|[low, high]| 0.5 * (low + high));
    let place =
        axes.into_iter().zip(middles).fold([0.0; 3], |sum, (axis, middle)| add_scaled(sum, axis, middle));
    let turn = quat_from_axis_angle(axes[2], yaw);
    (Frame { place, turn }, x[1] - x[0], 0.5 * (z[1] - z[0]))
}
