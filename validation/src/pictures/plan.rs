//! The list of scenes (`validation/pictures.toml`) and the bars that their pictures are held to.

use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The list as it stands in the repository.
const LISTED: &str = include_str!("../../pictures.toml");

/// The scenes, and what is asked of their pictures.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Columns and rows of the pictures.
    pub sizes: Vec<usize>,
    /// Decibels by which a picture may fall short of the noise floor.
    pub floor_margin: f64,
    /// What is asked of the listed scenes.
    pub bars: Bars,
    /// What is asked of the medians over the listed scenes.
    pub medians: Medians,
    /// The scenes.
    #[serde(rename = "scene")]
    pub scenes: Vec<SceneRow>,
}

/// Least likeness, and largest errors of depth.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Bars {
    /// Least peak signal-to-noise ratio \[dB\].
    pub psnr: f64,
    /// Least structural similarity.
    pub ssim: f64,
    /// Least peak signal-to-noise ratio without shadows \[dB\].
    pub psnr_no_shadow: f64,
    /// Least share of pixels that show the same object.
    pub ids: f64,
    /// The same over interior pixels.
    pub ids_interior: f64,
    /// Least overlap of objects.
    pub iou: f64,
    /// Largest 99th percentile of the relative error of depth.
    pub depth_p99: f64,
    /// Largest median of it.
    pub depth_median: f64,
}

/// Least medians.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Medians {
    /// Of the peak signal-to-noise ratio \[dB\].
    pub psnr: f64,
    /// Of the structural similarity.
    pub ssim: f64,
    /// Of the peak signal-to-noise ratio without shadows \[dB\].
    pub psnr_no_shadow: f64,
}

/// Which bars a scene is held to.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Held {
    /// The listed ones.
    Listed,
    /// What two OpenGL implementations reach beside each other, less a margin.
    Floor,
}

/// One scene.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneRow {
    /// Its name, and its recording's.
    pub name: String,
    /// The model file.
    pub file: String,
    /// The camera; the free one without a name.
    pub camera: Option<String>,
    /// Which bars it is held to.
    pub bars: Held,
    /// Bars that it is held to instead.
    #[serde(default)]
    pub except: BTreeMap<String, f64>,
    /// Text that is replaced in the model file.
    #[serde(default)]
    pub define: BTreeMap<String, String>,
    /// The geom of a height field that is raised and filled.
    pub terrain: Option<String>,
    /// Effects that it is drawn with.
    #[serde(default)]
    pub effects: Vec<Effect>,
    /// Why its picture differs as it does.
    pub note: Option<String>,
}

/// An effect that pictures have only where they are asked for it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// Outlines instead of surfaces.
    Wireframe,
    /// Transparent items are added.
    Additive,
    /// Backs of surfaces are drawn.
    NoCulling,
}

impl Plan {
    /// The plan of the repository.
    ///
    /// # Errors
    /// It is not as this program reads it.
    pub fn listed() -> Result<Self, String> {
        toml::from_str(LISTED).map_err(|error| format!("validation/pictures.toml: {error}"))
    }

    /// The listed bars with the exceptions of a scene.
    ///
    /// # Errors
    /// An exception is no bar.
    pub fn bars_of(&self, scene: &SceneRow) -> Result<Bars, String> {
        let mut bars = self.bars;
        for (name, value) in &scene.except {
            let bar = match name.as_str() {
                "psnr" => &mut bars.psnr,
                "ssim" => &mut bars.ssim,
                "psnr_no_shadow" => &mut bars.psnr_no_shadow,
                "ids" => &mut bars.ids,
                "ids_interior" => &mut bars.ids_interior,
                "iou" => &mut bars.iou,
                "depth_p99" => &mut bars.depth_p99,
                "depth_median" => &mut bars.depth_median,
                _ => return Err(format!("validation/pictures.toml: {}: {name} is no bar", scene.name)),
            };
            *bar = *value;
        }
        Ok(bars)
    }
}

impl SceneRow {
    /// The model is one of RoboHive's.
    pub fn is_of_robohive(&self) -> bool {
        ["envs/", "simhive/"].iter().any(|folder| self.file.starts_with(folder))
    }

    /// The model is one of this repository.
    pub fn is_own(&self) -> bool {
        ["assets/", "validation/"].iter().any(|folder| self.file.starts_with(folder))
    }

    /// The model file: of this repository, or below the folder of other models.
    pub fn path(&self, models: Option<&Path>) -> PathBuf {
        let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        models.filter(|_| !self.is_own()).unwrap_or(&own).join(&self.file)
    }
}
