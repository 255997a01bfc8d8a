//! Residual networks (He et al. 2016) as torchvision builds them, up to the mean over all places: what their last layer, which
//! is left out, would classify. Blocks with three convolutions stride in the second.

use super::convolution::{Convolution, ConvolutionShape, Map, rectify};
use crate::weights::{Naming, Parameter, Parameters};

/// How files name the tensors: torchvision's as they are, R3M's below `module.convnet`. The last layer, counters of batches
/// and R3M's language head are not used.
pub const NAMING: Naming = Naming {
    prefixes: &["", "module.convnet.", "convnet.", "module."],
    ignored: |name| {
        let head = name.starts_with("fc.") || name.contains("lang_enc") || name.contains("lang_rew");
        head || name.ends_with(".num_batches_tracked")
    },
};

/// Stages. Each but the first halves the side.
const STAGES: usize = 4;

/// Sizes of a residual network.
#[derive(Clone, Debug)]
pub struct ResnetShape {
    /// Blocks of each stage.
    pub blocks: [usize; STAGES],
    /// Channels of the first stage; each further one has twice as many.
    pub width: usize,
    /// Whether blocks have three convolutions, the last one with four times the channels, or two.
    pub bottleneck: bool,
}

impl ResnetShape {
    /// 18 layers.
    pub fn resnet18() -> Self {
        ResnetShape { blocks: [2, 2, 2, 2], width: 64, bottleneck: false }
    }

    /// 34 layers.
    pub fn resnet34() -> Self {
        ResnetShape { blocks: [3, 4, 6, 3], width: 64, bottleneck: false }
    }

    /// 50 layers.
    pub fn resnet50() -> Self {
        ResnetShape { blocks: [3, 4, 6, 3], width: 64, bottleneck: true }
    }

    /// Features of a picture.
    pub fn features(&self) -> usize {
        (self.width << (STAGES - 1)) * self.expansion()
    }

    /// The tensors that it needs.
    pub fn layout(&self) -> Vec<Parameter> {
        let blocks = self.block_shapes();
        let convolutions = blocks.iter().flat_map(|block| block.convolutions.iter().chain(&block.shortcut));
        [self.stem()].iter().chain(convolutions).flat_map(ConvolutionShape::layout).collect()
    }

    fn expansion(&self) -> usize {
        if self.bottleneck { 4 } else { 1 }
    }

    fn stem(&self) -> ConvolutionShape {
        ConvolutionShape {
            name: "conv1".into(),
            normalisation: "bn1".into(),
            inputs: 3,
            outputs: self.width,
            kernel: 7,
            stride: 2,
        }
    }

    fn block_shapes(&self) -> Vec<BlockShape> {
        let mut inputs = self.width;
        let mut shapes = Vec::new();
        for (stage, &count) in self.blocks.iter().enumerate() {
            let width = self.width << stage;
            for block in 0..count {
                let stride = if stage > 0 && block == 0 { 2 } else { 1 };
                let path = format!("layer{}.{block}", stage + 1);
                shapes.push(self.block_shape(&path, inputs, width, stride));
                inputs = width * self.expansion();
            }
        }
        shapes
    }

    fn block_shape(&self, path: &str, inputs: usize, width: usize, stride: usize) -> BlockShape {
        let outputs = width * self.expansion();
        // Inputs, outputs, kernel and stride of each.
        let sizes = if self.bottleneck {
            vec![(inputs, width, 1, 1), (width, width, 3, stride), (width, outputs, 1, 1)]
        } else {
            vec![(inputs, width, 3, stride), (width, width, 3, 1)]
        };
        let numbered = sizes.into_iter().enumerate().map(|(k, (inputs, outputs, kernel, stride))| {
            let (name, normalisation) = (format!("{path}.conv{}", k + 1), format!("{path}.bn{}", k + 1));
            ConvolutionShape { name, normalisation, inputs, outputs, kernel, stride }
        });
        let shortcut = (stride != 1 || inputs != outputs).then(|| {
            let (name, normalisation) = (format!("{path}.downsample.0"), format!("{path}.downsample.1"));
            ConvolutionShape { name, normalisation, inputs, outputs, kernel: 1, stride }
        });
        BlockShape { convolutions: numbered.collect(), shortcut }
    }
}

