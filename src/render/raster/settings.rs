//! How finely a renderer draws.

use super::shadow::ShadowSettings;
use physics::Model;

/// How finely a renderer draws; what a model says in `visual/quality` and `visual/map`. Numbers beyond the limits given here
/// count as the limits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// Samples of a pixel: 4, or 1.
    pub samples: Samples,
    /// Shadow maps.
    pub shadow: ShadowSettings,
    /// Slices of the sky, 3 to 1024.
    pub slices: usize,
    /// Width of lines \[pixel\].
    pub line_width: f32,
    /// What stands still in a view is kept from picture to picture. The pictures are the same without.
    pub keep: bool,
}

/// Samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    /// In the middle.
    One,
    /// At OpenGL's four standard places.
    Four,
}

/// Largest shadow map [texel]: positions in it are kept in 16 bits, and its edge functions in 64.
const MAX_SHADOW: usize = 8192;
/// Most slices of the sky.
const MAX_SLICES: usize = 1024;

impl Default for Settings {
    /// Those of a model that sets none, but for shadows, which need the model's extent.
    fn default() -> Self {
        Settings {
            samples: Samples::Four,
            shadow: ShadowSettings { size: 0, clip: 0.0, scale: 0.0 },
            slices: 28,
            line_width: 1.0,
            keep: true,
        }
    }
}

impl Settings {
    /// Samples of a pixel.
    #[must_use]
    pub fn with_samples(mut self, samples: Samples) -> Self {
        self.samples = samples;
        self
    }

    /// Shadow maps.
    #[must_use]
    pub fn with_shadow(mut self, shadow: ShadowSettings) -> Self {
        self.shadow = shadow;
        self
    }

    /// Slices of the sky, 3 to 1024.
    #[must_use]
    pub fn with_slices(mut self, slices: usize) -> Self {
        self.slices = slices;
        self
    }

    /// Width of lines \[pixel\].
    #[must_use]
    pub fn with_line_width(mut self, line_width: f32) -> Self {
        self.line_width = line_width;
        self
    }

    /// Whether what stands still in a view is kept from picture to picture.
    #[must_use]
    pub fn with_keep(mut self, keep: bool) -> Self {
        self.keep = keep;
        self
    }

    /// The settings of a model. `offsamples` of 2 or more are four samples; a `shadowsize` of 0 is no shadow.
    pub fn of(model: &Model) -> Self {
        let (quality, map) = (&model.vis.quality, &model.vis.map);
        Settings {
            samples: if quality.offsamples > 1 { Samples::Four } else { Samples::One },
            shadow: ShadowSettings {
                size: quality.shadowsize.max(0) as usize,
                clip: (f64::from(map.shadowclip) * model.stat.extent) as f32,
                scale: map.shadowscale,
            },
            slices: quality.numslices.max(3) as usize,
            line_width: model.vis.global.linewidth,
            keep: true,
        }
        .within_limits()
    }

    /// The same with every number in its range.
    pub(super) fn within_limits(&self) -> Self {
        let size = self.shadow.size.min(MAX_SHADOW);
        Settings {
            shadow: ShadowSettings { size, ..self.shadow },
            slices: self.slices.clamp(3, MAX_SLICES),
            ..*self
        }
    }
}
