//! The networks, in inference: ResNets and vision transformers on one picture at a time.
//!
//! Everything is computed in single precision; matrix products are `matrixmultiply`'s, which uses the widest vectors that the
//! processor has. The order of sums follows from the shapes alone, so a picture gives the same bits in any batch and with any
//! number of threads; another processor may round otherwise.

mod attention;
mod convolution;
pub mod resnet;
mod token;
pub mod transformer;

pub use resnet::{Resnet, ResnetShape};
pub use transformer::{Transformer, TransformerShape};

use crate::encoding::{Depth, Encoding, Size};
use crate::error::EncoderError;
use crate::picture::Picture;
use crate::prepare::{Profile, SIDE, prepare};
use crate::weights::{Parameters, WeightFile};
use rayon::prelude::*;
use std::path::Path;

/// A network with its weights.
pub enum Network {
    /// A ResNet.
    Resnet(Resnet),
    /// A vision transformer.
    Transformer(Transformer),
}

impl Network {
    /// The network of an encoding, with the weights of a file.
    ///
    /// # Errors
    /// The encoding is no network, the file cannot be read, or its tensors are not those of the network.
    pub fn load(encoding: Encoding, path: &Path) -> Result<Self, EncoderError> {
        let depth = match encoding {
            Encoding::Flat | Encoding::Picture => {
                return Err(EncoderError::TakesNoWeights { encoding: encoding.name() });
            }
            Encoding::Vc1(size) => {
                let shape = match size {
                    Size::Base => TransformerShape::base(SIDE),
                    Size::Large => TransformerShape::large(SIDE),
                };
                let mut file = WeightFile::open(path)?;
                let mut parameters = Parameters::read(&mut file, &shape.layout(), &transformer::NAMING)?;
                return Ok(Network::Transformer(Transformer::new(shape, &mut parameters)));
            }
            Encoding::R3m(depth) | Encoding::Rrl(depth) => depth,
        };
        let shape = match depth {
            Depth::D18 => ResnetShape::resnet18(),
            Depth::D34 => ResnetShape::resnet34(),
            Depth::D50 => ResnetShape::resnet50(),
        };
        let mut file = WeightFile::open(path)?;
        let mut parameters = Parameters::read(&mut file, &shape.layout(), &resnet::NAMING)?;
        Ok(Network::Resnet(Resnet::new(shape, &mut parameters)))
    }

    /// Features of a prepared picture, 3 × [`SIDE`] × [`SIDE`].
    fn features(&self, prepared: Vec<f32>) -> Vec<f32> {
        match self {
            Network::Resnet(resnet) => resnet.features(prepared, SIDE),
            Network::Transformer(transformer) => transformer.features(&prepared),
        }
    }
}

/// Features of pictures, one after the other.
pub(crate) fn encode(
    network: &Network,
    encoding: Encoding,
    profile: Profile,
    pictures: &[Picture<'_>],
) -> Vec<f32> {
    let one = |picture: &Picture<'_>| network.features(prepare(encoding, profile, picture));
    pictures.par_iter().flat_map_iter(one).collect()
}
