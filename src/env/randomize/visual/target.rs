//! What belongs to the look of a scene, and how it is written into a model.

use super::texture::{Fill, fill};
use crate::error::EnvError;
use crate::randomize::dial::{Target, rotation, three};
use crate::scene::Scene;
use physics::Model;
use physics::math::{Vec3, add, mul_mat, norm, quat_mul, quat_to_mat, scale};
use physics::model::{Draft, TrackMode};

/// What is written, by the number of the element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Seen {
    TexturePixels(usize),
    MaterialColor(usize),
    LightPosition(usize),
    LightDirection(usize),
    LightColor(usize),
    LightOn(usize),
    LightShadow(usize),
    CameraPosition(usize),
    CameraTurn(usize),
    CameraFovy(usize),
    BodyColor(usize),
    BodyPosition(usize),
    BodyTurn(usize),
}

impl Target for Seen {
    const SETTING: &'static str = "visual_randomization";
    const STREAM: u64 = 1;

    fn change(scene: &mut Scene, write: impl FnOnce(&mut Draft<'_>)) -> Result<(), EnvError> {
        scene.overwrite(write)
    }

    fn restore(&self, _: &Model, _: &mut Draft<'_>) {}

    fn write(&self, values: &[f64], base: &Model, m: &mut Draft<'_>) {
        let color = || std::array::from_fn(|k| values[k] as f32);
        match *self {
            Seen::TexturePixels(texture) => fill(base, texture, &Fill::of(values), &mut m.tex_data),
            Seen::MaterialColor(material) => m.mat_rgba[material] = color(),
            Seen::LightPosition(light) => {
                if follows(base.light_mode[light]) {
                    m.light_pos0[light] = add(base.light_pos0[light], three(values));
                    m.light_poscom0[light] = add(base.light_poscom0[light], three(values));
                } else {
                    m.light_pos[light] = add(base.light_pos[light], three(values));
                }
            }
            Seen::LightDirection(light) => {
                if follows(base.light_mode[light]) {
                    m.light_dir0[light] = leaning(base.light_dir0[light], three(values));
                } else {
                    m.light_dir[light] = leaning(base.light_dir[light], three(values));
                }
            }
            Seen::LightColor(light) => m.light_diffuse[light] = three(values).map(|x| x as f32),
            Seen::LightOn(light) => m.light_active[light] = values[0] > 0.0,
            Seen::LightShadow(light) => m.light_castshadow[light] = values[0] > 0.0,
            Seen::CameraPosition(camera) => {
                if follows(base.cam_mode[camera]) {
                    m.cam_pos0[camera] = add(base.cam_pos0[camera], three(values));
                    m.cam_poscom0[camera] = add(base.cam_poscom0[camera], three(values));
                } else {
                    m.cam_pos[camera] = add(base.cam_pos[camera], three(values));
                }
            }
            Seen::CameraTurn(camera) => {
                let turn = rotation(three(values));
                m.cam_quat[camera] = quat_mul(base.cam_quat[camera], turn);
                m.cam_mat0[camera] = mul_mat(&base.cam_mat0[camera], &quat_to_mat(turn));
            }
            Seen::CameraFovy(camera) => m.cam_fovy[camera] = values[0],
            Seen::BodyColor(body) => {
                for geom in (0..base.ngeom).filter(|&geom| base.geom_bodyid[geom] == body as i32) {
                    m.geom_rgba[geom] = color();
                }
            }
            Seen::BodyPosition(body) => m.body_pos[body] = add(base.body_pos[body], three(values)),
            Seen::BodyTurn(body) => {
                m.body_quat[body] = quat_mul(base.body_quat[body], rotation(three(values)))
            }
        }
    }
}

/// Whether an element follows its body without turning with it, and then stands where its offsets in the world say.
fn follows(mode: i32) -> bool {
    mode == TrackMode::Track as i32 || mode == TrackMode::Trackcom as i32
}

/// A unit vector with something added; as it was where nothing is left.
fn leaning(direction: Vec3, change: Vec3) -> Vec3 {
    let changed = add(direction, change);
    let length = norm(changed);
    if length > f64::EPSILON { scale(changed, 1.0 / length) } else { direction }
}
