//! What a configuration says about the look of a scene: the setting `visual_randomization` of an environment.

use crate::draws::Ranges;
use serde::Deserialize;

/// What changes in the look of a scene at every reset. Off, and empty, unless an environment sets it.
///
/// ```toml
/// [visual_randomization]
/// textures = [{ names = ["wood*"], patterns = ["checker", "noise"], colors = { low = [0, 0, 0], high = [1, 1, 1] } }]
/// materials = [{ rgba = { low = [0.2, 0.2, 0.2, 1], high = [0.9, 0.9, 0.9, 1] } }]
/// lights = [{ pos = { low = [-1, -1, 0], high = [1, 1, 0.5] }, on = 0.8, shadow = 0.5 }]
/// cameras = [{ names = ["front"], turn = { low = [-3, -3, -3], high = [3, 3, 3] }, fovy = { low = [40], high = [50] } }]
/// distractors = [{ names = ["cup"], rgba = { low = [0, 0, 0, 1], high = [1, 1, 1, 1] } }]
/// ```
///
/// `names` are names of the model's elements, where a `*` at the end stands for any ending; without `names` all elements of
/// the kind are meant, those without a name too. Of each entry, only what is given changes; an element that several entries
/// name follows the last of them.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VisualRandomization {
    /// Pixels of textures.
    pub textures: Vec<TextureRange>,
    /// Colours of materials.
    pub materials: Vec<MaterialRange>,
    /// Lights.
    pub lights: Vec<LightRange>,
    /// Cameras of the model.
    pub cameras: Vec<CameraRange>,
    /// Bodies that are there to be seen and touch nothing.
    pub distractors: Vec<DistractorRange>,
}

/// What replaces the pixels of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Pattern {
    /// One colour.
    Color,
    /// Squares of two colours.
    Checker,
    /// From one colour at the top to another at the bottom.
    Gradient,
    /// Every pixel its own mixture of two colours.
    Noise,
}

impl Pattern {
    /// All of them, in the order of their numbers.
    pub const ALL: [Pattern; 4] = [Pattern::Color, Pattern::Checker, Pattern::Gradient, Pattern::Noise];
}

/// Textures, and what their pixels are replaced by.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextureRange {
    /// Names of textures.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// Patterns to draw one from.
    #[serde(default = "all_patterns")]
    pub patterns: Vec<Pattern>,
    /// Red, green and blue of both colours, 0 to 1.
    #[serde(default = "all_colors")]
    pub colors: Ranges<3>,
    /// Squares of a checker along a side.
    #[serde(default = "squares")]
    pub squares: Ranges<1>,
}

/// Materials, and their colours.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialRange {
    /// Names of materials.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// Red, green, blue and opacity, 0 to 1.
    pub rgba: Ranges<4>,
}

/// Lights.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightRange {
    /// Names of lights.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// What is added to the position \[m\]: in the frame of the light's body, or in the world's if the light follows it.
    #[serde(default)]
    pub pos: Option<Ranges<3>>,
    /// What is added to the unit vector of its direction.
    #[serde(default)]
    pub dir: Option<Ranges<3>>,
    /// Red, green and blue of its diffuse light, 0 to 1.
    #[serde(default)]
    pub diffuse: Option<Ranges<3>>,
    /// Probability that it is on.
    #[serde(default)]
    pub on: Option<f64>,
    /// Probability that it casts shadows.
    #[serde(default)]
    pub shadow: Option<f64>,
}

/// Cameras.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraRange {
    /// Names of cameras.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// What is added to the position \[m\]: in the frame of the camera's body, or in the world's if the camera follows it.
    #[serde(default)]
    pub pos: Option<Ranges<3>>,
    /// Rotation vector about the camera's own axes: right, up, backwards \[deg\]. A camera that targets a body turns towards
    /// it whatever this says.
    #[serde(default)]
    pub turn: Option<Ranges<3>>,
    /// Vertical field of view \[deg\].
    #[serde(default)]
    pub fovy: Option<Ranges<1>>,
}

/// Bodies that touch nothing and do not move.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DistractorRange {
    /// Names of bodies.
    pub names: Vec<String>,
    /// Red, green, blue and opacity of all their geoms, 0 to 1.
    #[serde(default)]
    pub rgba: Option<Ranges<4>>,
    /// What is added to the position in the parent \[m\].
    #[serde(default)]
    pub pos: Option<Ranges<3>>,
    /// Rotation vector about the body's own axes \[deg\].
    #[serde(default)]
    pub turn: Option<Ranges<3>>,
}

fn all_patterns() -> Vec<Pattern> {
    Pattern::ALL.to_vec()
}

fn all_colors() -> Ranges<3> {
    Ranges { low: [0.0; 3], high: [1.0; 3] }
}

fn squares() -> Ranges<1> {
    Ranges { low: [2.0], high: [16.0] }
}
