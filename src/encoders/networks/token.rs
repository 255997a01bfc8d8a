//! What a transformer does to each of its tokens by itself: linear layers, normalisation, activation.

use crate::weights::{Parameter, Parameters};
use ndarray::linalg::general_mat_mul;
use ndarray::{Array2, ArrayView2};
use std::f32::consts::FRAC_1_SQRT_2;

/// Added to a variance before its root is taken.
const EPSILON: f32 = 1e-6;

/// Name and sizes of a linear layer.
#[derive(Clone, Debug)]
pub(super) struct LinearShape {
    pub name: String,
    pub inputs: usize,
    pub outputs: usize,
}

impl LinearShape {
    pub fn layout(&self) -> [Parameter; 2] {
        [
            Parameter::new(format!("{}.weight", self.name), &[self.outputs, self.inputs]),
            Parameter::new(format!("{}.bias", self.name), &[self.outputs]),
        ]
    }
}

/// A linear layer.
pub(super) struct Linear {
    /// Outputs × inputs.
    weights: Array2<f32>,
    bias: Vec<f32>,
}

impl Linear {
    pub fn new(shape: &LinearShape, parameters: &mut Parameters) -> Self {
        let weights = parameters.take(&format!("{}.weight", shape.name));
        let weights = Array2::from_shape_vec((shape.outputs, shape.inputs), weights)
            .expect("the shape was compared with the layout");
        Linear { weights, bias: parameters.take(&format!("{}.bias", shape.name)) }
    }

    /// Tokens × inputs to tokens × outputs.
    pub fn apply(&self, tokens: ArrayView2<'_, f32>) -> Array2<f32> {
        let mut out = Array2::zeros((tokens.nrows(), self.bias.len()));
        self.add(tokens, &mut out);
        out
    }

    /// Adds the outputs to what is there.
    pub fn add(&self, tokens: ArrayView2<'_, f32>, out: &mut Array2<f32>) {
        for mut row in out.rows_mut() {
            row.iter_mut().zip(&self.bias).for_each(|(sum, bias)| *sum += bias);
        }
        general_mat_mul(1.0, &tokens, &self.weights.t(), 1.0, out);
    }
}

/// Layer normalisation.
pub(super) struct Normalisation {
    gain: Vec<f32>,
    shift: Vec<f32>,
}

impl Normalisation {
    pub fn layout(name: &str, width: usize) -> [Parameter; 2] {
        ["weight", "bias"].map(|part| Parameter::new(format!("{name}.{part}"), &[width]))
    }

    pub fn new(name: &str, parameters: &mut Parameters) -> Self {
        let [gain, shift] = ["weight", "bias"].map(|part| parameters.take(&format!("{name}.{part}")));
        Normalisation { gain, shift }
    }

    /// Brings each token to mean 0 and variance 1, then scales and shifts its numbers.
    pub fn apply(&self, tokens: ArrayView2<'_, f32>) -> Array2<f32> {
        let mut out = tokens.to_owned();
        for mut row in out.rows_mut() {
            let count = row.len() as f32;
            let mean = row.sum() / count;
            row.iter_mut().for_each(|value| *value -= mean);
            let variance = row.iter().map(|value| value * value).sum::<f32>() / count;
            let factor = 1.0 / (variance + EPSILON).sqrt();
            for ((value, gain), shift) in row.iter_mut().zip(&self.gain).zip(&self.shift) {
                *value = *value * factor * gain + shift;
            }
        }
        out
    }
}

/// The Gaussian error linear unit: x times the probability that a normal number is below x.
pub(super) fn gelu(values: &mut Array2<f32>) {
    values.iter_mut().for_each(|x| *x *= 0.5 * (1.0 + libm::erff(*x * FRAC_1_SQRT_2)));
}
