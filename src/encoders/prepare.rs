//! From a picture to the numbers that a network sees: 3 × 224 × 224, channel by channel.
//!
//! Resizing brings the shorter side to 256 pixels; of the result the central 224 × 224 remain. Channels are then scaled and
//! shifted by the mean and deviation of ImageNet.
//!
//! | encoder | [`Profile::Fixed`] | [`Profile::RoboHive07`] |
//! |---|---|---|
//! | `r3m*` | 224 × 224 as it is, else bilinear on bytes; 0 to 1, normalised | the same |
//! | `rrl*` | the same | normalised, then times 255 |
//! | `vc1*` | bicubic on bytes, at 224 × 224 too; 0 to 1, normalised | bicubic on numbers; 0 to 255, normalised as if 0 to 1 |
//!
//! For `r3m*` and `rrl*` at other sizes than 224 × 224 RoboHive 0.7 stops, because it hands torchvision an array where a
//! picture is expected; here the resizing that it names is done in both profiles.
//!
//! Source: RoboHive 0.7, `env_base.py`; torchvision 0.29, `transforms`; R3M, `models_r3m.py`; VC-1, `vit_transforms`.

use crate::encoding::Encoding;
use crate::picture::Picture;
use crate::resample::{self, Filter, Window};

/// Pixels of each side of what a network sees.
pub const SIDE: usize = 224;

/// Pixels of the shorter side after resizing.
const RESIZED: usize = 256;

/// Mean of red, green and blue over ImageNet, where white is 1.
const MEAN: [f32; 3] = [0.485, 0.456, 0.406];
/// Deviation from it.
const DEVIATION: [f32; 3] = [0.229, 0.224, 0.225];

/// Whose preprocessing is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Profile {
    /// That with which the networks were trained.
    #[default]
    Fixed,
    /// RoboHive 0.7's, for policies that were trained on what it gives.
    RoboHive07,
}

/// The numbers that the network of `encoding` sees of a picture: 3 × [`SIDE`] × [`SIDE`].
pub fn prepare(encoding: Encoding, profile: Profile, picture: &Picture<'_>) -> Vec<f32> {
    let [rows, columns] = windows(picture);
    let whole = picture.height() == SIDE && picture.width() == SIDE;
    match (encoding, profile) {
        (Encoding::Vc1(_), Profile::RoboHive07) => {
            let numbers = resample::numbers(picture, Filter::Bicubic, rows, columns);
            by_channel(&numbers, normalised)
        }
        (Encoding::Vc1(_), Profile::Fixed) => {
            let bytes = resample::bytes(picture, Filter::Bicubic, rows, columns);
            by_channel(&bytes, |byte, channel| normalised(unit(byte), channel))
        }
        (Encoding::Rrl(_), _) => {
            let gain = if profile == Profile::RoboHive07 { 255.0 } else { 1.0 };
            let value = |byte, channel| gain * normalised(unit(byte), channel);
            if whole {
                by_channel(picture.pixels(), value)
            } else {
                by_channel(&resample::bytes(picture, Filter::Bilinear, rows, columns), value)
            }
        }
        _ => {
            // RoboHive multiplies by 255 and R3M divides by it again.
            let value = |byte, channel| normalised(255.0 * unit(byte) / 255.0, channel);
            if whole {
                by_channel(picture.pixels(), value)
            } else {
                by_channel(&resample::bytes(picture, Filter::Bilinear, rows, columns), value)
            }
        }
    }
}

fn unit(byte: u8) -> f32 {
    f32::from(byte) / 255.0
}

fn normalised(value: f32, channel: usize) -> f32 {
    (value - MEAN[channel]) / DEVIATION[channel]
}

/// `value` of every number and its channel, channel by channel.
fn by_channel<T: Copy>(pixels: &[T], value: impl Fn(T, usize) -> f32) -> Vec<f32> {
    let pixels = pixels.as_chunks::<3>().0;
    (0..3)
        .flat_map(|channel| pixels.iter().map(move |pixel| (pixel[channel], channel)))
        .map(|(x, c)| value(x, c))
        .collect()
}

/// The central rows and columns of the resized picture.
fn windows(picture: &Picture<'_>) -> [Window; 2] {
    let sides = [picture.height(), picture.width()];
    let shorter = sides[0].min(sides[1]);
    sides.map(|side| {
        let whole = RESIZED * side / shorter;
        let margin = (whole - SIDE) as f64 / 2.0;
        Window { whole, first: margin.round_ties_even() as usize, count: SIDE }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_is_central_and_ties_go_to_the_even_pixel() {
        let window = |height: usize, width: usize| {
            let pixels = vec![0; height * width * 3];
            windows(&Picture::new(height, width, &pixels).unwrap()).map(|axis| (axis.whole, axis.first))
        };
        assert_eq!(window(224, 224), [(256, 16), (256, 16)]);
        assert_eq!(window(480, 640), [(256, 16), (341, 58)]);
        assert_eq!(window(261, 256), [(261, 18), (256, 16)]);
        assert_eq!(window(1, 3), [(256, 16), (768, 272)]);
    }

    #[test]
    fn profiles_scale_as_the_table_says() {
        let pixels = vec![255; SIDE * SIDE * 3];
        let picture = Picture::new(SIDE, SIDE, &pixels).unwrap();
        let first = |name: &str, profile| prepare(Encoding::parse(name).unwrap(), profile, &picture)[0];
        let white = (1.0 - MEAN[0]) / DEVIATION[0];
        for name in ["r3m18", "rrl18", "vc1s"] {
            assert_eq!(first(name, Profile::Fixed), white);
        }
        assert_eq!(first("r3m50", Profile::RoboHive07), white);
        assert_eq!(first("rrl50", Profile::RoboHive07), 255.0 * white);
        assert!((first("vc1l", Profile::RoboHive07) - (255.0 - MEAN[0]) / DEVIATION[0]).abs() < 1e-3);
    }
}
