//! Names of encoders, as the last word of a visual key: `rgb:CAMERA:HxW:ENCODER`.
//!
//! ```
//! use robohive_encoders::Encoding;
//!
//! let encoding = Encoding::parse("r3m18")?;
//! assert_eq!(encoding.to_string(), "r3m18");
//! assert!(Encoding::parse("r3m19").is_err());
//! # Ok::<(), robohive_encoders::EncoderError>(())
//! ```

use crate::error::EncoderError;
use std::fmt;

/// What a picture is turned into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Encoding {
    /// The bytes in one row: `1d`.
    Flat,
    /// The bytes as height × width × 3: `2d`.
    Picture,
    /// R3M (Nair et al. 2022): a ResNet trained on videos of people.
    R3m(Depth),
    /// RRL (Shah and Kumar 2021): a ResNet trained on ImageNet.
    Rrl(Depth),
    /// VC-1 (Majumdar et al. 2023): a vision transformer.
    Vc1(Size),
}

/// Layers of a ResNet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Depth {
    /// 18 layers, 512 features.
    D18,
    /// 34 layers, 512 features.
    D34,
    /// 50 layers, 2048 features.
    D50,
}

/// Size of a vision transformer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Size {
    /// ViT-B/16, 768 features. RoboHive calls it `s`.
    Base,
    /// ViT-L/16, 1024 features.
    Large,
}

impl Encoding {
    /// All of them.
    pub const ALL: [Encoding; 10] = [
        Encoding::Flat,
        Encoding::Picture,
        Encoding::R3m(Depth::D18),
        Encoding::R3m(Depth::D34),
        Encoding::R3m(Depth::D50),
        Encoding::Rrl(Depth::D18),
        Encoding::Rrl(Depth::D34),
        Encoding::Rrl(Depth::D50),
        Encoding::Vc1(Size::Base),
        Encoding::Vc1(Size::Large),
    ];

    /// The encoding with a name.
    ///
    /// # Errors
    /// [`EncoderError::UnknownEncoding`]: there is none of that name.
    pub fn parse(name: &str) -> Result<Self, EncoderError> {
        let found = Self::ALL.into_iter().find(|encoding| encoding.name() == name);
        let known = || Self::ALL.map(Encoding::name).to_vec();
        found.ok_or_else(|| EncoderError::UnknownEncoding { name: name.to_owned(), known: known() })
    }

    /// RoboHive's name.
    pub fn name(self) -> &'static str {
        match self {
            Encoding::Flat => "1d",
            Encoding::Picture => "2d",
            Encoding::R3m(Depth::D18) => "r3m18",
            Encoding::R3m(Depth::D34) => "r3m34",
            Encoding::R3m(Depth::D50) => "r3m50",
            Encoding::Rrl(Depth::D18) => "rrl18",
            Encoding::Rrl(Depth::D34) => "rrl34",
            Encoding::Rrl(Depth::D50) => "rrl50",
            Encoding::Vc1(Size::Base) => "vc1s",
            Encoding::Vc1(Size::Large) => "vc1l",
        }
    }

    /// Whether a network computes it, which needs weights.
    pub fn is_network(self) -> bool {
        !matches!(self, Encoding::Flat | Encoding::Picture)
    }

    /// Numbers that a picture of `height` × `width` pixels becomes.
    pub fn output_len(self, height: usize, width: usize) -> usize {
        self.features().unwrap_or(height * width * 3)
    }

    /// Numbers that a network gives, whatever the size of the picture.
    pub fn features(self) -> Option<usize> {
        match self {
            Encoding::Flat | Encoding::Picture => None,
            Encoding::R3m(depth) | Encoding::Rrl(depth) => Some(if depth == Depth::D50 { 2048 } else { 512 }),
            Encoding::Vc1(Size::Base) => Some(768),
            Encoding::Vc1(Size::Large) => Some(1024),
        }
    }
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_their_encodings() {
        for encoding in Encoding::ALL {
            assert_eq!(Encoding::parse(encoding.name()).unwrap(), encoding);
        }
        let lengths = Encoding::ALL.map(|encoding| encoding.output_len(4, 5));
        assert_eq!(lengths, [60, 60, 512, 512, 2048, 512, 512, 2048, 768, 1024]);
    }

    #[test]
    fn unknown_names_are_answered_with_the_known_ones() {
        let message = Encoding::parse("resnet18").unwrap_err().to_string();
        assert!(message.contains("\"resnet18\"") && message.contains("1d, 2d, r3m18"), "{message}");
    }
}
