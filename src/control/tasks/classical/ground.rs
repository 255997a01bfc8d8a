//! Where bodies stand on the ground.

use env::Env;
use physics::elements::BodyId;
use physics::math::ops;

/// Place and heading of a body: x, y \[m\], and the angle of its x axis from the world's \[rad\].
pub fn pose(env: &Env, body: BodyId) -> [f64; 3] {
    let data = &env.scene().data;
    let (place, axes) = (data.body(body).xpos(), data.body(body).xmat());
    [place[0], place[1], ops::angle(axes[3], axes[0])]
}