struct BlockShape {
    convolutions: Vec<ConvolutionShape>,
    /// What the input passes to fit the output, if it does not.
    shortcut: Option<ConvolutionShape>,
}

struct Block {
    convolutions: Vec<Convolution>,
    shortcut: Option<Convolution>,
}

/// A residual network with its weights.
pub struct Resnet {
    stem: Convolution,
    blocks: Vec<Block>,
}

impl Resnet {
    /// A network over the tensors of its layout, which it takes.
    ///
    /// # Panics
    /// `parameters` were collected for another layout.
    pub fn new(shape: ResnetShape, parameters: &mut Parameters) -> Self {
        let stem = Convolution::new(shape.stem(), parameters);
        let blocks = shape.block_shapes().into_iter().map(|block| Block {
            convolutions: block.convolutions.into_iter().map(|c| Convolution::new(c, parameters)).collect(),
            shortcut: block.shortcut.map(|c| Convolution::new(c, parameters)),
        });
        Resnet { stem, blocks: blocks.collect() }
    }

    /// Features of a prepared picture, 3 × `side` × `side`.
    ///
    /// # Panics
    /// `prepared` has another length.
    pub fn features(&self, prepared: Vec<f32>, side: usize) -> Vec<f32> {
        assert_eq!(prepared.len(), 3 * side * side);
        let gathered = &mut Vec::new();
        let picture = Map { channels: 3, side, values: prepared };
        let mut map = self.stem.start(&picture);
        self.stem.add(&picture, &mut map, gathered);
        rectify(&mut map);
        let map = self.blocks.iter().fold(largest_of_three(&map), |map, block| block.run(map, gathered));
        let area = (map.side * map.side) as f32;
        map.values
            .chunks_exact(map.side * map.side)
            .map(|channel| channel.iter().sum::<f32>() / area)
            .collect()
    }
}

impl Block {
    fn run(&self, input: Map, gathered: &mut Vec<f32>) -> Map {
        let (last, first) = self.convolutions.split_last().expect("a block has convolutions");
        let mut inner: Option<Map> = None;
        for convolution in first {
            let from = inner.as_ref().unwrap_or(&input);
            let mut out = convolution.start(from);
            convolution.add(from, &mut out, gathered);
            rectify(&mut out);
            inner = Some(out);
        }
        let inner = inner.expect("a block has two convolutions or more");
        let mut out = match &self.shortcut {
            Some(shortcut) => {
                let mut out = shortcut.start(&input);
                shortcut.add(&input, &mut out, gathered);
                out
            }
            None => input,
        };
        last.add_bias(&mut out);
        last.add(&inner, &mut out, gathered);
        rectify(&mut out);
        out
    }
}

/// The largest of 3 × 3 numbers at every other place of every other row; beyond the border there is nothing.
fn largest_of_three(map: &Map) -> Map {
    let side = (map.side - 1) / 2 + 1;
    let mut out = Map::zeros(map.channels, side);
    let near = |place: usize| (2 * place).saturating_sub(1)..(2 * place + 2).min(map.side);
    for (channel, out) in out.values.chunks_exact_mut(side * side).enumerate() {
        let rows = |row: usize| {
            near(row).map(move |y| &map.values[(channel * map.side + y) * map.side..][..map.side])
        };
        for (row, out) in out.chunks_exact_mut(side).enumerate() {
            let highest: Vec<f32> = rows(row).fold(vec![f32::NEG_INFINITY; map.side], |mut highest, line| {
                highest.iter_mut().zip(line).for_each(|(high, value)| *high = high.max(*value));
                highest
            });
            for (column, out) in out.iter_mut().enumerate() {
                *out = highest[near(column)].iter().copied().fold(f32::NEG_INFINITY, f32::max);
            }
        }
    }
    out
}
