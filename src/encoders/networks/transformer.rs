//! Vision transformers (Dosovitskiy et al. 2021) as timm builds them and VC-1 uses them: patches and a class token with learned
//! positions, blocks that normalise before attention and before the layers on each token, and of the last normalisation the
//! class token.

use super::attention::Attention;
use super::token::{Linear, LinearShape, Normalisation, gelu};
use crate::weights::{Naming, Parameter, Parameters};
use ndarray::{Array2, Axis};

/// How files name the tensors. What a masked autoencoder was trained with, and a classifier, are not used.
pub const NAMING: Naming = Naming {
    prefixes: &["", "module."],
    ignored: |name| name.contains("decoder") || name.contains("mask_token") || name.starts_with("head."),
};

/// Sizes of a vision transformer.
#[derive(Clone, Debug)]
pub struct TransformerShape {
    /// Pixels of each side of a picture.
    pub side: usize,
    /// Pixels of each side of a patch.
    pub patch: usize,
    /// Numbers of a token.
    pub width: usize,
    /// Blocks.
    pub depth: usize,
    /// Heads of each attention.
    pub heads: usize,
}

impl TransformerShape {
    /// ViT-B/16.
    pub fn base(side: usize) -> Self {
        TransformerShape { side, patch: 16, width: 768, depth: 12, heads: 12 }
    }

    /// ViT-L/16.
    pub fn large(side: usize) -> Self {
        TransformerShape { side, patch: 16, width: 1024, depth: 24, heads: 16 }
    }

    /// Tokens: one for each patch, and the class token.
    fn tokens(&self) -> usize {
        (self.side / self.patch).pow(2) + 1
    }

    /// The tensors that it needs.
    pub fn layout(&self) -> Vec<Parameter> {
        let width = self.width;
        let mut layout = vec![
            Parameter::new("cls_token", &[1, 1, width]),
            Parameter::new("pos_embed", &[1, self.tokens(), width]),
            Parameter::new("patch_embed.proj.weight", &[width, 3, self.patch, self.patch]),
            Parameter::new("patch_embed.proj.bias", &[width]),
        ];
        for block in 0..self.depth {
            let path = format!("blocks.{block}");
            layout.extend(Normalisation::layout(&format!("{path}.norm1"), width));
            layout.extend(Attention::layout(&format!("{path}.attn"), width));
            layout.extend(Normalisation::layout(&format!("{path}.norm2"), width));
            layout.extend(perceptron(&path, width).iter().flat_map(LinearShape::layout));
        }
        layout.extend(Normalisation::layout("norm", width));
        layout
    }

    fn embedding(&self) -> LinearShape {
        let inputs = 3 * self.patch * self.patch;
        LinearShape { name: "patch_embed.proj".into(), inputs, outputs: self.width }
    }
}

/// The two layers on each token, between which there are four times as many numbers.
fn perceptron(path: &str, width: usize) -> [LinearShape; 2] {
    [
        LinearShape { name: format!("{path}.mlp.fc1"), inputs: width, outputs: 4 * width },
        LinearShape { name: format!("{path}.mlp.fc2"), inputs: 4 * width, outputs: width },
    ]
}

struct Block {
    before_attention: Normalisation,
    attention: Attention,
    before_layers: Normalisation,
    layers: [Linear; 2],
}

/// A vision transformer with its weights.
pub struct Transformer {
    shape: TransformerShape,
    embedding: Linear,
    class: Vec<f32>,
    /// Tokens × width.
    positions: Array2<f32>,
    blocks: Vec<Block>,
    last: Normalisation,
}

impl Transformer {
    /// A network over the tensors of its layout, which it takes.
    ///
    /// # Panics
    /// `parameters` were collected for another layout.
    pub fn new(shape: TransformerShape, parameters: &mut Parameters) -> Self {
        let positions = Array2::from_shape_vec((shape.tokens(), shape.width), parameters.take("pos_embed"))
            .expect("the shape was compared with the layout");
        let block = |k: usize| {
            let path = format!("blocks.{k}");
            Block {
                before_attention: Normalisation::new(&format!("{path}.norm1"), parameters),
                attention: Attention::new(&format!("{path}.attn"), shape.width, shape.heads, parameters),
                before_layers: Normalisation::new(&format!("{path}.norm2"), parameters),
                layers: perceptron(&path, shape.width).map(|layer| Linear::new(&layer, parameters)),
            }
        };
        let blocks = (0..shape.depth).map(block).collect();
        let embedding = Linear::new(&shape.embedding(), parameters);
        let class = parameters.take("cls_token");
        let last = Normalisation::new("norm", parameters);
        Transformer { shape, embedding, class, positions, blocks, last }
    }

    /// Features of a prepared picture, 3 × side × side.
    ///
    /// # Panics
    /// `prepared` has another length.
    pub fn features(&self, prepared: &[f32]) -> Vec<f32> {
        assert_eq!(prepared.len(), 3 * self.shape.side * self.shape.side);
        let mut tokens = self.positions.clone();
        let embedded = self.embedding.apply(self.patches(prepared).view());
        let (mut of_class, mut of_patches) = tokens.view_mut().split_at(Axis(0), 1);
        of_class.iter_mut().zip(&self.class).for_each(|(sum, value)| *sum += value);
        of_patches += &embedded;
        for block in &self.blocks {
            let normalised = block.before_attention.apply(tokens.view());
            block.attention.add(normalised.view(), &mut tokens);
            let mut inner = block.layers[0].apply(block.before_layers.apply(tokens.view()).view());
            gelu(&mut inner);
            block.layers[1].add(inner.view(), &mut tokens);
        }
        let (of_class, _) = tokens.view().split_at(Axis(0), 1);
        self.last.apply(of_class).into_raw_vec_and_offset().0
    }

    /// The numbers of each patch: channel by channel, row by row.
    fn patches(&self, prepared: &[f32]) -> Array2<f32> {
        let TransformerShape { side, patch, .. } = self.shape;
        let across = side / patch;
        Array2::from_shape_fn((across * across, 3 * patch * patch), |(place, k)| {
            let (channel, row, column) = (k / (patch * patch), k / patch % patch, k % patch);
            let (y, x) = (place / across * patch + row, place % across * patch + column);
            prepared[(channel * side + y) * side + x]
        })
    }
}
