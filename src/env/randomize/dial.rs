//! One thing in the look of a scene that every reset draws, and how it is written into a model.

use super::config::Pattern;
use super::texture::{Fill, fill};
use crate::draws::Rng;
use physics::math::{Quat, Vec3, add, mul_mat, norm, ops, quat_mul, quat_to_mat, scale};
use physics::model::Draft;
use physics::{Model, model::TrackMode};
use random::RandomError;

/// Most values that a dial has.
pub(super) const WIDTH: usize = 9;

/// What is written, by the number of the element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
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

/// How values are drawn.
#[derive(Clone, Debug)]
pub(super) enum Draws {
    /// Each uniform between two bounds.
    Uniform(Vec<[f64; 2]>),
    /// One with this probability, otherwise zero.
    Chance(f64),
    /// A pattern, two colours, the squares of a checker and the seed of a noise.
    Pixels { patterns: Vec<Pattern>, color: [[f64; 2]; 3], squares: [f64; 2] },
}

/// One thing that is drawn at every reset.
#[derive(Clone, Debug)]
pub(super) struct Dial {
    /// `light/NAME/pos` and the like.
    pub name: String,
    /// What the values are measured in.
    pub unit: &'static str,
    pub target: Target,
    pub draws: Draws,
}

impl Dial {
    /// How many values it has.
    pub fn width(&self) -> usize {
        match &self.draws {
            Draws::Uniform(bounds) => bounds.len(),
            Draws::Chance(_) => 1,
            Draws::Pixels { .. } => WIDTH,
        }
    }

    /// Draws its values.
    pub fn draw(&self, rng: &mut Rng, values: &mut [f64]) -> Result<(), RandomError> {
        match &self.draws {
            Draws::Uniform(bounds) => {
                for (value, [low, high]) in values.iter_mut().zip(bounds) {
                    *value = rng.uniform(*low, *high)?;
                }
            }
            Draws::Chance(probability) => values[0] = f64::from(rng.random() < *probability),
            Draws::Pixels { patterns, color, squares } => {
                values[0] = f64::from(*rng.choose(patterns)? as u8);
                for (value, [low, high]) in values[1..7].iter_mut().zip(color.iter().chain(color)) {
                    *value = rng.uniform(*low, *high)?;
                }
                values[7] = rng.uniform(squares[0], squares[1])?.round();
                values[8] = f64::from(rng.integer(0..u32::MAX)?);
            }
        }
        Ok(())
    }

    /// Writes values into a model; what they do not change looks as in `base`.
    pub fn write(&self, values: &[f64], base: &Model, m: &mut Draft<'_>) {
        let three = || [values[0], values[1], values[2]];
        let color = || std::array::from_fn(|k| values[k] as f32);
        match self.target {
            Target::TexturePixels(texture) => fill(base, texture, &Fill::of(values), &mut m.tex_data),
            Target::MaterialColor(material) => m.mat_rgba[material] = color(),
            Target::LightPosition(light) => {
                if follows(base.light_mode[light]) {
                    m.light_pos0[light] = add(base.light_pos0[light], three());
                    m.light_poscom0[light] = add(base.light_poscom0[light], three());
                } else {
                    m.light_pos[light] = add(base.light_pos[light], three());
                }
            }
            Target::LightDirection(light) => {
                if follows(base.light_mode[light]) {
                    m.light_dir0[light] = leaning(base.light_dir0[light], three());
                } else {
                    m.light_dir[light] = leaning(base.light_dir[light], three());
                }
            }
            Target::LightColor(light) => m.light_diffuse[light] = three().map(|x| x as f32),
            Target::LightOn(light) => m.light_active[light] = values[0] > 0.0,
            Target::LightShadow(light) => m.light_castshadow[light] = values[0] > 0.0,
            Target::CameraPosition(camera) => {
                if follows(base.cam_mode[camera]) {
                    m.cam_pos0[camera] = add(base.cam_pos0[camera], three());
                    m.cam_poscom0[camera] = add(base.cam_poscom0[camera], three());
                } else {
                    m.cam_pos[camera] = add(base.cam_pos[camera], three());
                }
            }
            Target::CameraTurn(camera) => {
                let turn = rotation(three());
                m.cam_quat[camera] = quat_mul(base.cam_quat[camera], turn);
                m.cam_mat0[camera] = mul_mat(&base.cam_mat0[camera], &quat_to_mat(turn));
            }
            Target::CameraFovy(camera) => m.cam_fovy[camera] = values[0],
            Target::BodyColor(body) => {
                for geom in (0..base.ngeom).filter(|&geom| base.geom_bodyid[geom] == body as i32) {
                    m.geom_rgba[geom] = color();
                }
            }
            Target::BodyPosition(body) => m.body_pos[body] = add(base.body_pos[body], three()),
            Target::BodyTurn(body) => m.body_quat[body] = quat_mul(base.body_quat[body], rotation(three())),
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

/// The quaternion of a rotation vector \[deg\].
fn rotation(degrees: Vec3) -> Quat {
    let vector = degrees.map(f64::to_radians);
    let angle = norm(vector);
    if angle == 0.0 {
        return [1.0, 0.0, 0.0, 0.0];
    }
    let (sin, cos) = ops::sincos(angle / 2.0);
    let [x, y, z] = scale(vector, sin / angle);
    [cos, x, y, z]
}
