//! An encoder: a picture in, numbers out.

use crate::encoding::Encoding;
use crate::error::EncoderError;
#[cfg(feature = "networks")]
use crate::networks::Network;
use crate::picture::Picture;
use crate::prepare::Profile;
use std::path::Path;

/// An encoder with its weights, which any number of threads may use at once.
pub struct Encoder {
    encoding: Encoding,
    #[cfg(feature = "networks")]
    network: Option<(Network, Profile)>,
}

impl Encoder {
    /// An encoder that passes the bytes of pictures on.
    ///
    /// # Errors
    /// [`EncoderError::NeedsWeights`]: `encoding` is a network.
    pub fn identity(encoding: Encoding) -> Result<Self, EncoderError> {
        if encoding.is_network() {
            return Err(EncoderError::NeedsWeights { encoding: encoding.name() });
        }
        Ok(Encoder {
            encoding,
            #[cfg(feature = "networks")]
            network: None,
        })
    }

    /// An encoder with a network that was built for `encoding`.
    #[cfg(feature = "networks")]
    pub fn with_network(encoding: Encoding, network: Network, profile: Profile) -> Self {
        Encoder { encoding, network: Some((network, profile)) }
    }

    /// The network of `encoding` with the weights of a file: safetensors, or what `torch.save` wrote.
    ///
    /// # Errors
    /// The encoder is no network, the file cannot be read, or its tensors do not fit the network.
    #[cfg(feature = "networks")]
    pub fn load(encoding: Encoding, weights: &Path, profile: Profile) -> Result<Self, EncoderError> {
        Ok(Self::with_network(encoding, Network::load(encoding, weights)?, profile))
    }

    /// The network of `encoding` with the weights of a file: safetensors, or what `torch.save` wrote.
    ///
    /// # Errors
    /// Always: [`EncoderError::NotBuilt`], or [`EncoderError::TakesNoWeights`] where the encoder is no network.
    #[cfg(not(feature = "networks"))]
    pub fn load(encoding: Encoding, _: &Path, _: Profile) -> Result<Self, EncoderError> {
        let missing = if encoding.is_network() {
            EncoderError::NotBuilt { encoding: encoding.name() }
        } else {
            EncoderError::TakesNoWeights { encoding: encoding.name() }
        };
        Err(missing)
    }

    /// What it computes.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// Encodings of pictures, one after the other, each of [`Encoding::output_len`] numbers.
    ///
    /// A network works on one picture after the other, several at once on the threads of the current pool of `rayon`. What a
    /// picture gives depends neither on the others nor on the number of threads.
    pub fn encode(&self, pictures: &[Picture<'_>]) -> Vec<f32> {
        #[cfg(feature = "networks")]
        if let Some((network, profile)) = &self.network {
            return crate::networks::encode(network, self.encoding, *profile, pictures);
        }
        pictures.iter().flat_map(|picture| picture.pixels().iter().map(|&byte| f32::from(byte))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encoding::Depth;

    #[test]
    fn encoders_without_a_network_take_no_weights() {
        let encoding = Encoding::Picture;
        let error = Encoder::load(encoding, Path::new("none"), Profile::Fixed).err().unwrap();
        assert_eq!(error, EncoderError::TakesNoWeights { encoding: encoding.name() });
        let encoding = Encoding::R3m(Depth::D18);
        assert_eq!(
            Encoder::identity(encoding).err().unwrap(),
            EncoderError::NeedsWeights { encoding: encoding.name() }
        );
    }

    #[test]
    #[cfg(not(feature = "networks"))]
    fn a_build_without_networks_says_so() {
        let error =
            Encoder::load(Encoding::R3m(Depth::D18), Path::new("none"), Profile::Fixed).err().unwrap();
        assert!(error.to_string().contains("feature `networks`"), "{error}");
    }
}
