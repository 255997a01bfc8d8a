//! Bodies that move on the ground.

use crate::draws::Rng;
use crate::error::EnvError;
use physics::Data;
use physics::elements::BodyId;
use physics::math::ops;

/// Place and heading of a body: x, y \[m\], and the angle of its x axis from the world's \[rad\].
pub fn pose(data: &Data, body: BodyId) -> [f64; 3] {
    let (place, axes) = (data.body(body).xpos(), data.body(body).xmat());
    [place[0], place[1], ops::angle(axes[3], axes[0])]
}

/// Speed of a free body along its x axis \[m/s\], and its turning about the vertical \[rad/s\]; `first` is the first of its six
/// velocities.
pub fn velocity(data: &Data, body: BodyId, first: usize) -> [f64; 2] {
    let (axes, qvel) = (data.body(body).xmat(), &data.state.qvel[first..]);
    [axes[0] * qvel[0] + axes[3] * qvel[1], qvel[5]]
}

/// Puts a free body, whose seven positions these are, at a place and heading; its height stays.
pub fn put(qpos: &mut [f64], [x, y, heading]: [f64; 3]) {
    let (sine, cosine) = ops::sincos(heading / 2.0);
    (qpos[0], qpos[1]) = (x, y);
    qpos[3..7].copy_from_slice(&[cosine, 0.0, 0.0, sine]);
}

/// Draws each value within plus and minus its bound.
pub fn spread<const N: usize>(rng: &mut Rng, bounds: [f64; N]) -> Result<[f64; N], EnvError> {
    let mut drawn = [0.0; N];
    for (value, bound) in drawn.iter_mut().zip(bounds) {
        *value = rng.uniform(-bound, bound)?;
    }
    Ok(drawn)
}

/// Whether a pose is within a distance \[m\] and an angle \[rad\] of the origin, looking along x.
pub fn at_origin([x, y, heading]: [f64; 3], [distance, angle]: [f64; 2]) -> bool {
    x * x + y * y < distance * distance && heading.abs() < angle
}
