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
use crate::weights::{Naming, Parameter, Parameters, WeightFile};
use rayon::prelude::*;
use std::path::Path;

/// A network with its weights.
#[non_exhaustive]
pub enum Network {
    /// A ResNet.
    Resnet(Resnet),
    /// A vision transformer.
    Transformer(Transformer),
}

/// Sizes of the network of an encoding.
enum Shape {
    Resnet(ResnetShape),
    Transformer(TransformerShape),
}

impl Shape {
    fn of(encoding: Encoding) -> Result<Self, EncoderError> {
        Ok(match encoding {
            Encoding::Flat | Encoding::Picture => {
                return Err(EncoderError::TakesNoWeights { encoding: encoding.name() });
            }
            Encoding::R3m(Depth::D18) | Encoding::Rrl(Depth::D18) => Shape::Resnet(ResnetShape::resnet18()),
            Encoding::R3m(Depth::D34) | Encoding::Rrl(Depth::D34) => Shape::Resnet(ResnetShape::resnet34()),
            Encoding::R3m(Depth::D50) | Encoding::Rrl(Depth::D50) => Shape::Resnet(ResnetShape::resnet50()),
            Encoding::Vc1(Size::Base) => Shape::Transformer(TransformerShape::base(SIDE)),
            Encoding::Vc1(Size::Large) => Shape::Transformer(TransformerShape::large(SIDE)),
        })
    }

    fn layout(&self) -> Vec<Parameter> {
        match self {
            Shape::Resnet(shape) => shape.layout(),
            Shape::Transformer(shape) => shape.layout(),
        }
    }

    fn naming(&self) -> &'static Naming {
        match self {
            Shape::Resnet(_) => &resnet::NAMING,
            Shape::Transformer(_) => &transformer::NAMING,
        }
    }

    fn build(self, parameters: &mut Parameters) -> Network {
        match self {
            Shape::Resnet(shape) => Network::Resnet(Resnet::new(shape, parameters)),
            Shape::Transformer(shape) => Network::Transformer(Transformer::new(shape, parameters)),
        }
    }
}

impl Network {
    /// The tensors that the network of an encoding needs.
    ///
    /// # Errors
    /// The encoding is no network.
    pub fn layout(encoding: Encoding) -> Result<Vec<Parameter>, EncoderError> {
        Ok(Shape::of(encoding)?.layout())
    }

    /// The network of an encoding over tensors of its layout, which it takes.
    ///
    /// # Errors
    /// The encoding is no network.
    ///
    /// # Panics
    /// `parameters` were collected for another layout.
    pub fn new(encoding: Encoding, parameters: &mut Parameters) -> Result<Self, EncoderError> {
        Ok(Shape::of(encoding)?.build(parameters))
    }

    /// The network of an encoding, with the weights of a file.
    ///
    /// # Errors
    /// The encoding is no network, the file cannot be read, or its tensors do not fit the network.
    pub fn load(encoding: Encoding, path: &Path) -> Result<Self, EncoderError> {
        let shape = Shape::of(encoding)?;
        let mut file = WeightFile::open(path)?;
        let mut parameters = Parameters::read(&mut file, &shape.layout(), shape.naming())?;
        Ok(shape.build(&mut parameters))
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
