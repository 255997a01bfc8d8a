//! Feed-forward networks in double precision.

use crate::error::PolicyError;
use std::sync::Arc;

/// Keeps scales of zero from dividing, as mjrl does.
const SCALE_FLOOR: f64 = 1e-8;

/// An affine map.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Weights, a row for each output.
    pub weight: Vec<f64>,
    /// What is added to each output.
    pub bias: Vec<f64>,
}

/// `x ↦ shift + scale · f((x - shift') / scale')`, where `f` is affine layers with tanh between them.
#[derive(Clone, Debug)]
pub struct Network {
    /// Shared by copies.
    layers: Arc<[Layer]>,
    in_shift: Vec<f64>,
    in_scale: Vec<f64>,
    out_shift: Vec<f64>,
    out_scale: Vec<f64>,
    /// Values before and after the layer being computed.
    values: [Vec<f64>; 2],
}

/// Shift and scale of a vector.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Transformation {
    /// `None` where nothing is added.
    pub shift: Option<Vec<f64>>,
    /// `None` where nothing is scaled.
    pub scale: Option<Vec<f64>>,
}

impl Network {
    /// A network from `inputs` values to as many as the last layer has.
    ///
    /// # Errors
    /// There is no layer; lengths do not fit; a number is not finite.
    pub(crate) fn new(
        inputs: usize,
        layers: Vec<Layer>,
        before: Transformation,
        after: Transformation,
    ) -> Result<Self, PolicyError> {
        let mut width = inputs;
        for (k, layer) in layers.iter().enumerate() {
            if layer.bias.is_empty() || layer.weight.len() != width * layer.bias.len() {
                return Err(PolicyError::content(format!(
                    "layer {k} has {} weights and {} biases, which do not fit its {width} inputs",
                    layer.weight.len(),
                    layer.bias.len()
                )));
            }
            width = layer.bias.len();
        }
        if layers.is_empty() {
            return Err(PolicyError::content("the network has no layer"));
        }
        let network = Network {
            in_shift: filled(before.shift, inputs, 0.0, "the input's shift")?,
            in_scale: filled(before.scale, inputs, 1.0, "the input's scale")?,
            out_shift: filled(after.shift, width, 0.0, "the output's shift")?,
            out_scale: filled(after.scale, width, 1.0, "the output's scale")?,
            layers: layers.into(),
            values: [Vec::new(), Vec::new()],
        };
        let vectors = [&network.in_shift, &network.in_scale, &network.out_shift, &network.out_scale];
        let layers = network.layers.iter().flat_map(|layer| [&layer.weight, &layer.bias]);
        if vectors.into_iter().chain(layers).flatten().any(|number| !number.is_finite()) {
            return Err(PolicyError::content("the network holds NaN or infinities"));
        }
        Ok(network)
    }

    /// Number of inputs.
    pub fn inputs(&self) -> usize {
        self.in_shift.len()
    }

    /// Number of outputs.
    pub fn outputs(&self) -> usize {
        self.out_shift.len()
    }

    /// Computes the outputs.
    ///
    /// # Panics
    /// `input` or `output` is not as long as [`Network::inputs`] or [`Network::outputs`] says.
    pub fn compute(&mut self, input: &[f64], output: &mut [f64]) {
        assert_eq!((input.len(), output.len()), (self.inputs(), self.outputs()));
        let [mut from, mut to] = std::mem::take(&mut self.values);
        from.clear();
        let scales = self.in_shift.iter().zip(&self.in_scale);
        from.extend(input.iter().zip(scales).map(|(x, (shift, scale))| (x - shift) / (scale + SCALE_FLOOR)));
        for (k, layer) in self.layers.iter().enumerate() {
            let last = k + 1 == self.layers.len();
            let rows = layer.weight.chunks_exact(from.len()).zip(&layer.bias);
            to.clear();
            to.extend(rows.map(|(row, bias)| {
                let sum = row.iter().zip(&from).map(|(weight, x)| weight * x).sum::<f64>() + bias;
                if last { sum } else { libm::tanh(sum) }
            }));
            std::mem::swap(&mut from, &mut to);
        }
        for (k, output) in output.iter_mut().enumerate() {
            *output = from[k] * self.out_scale[k] + self.out_shift[k];
        }
        self.values = [from, to];
    }
}

/// `values`, or as many times `default` where there are none.
fn filled(values: Option<Vec<f64>>, len: usize, default: f64, what: &str) -> Result<Vec<f64>, PolicyError> {
    match values {
        None => Ok(vec![default; len]),
        Some(values) if values.len() == len => Ok(values),
        Some(values) => Err(PolicyError::content(format!("{what} has {} values, not {len}", values.len()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_and_scales_follow_one_another() {
        let layers = vec![
            Layer { weight: vec![1.0, 2.0, -1.0, 0.5], bias: vec![0.1, -0.2] },
            Layer { weight: vec![3.0, -4.0], bias: vec![0.5] },
        ];
        let before = Transformation { shift: Some(vec![1.0, 0.0]), scale: Some(vec![2.0, 1.0]) };
        let after = Transformation { shift: Some(vec![10.0]), scale: Some(vec![2.0]) };
        let mut network = Network::new(2, layers, before, after).unwrap();
        let mut output = [0.0];
        network.compute(&[3.0, -0.3], &mut output);
        // The input becomes (1, -0.3), but for the floor under its scales.
        let hidden = [(1.0 - 0.6 + 0.1f64).tanh(), (-1.0 - 0.15 - 0.2f64).tanh()];
        let expected = 10.0 + 2.0 * (3.0 * hidden[0] - 4.0 * hidden[1] + 0.5);
        assert!((output[0] - expected).abs() < 1e-7, "{output:?} {expected}");
        assert!(output[0] > 10.0, "the result is not trivial");
    }

    #[test]
    fn lengths_must_fit() {
        let none = Transformation::default;
        let layer = |weights, biases| Layer { weight: vec![1.0; weights], bias: vec![0.0; biases] };
        let message = |layers, before| match Network::new(2, layers, before, none()) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("the lengths do not fit"),
        };
        assert!(message(vec![layer(5, 2)], none()).contains("layer 0 has 5 weights"));
        assert!(message(vec![], none()).contains("no layer"));
        let short = Transformation { shift: Some(vec![0.0]), scale: None };
        assert!(message(vec![layer(4, 2)], short).contains("shift has 1 values, not 2"));
        let infinite = vec![Layer { weight: vec![f64::NAN, 0.0], bias: vec![0.0] }];
        assert!(message(infinite, none()).contains("NaN"));
    }
}
