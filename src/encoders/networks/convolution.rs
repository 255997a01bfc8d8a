//! Convolution with the batch normalisation that follows it.

use crate::weights::{Parameter, Parameters};
use ndarray::linalg::general_mat_mul;
use ndarray::{Array2, ArrayView2, ArrayViewMut2, Axis, Slice};

/// Added to a variance before its root is taken.
const EPSILON: f64 = 1e-5;

/// Numbers of the matrix of patches that are gathered at once: about what a core keeps close.
const GATHERED: usize = 1 << 17;

/// A square map of several channels, channel by channel and row by row.
pub(super) struct Map {
    pub channels: usize,
    pub side: usize,
    pub values: Vec<f32>,
}

impl Map {
    pub fn zeros(channels: usize, side: usize) -> Self {
        Map { channels, side, values: vec![0.0; channels * side * side] }
    }
}

/// Sizes of a convolution, and the names of its tensors and its normalisation's.
#[derive(Clone, Debug)]
pub(super) struct ConvolutionShape {
    pub name: String,
    pub normalisation: String,
    pub inputs: usize,
    pub outputs: usize,
    pub kernel: usize,
    pub stride: usize,
}

impl ConvolutionShape {
    pub fn layout(&self) -> Vec<Parameter> {
        let kernel = [self.outputs, self.inputs, self.kernel, self.kernel];
        let mut layout = vec![Parameter::new(format!("{}.weight", self.name), &kernel)];
        for part in ["weight", "bias", "running_mean", "running_var"] {
            layout.push(Parameter::new(format!("{}.{part}", self.normalisation), &[self.outputs]));
        }
        layout
    }

    /// Zeros around the input, with which a stride of one keeps its side.
    fn padding(&self) -> usize {
        self.kernel / 2
    }

    fn side(&self, input: usize) -> usize {
        (input + 2 * self.padding() - self.kernel) / self.stride + 1
    }

    /// Numbers that an output is computed from.
    fn patch(&self) -> usize {
        self.inputs * self.kernel * self.kernel
    }
}

/// A convolution whose weights contain its normalisation.
pub(super) struct Convolution {
    shape: ConvolutionShape,
    /// Outputs × patch.
    weights: Array2<f32>,
    bias: Vec<f32>,
}

impl Convolution {
    pub fn new(shape: ConvolutionShape, parameters: &mut Parameters) -> Self {
        let mut weights = parameters.take(&format!("{}.weight", shape.name));
        let mut normalisation = |part| parameters.take(&format!("{}.{part}", shape.normalisation));
        let (gain, shift) = (normalisation("weight"), normalisation("bias"));
        let (mean, variance) = (normalisation("running_mean"), normalisation("running_var"));
        let mut bias = vec![0.0; shape.outputs];
        for (k, kernel) in weights.chunks_exact_mut(shape.patch()).enumerate() {
            let factor = f64::from(gain[k]) / (f64::from(variance[k]) + EPSILON).sqrt();
            kernel.iter_mut().for_each(|weight| *weight = (f64::from(*weight) * factor) as f32);
            bias[k] = (f64::from(shift[k]) - f64::from(mean[k]) * factor) as f32;
        }
        let weights = Array2::from_shape_vec((shape.outputs, shape.patch()), weights)
            .expect("the shape was compared with the layout");
        Convolution { shape, weights, bias }
    }

    /// A map of the output's size with the bias in each channel, to which [`Convolution::add`] adds.
    pub fn start(&self, input: &Map) -> Map {
        let side = self.shape.side(input.side);
        let mut out = Map::zeros(self.shape.outputs, side);
        self.add_bias(&mut out);
        out
    }

    /// Adds the bias to each channel.
    pub fn add_bias(&self, out: &mut Map) {
        for (channel, bias) in out.values.chunks_exact_mut(out.side * out.side).zip(&self.bias) {
            channel.iter_mut().for_each(|value| *value += bias);
        }
    }

    /// Adds the weighted sums of the input's patches. `gathered` is memory to work in.
    pub fn add(&self, input: &Map, out: &mut Map, gathered: &mut Vec<f32>) {
        let (side, area) = (out.side, out.side * out.side);
        let mut sums = ArrayViewMut2::from_shape((out.channels, area), &mut out.values)
            .expect("the output was started by this convolution");
        if self.shape.kernel == 1 && self.shape.stride == 1 {
            let patches = ArrayView2::from_shape((input.channels, area), &input.values)
                .expect("the input has as many channels as the convolution");
            general_mat_mul(1.0, &self.weights, &patches, 1.0, &mut sums);
            return;
        }
        let rows = (GATHERED / (self.shape.patch() * side)).clamp(1, side);
        for first in (0..side).step_by(rows) {
            let count = rows.min(side - first);
            let columns = count * side;
            gathered.clear();
            gathered.resize(self.shape.patch() * columns, 0.0);
            self.gather(input, first, side, gathered);
            let patches = ArrayView2::from_shape((self.shape.patch(), columns), &gathered[..])
                .expect("one column is gathered for each output");
            let mut part = sums.slice_axis_mut(Axis(1), Slice::from(first * side..first * side + columns));
            general_mat_mul(1.0, &self.weights, &patches, 1.0, &mut part);
        }
    }

    /// Fills `gathered`, all zeros, with the patches of output rows from `first` on: patch × (rows × side).
    fn gather(&self, input: &Map, first: usize, side: usize, gathered: &mut [f32]) {
        let ConvolutionShape { kernel, stride, .. } = self.shape;
        let padding = self.shape.padding();
        let columns = gathered.len() / self.shape.patch();
        for (place, out) in gathered.chunks_exact_mut(columns).enumerate() {
            let (channel, down, across) =
                (place / (kernel * kernel), place / kernel % kernel, place % kernel);
            // Outputs whose column of the patch lies within the input.
            let from = padding.saturating_sub(across).div_ceil(stride);
            let end = ((input.side + padding - across - 1) / stride + 1).min(side);
            if from >= end {
                continue;
            }
            let start = from * stride + across - padding;
            for (row, out) in out.chunks_exact_mut(side).enumerate() {
                let Some(y) =
                    ((first + row) * stride + down).checked_sub(padding).filter(|&y| y < input.side)
                else {
                    continue;
                };
                let line = &input.values[(channel * input.side + y) * input.side..][..input.side];
                if stride == 1 {
                    out[from..end].copy_from_slice(&line[start..start + end - from]);
                } else {
                    let taken = line[start..].iter().step_by(stride);
                    out[from..end].iter_mut().zip(taken).for_each(|(out, value)| *out = *value);
                }
            }
        }
    }
}

/// Sets negative numbers to zero.
pub(super) fn rectify(map: &mut Map) {
    map.values.iter_mut().for_each(|value| *value = value.max(0.0));
}
