//! Visual keys: which camera is seen, how large, and through which encoder.

use crate::message::message;
use std::fmt;
use std::str::FromStr;

message! {
    /// A visual key that is malformed or does not fit the others or the model.
    VisualKeyError
}

/// What a pixel holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Colours, 8 bits each.
    Rgb,
    /// Distance from the camera's plane \[m\].
    Depth,
}

/// What becomes of an image before it is returned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Encoder {
    /// All pixels in one row.
    Flat,
    /// Height x width x colours.
    Image,
    /// R3M on a ResNet of this depth.
    R3m(u8),
    /// An ImageNet ResNet of this depth.
    Rrl(u8),
    /// VC-1 base (`false`) or large (`true`).
    Vc1 {
        /// Whether it is the large one.
        large: bool,
    },
}

/// Names of the encoders.
const ENCODERS: [(&str, Encoder); 10] = [
    ("1d", Encoder::Flat),
    ("2d", Encoder::Image),
    ("r3m18", Encoder::R3m(18)),
    ("r3m34", Encoder::R3m(34)),
    ("r3m50", Encoder::R3m(50)),
    ("rrl18", Encoder::Rrl(18)),
    ("rrl34", Encoder::Rrl(34)),
    ("rrl50", Encoder::Rrl(50)),
    ("vc1s", Encoder::Vc1 { large: false }),
    ("vc1l", Encoder::Vc1 { large: true }),
];

/// Most pixels along a side.
const MAX_SIDE: usize = 16_384;

/// A visual key: `rgb:CAMERA:HxW:ENCODER` or `d:CAMERA:HxW:ENCODER`. Names of cameras may hold colons.
///
/// ```
/// use robohive_env::visual::{Channel, Encoder, VisualKey};
/// let key: VisualKey = "rgb:A:headCam:240x424:2d".parse()?;
/// assert_eq!((key.camera.as_str(), key.height, key.width), ("A:headCam", 240, 424));
/// assert_eq!((key.channel, key.encoder), (Channel::Rgb, Encoder::Image));
/// assert_eq!(key.to_string(), "rgb:A:headCam:240x424:2d");
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VisualKey {
    /// What a pixel holds.
    pub channel: Channel,
    /// The camera's name.
    pub camera: String,
    /// Pixels from top to bottom.
    pub height: usize,
    /// Pixels from left to right.
    pub width: usize,
    /// What becomes of the image.
    pub encoder: Encoder,
}

impl fmt::Display for Encoder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(ENCODERS.iter().find(|(_, encoder)| encoder == self).map_or("", |(name, _)| name))
    }
}

impl FromStr for VisualKey {
    type Err = VisualKeyError;

    fn from_str(key: &str) -> Result<Self, VisualKeyError> {
        let wrong = |what: &str| {
            VisualKeyError::new(format!(
                "the visual key {key} {what}; keys read rgb:CAMERA:HEIGHTxWIDTH:ENCODER"
            ))
        };
        let (channel, rest) = key.split_once(':').ok_or_else(|| wrong("has no colon"))?;
        let channel = match channel {
            "rgb" => Channel::Rgb,
            "d" => Channel::Depth,
            _ => return Err(wrong("begins neither with rgb nor with d")),
        };
        let mut parts = rest.rsplitn(3, ':');
        let (Some(encoder), Some(size), Some(camera)) = (parts.next(), parts.next(), parts.next()) else {
            return Err(wrong("has too few parts"));
        };
        let names = || ENCODERS.map(|(name, _)| name).join(", ");
        let encoder = ENCODERS
            .iter()
            .find(|(name, _)| *name == encoder)
            .ok_or_else(|| wrong(&format!("names an unknown encoder, {encoder}; there are {}", names())))?
            .1;
        let side = |text: &str| text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
        let (height, width) = size
            .split_once('x')
            .and_then(|(height, width)| Some((side(height)?, side(width)?)))
            .ok_or_else(|| wrong(&format!("has the size {size}, whose sides are not 1 to {MAX_SIDE}")))?;
        Ok(VisualKey { channel, camera: camera.into(), height, width, encoder })
    }
}

