//! A scripted person who steers a quadruped.

use env::Env;
use physics::math::{quat_conj, quat_rotate};

/// The velocity towards the site "target", as fractions of the largest: forward, to the left, counterclockwise. The robot turns to
/// where the target is ahead, and walks as far as it is.
pub fn towards_target(env: &Env) -> [f64; 3] {
    let scene = env.scene();
    let target =
        scene.model.site("target").map(|site| scene.data.kin.site_xpos[site.index()]).unwrap_or_default();
    let q = &scene.data.state.qpos;
    let way = [target[0] - q[0], target[1] - q[1], 0.0];
    let [right, ahead, _] = quat_rotate(quat_conj([q[3], q[4], q[5], q[6]]), way);
    let angle = (-right).atan2(ahead);
    [angle.cos().max(0.0), 0.0, (2.0 * angle).clamp(-1.0, 1.0)]
}