impl fmt::Display for VisualKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let channel = if self.channel == Channel::Rgb { "rgb" } else { "d" };
        write!(f, "{channel}:{}:{}x{}:{}", self.camera, self.height, self.width, self.encoder)
    }
}

/// Reads all keys of an environment. Colour keys share one size and encoder, as the original demands.
///
/// # Errors
/// A key is malformed, names a camera that does not exist, or differs in size or encoder from another.
pub fn parse_keys<'a>(
    keys: &[String],
    cameras: impl Iterator<Item = &'a str>,
) -> Result<Vec<VisualKey>, VisualKeyError> {
    let keys: Vec<VisualKey> = keys.iter().map(|key| key.parse()).collect::<Result<_, _>>()?;
    let cameras: Vec<_> = cameras.collect();
    if let Some(key) = keys.iter().find(|key| !cameras.contains(&key.camera.as_str())) {
        return Err(format!("{key} names no camera of the model; there are {}", cameras.join(", ")).into());
    }
    let mut colours = keys.iter().filter(|key| key.channel == Channel::Rgb);
    if let Some(first) = colours.next() {
        let same = |key: &VisualKey| {
            (key.height, key.width, key.encoder) == (first.height, first.width, first.encoder)
        };
        if let Some(other) = colours.find(|key| !same(key)) {
            return Err(format!(
                "{first} and {other} differ in size or encoder, and an environment has one of each"
            )
            .into());
        }
    }
    Ok(keys)
}

impl Encoder {
    /// The number of features, where a network finds them.
    pub fn network(self) -> Option<usize> {
        match self {
            Encoder::Flat | Encoder::Image => None,
            Encoder::R3m(depth) | Encoder::Rrl(depth) => Some(if depth == 50 { 2048 } else { 512 }),
            Encoder::Vc1 { large } => Some(if large { 1024 } else { 768 }),
        }
    }
}

impl VisualKey {
    /// Shape of the image: H x W x 3 colours (`2d`), all of them in one row (`1d`), the features of a network, or 1 x H x W
    /// depths.
    pub fn shape(&self) -> Vec<usize> {
        let (height, width) = (self.height, self.width);
        match (self.channel, self.encoder) {
            (Channel::Depth, _) => vec![1, height, width],
            (Channel::Rgb, Encoder::Flat) => vec![height * width * 3],
            (Channel::Rgb, Encoder::Image) => vec![height, width, 3],
            (Channel::Rgb, encoder) => encoder.network().into_iter().collect(),
        }
    }

    /// Whether it is what a network makes of colours.
    pub fn is_encoded(&self) -> bool {
        self.channel == Channel::Rgb && self.encoder.network().is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn malformed_keys_are_named() {
        for (key, text) in [
            ("rgb", "no colon"),
            ("ir:cam:2x2:2d", "neither"),
            ("rgb:cam:2d", "too few"),
            ("rgb:cam:2x2:3d", "r3m18"),
            ("d:cam:0x2:2d", "1 to"),
            ("d:cam:2:2d", "size 2"),
        ] {
            let error = key.parse::<VisualKey>().unwrap_err().to_string();
            assert!(error.contains(text) && error.contains(key), "{error}");
        }
    }

    #[test]
    fn keys_of_an_environment_agree() {
        let keys = |keys: &[&str]| keys.iter().map(ToString::to_string).collect::<Vec<_>>();
        let cameras = ["left", "right"];
        let good = keys(&["rgb:left:8x9:2d", "d:left:8x9:2d", "rgb:right:8x9:2d"]);
        assert_eq!(parse_keys(&good, cameras.into_iter()).unwrap().len(), 3);
        let sizes = keys(&["rgb:left:8x9:2d", "rgb:right:9x9:2d"]);
        assert!(parse_keys(&sizes, cameras.into_iter()).unwrap_err().to_string().contains("differ"));
        let unknown = keys(&["rgb:top:8x9:2d"]);
        assert!(parse_keys(&unknown, cameras.into_iter()).unwrap_err().to_string().contains("left, right"));
    }
}
