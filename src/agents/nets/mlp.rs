//! A multilayer perceptron, its gradient and its directional derivative, for batches of rows.
//!
//! A network is a shape: parameters are one vector apart from it, so that optimisers, averages and files see numbers in a row. A [`Tape`] holds
//! the values of a batch on their way through, which both derivatives need.

use super::activation::Activation;
use super::kernel::{View, add_product};
use super::layer_norm;
use crate::archive::{Entry, Numbers};
use random::{BitGenerator, Generator};
use std::ops::Range;

/// The shape of a network: affine layers, the hidden ones followed by an activation.
#[derive(Clone, Debug, PartialEq)]
pub struct Mlp {
    layers: Vec<Layer>,
    activation: Activation,
    /// Whether what enters an activation is normalised over the layer first.
    normalized: bool,
}

/// An affine map.
#[derive(Clone, Debug, PartialEq)]
struct Layer {
    inputs: usize,
    outputs: usize,
    /// Places among the parameters: of the weights, a row for each input, and of what is added.
    weight: Range<usize>,
    bias: Range<usize>,
}

/// What a batch became from layer to layer.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    rows: usize,
    /// The input, and what each layer made of it, activation included; row after row.
    values: Vec<Vec<f32>>,
    /// Of each hidden layer that is normalised, the reciprocal deviation of each row and the normalised rows.
    norms: Vec<layer_norm::Tape>,
}

impl Tape {
    /// Rows of the batch.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The network's output, `[rows × outputs]`.
    pub fn output(&self) -> &[f32] {
        self.values.last().map_or(&[], Vec::as_slice)
    }
}

impl Mlp {
    /// A network of these widths, from its inputs to its outputs.
    ///
    /// # Panics
    /// There are less than two widths, or one is zero.
    pub fn new(widths: &[usize], activation: Activation, normalized: bool) -> Self {
        assert!(widths.len() >= 2 && !widths.contains(&0), "a network of the widths {widths:?}");
        let mut next = 0;
        let layers = widths.windows(2).map(|pair| {
            let (inputs, outputs) = (pair[0], pair[1]);
            let weight = next..next + inputs * outputs;
            let bias = weight.end..weight.end + outputs;
            next = bias.end;
            Layer { inputs, outputs, weight, bias }
        });
        Mlp { layers: layers.collect(), activation, normalized }
    }

    /// Number of inputs.
    pub fn inputs(&self) -> usize {
        self.layers[0].inputs
    }

    /// Number of outputs.
    pub fn outputs(&self) -> usize {
        self.layers[self.layers.len() - 1].outputs
    }

    /// Number of parameters.
    pub fn parameters(&self) -> usize {
        self.layers[self.layers.len() - 1].bias.end
    }

    /// The parameters by layers, and what follows them.
    pub(crate) fn entries<'a>(&self, mut parameters: &'a mut [f32]) -> (Vec<Entry<'a>>, &'a mut [f32]) {
        let mut entries = Vec::new();
        for (k, layer) in self.layers.iter().enumerate() {
            let (weight, rest) = parameters.split_at_mut(layer.weight.len());
            let (bias, rest) = rest.split_at_mut(layer.bias.len());
            entries.push(Entry::matrix(format!("{k}.weight"), layer.inputs, Numbers::F32(weight)));
            entries.push(Entry::new(format!("{k}.bias"), Numbers::F32(bias)));
            parameters = rest;
        }
        (entries, parameters)
    }

    /// Draws parameters: weights uniformly within `±1/√inputs`, those of the last layer `last` times as large; nothing is added.
    pub fn draw(&self, last: f32, rng: &mut Generator<impl BitGenerator>) -> Vec<f32> {
        let mut parameters = vec![0.0; self.parameters()];
        for (k, layer) in self.layers.iter().enumerate() {
            let bound =
                if k + 1 == self.layers.len() { f64::from(last) } else { 1.0 } / (layer.inputs as f64).sqrt();
            for weight in &mut parameters[layer.weight.clone()] {
                *weight = ((2.0 * rng.random() - 1.0) * bound) as f32;
            }
        }
        parameters
    }

    /// Computes the outputs of a batch, row after row, and keeps what the derivatives need.
    ///
    /// # Panics
    /// `input` has no whole number of rows, or there are other parameters.
    pub fn forward(&self, parameters: &[f32], input: &[f32], tape: &mut Tape) {
        self.check(parameters);
        assert!(input.len().is_multiple_of(self.inputs()), "{} inputs of {}", input.len(), self.inputs());
        tape.rows = input.len() / self.inputs();
        tape.values.resize_with(self.layers.len() + 1, Vec::new);
        tape.norms.resize_with(self.layers.len() - 1, Default::default);
        tape.values[0].clear();
        tape.values[0].extend_from_slice(input);
        for (k, layer) in self.layers.iter().enumerate() {
            let (from, to) = tape.values.split_at_mut(k + 1);
            let (from, to) = (&from[k], &mut to[0]);
            to.clear();
            (0..tape.rows).for_each(|_| to.extend_from_slice(&parameters[layer.bias.clone()]));
            add_product(View::rows(from, layer.inputs), &parameters[layer.weight.clone()], layer.inputs, to);
            if k + 1 < self.layers.len() {
                if self.normalized {
                    layer_norm::forward(layer.outputs, to, &mut tape.norms[k]);
                }
                self.activation.apply(to);
            }
        }
    }

    /// Adds the gradient of a loss to `gradient`, from its slopes by the outputs of the batch on the tape, and gives its slopes by the inputs.
    ///
    /// # Panics
    /// `slopes` or `gradient` has another size than outputs or parameters.
    pub fn backward(
        &self,
        parameters: &[f32],
        tape: &Tape,
        slopes: &[f32],
        gradient: &mut [f32],
    ) -> Vec<f32> {
        self.check(gradient);
        self.propagate(parameters, tape, slopes, Some(gradient))
    }

    /// Gives the slopes of a loss by the inputs alone, from those by the outputs of the batch on the tape.
    ///
    /// # Panics
    /// `slopes` has another size than the outputs.
    pub fn input_slopes(&self, parameters: &[f32], tape: &Tape, slopes: &[f32]) -> Vec<f32> {
        self.propagate(parameters, tape, slopes, None)
    }

    fn propagate(
        &self,
        parameters: &[f32],
        tape: &Tape,
        slopes: &[f32],
        mut gradient: Option<&mut [f32]>,
    ) -> Vec<f32> {
        self.check(parameters);
        assert_eq!(slopes.len(), tape.rows * self.outputs(), "slopes of the outputs");
        let mut slopes = slopes.to_vec();
        for (k, layer) in self.layers.iter().enumerate().rev() {
            if k + 1 < self.layers.len() {
                self.activation.scale_by_derivative(&tape.values[k + 1], &mut slopes);
                if self.normalized {
                    layer_norm::derivative(layer.outputs, &tape.norms[k], &mut slopes);
                }
            }
            if let Some(gradient) = &mut gradient {
                let input = View::transposed(&tape.values[k], layer.inputs);
                add_product(input, &slopes, tape.rows, &mut gradient[layer.weight.clone()]);
                for row in slopes.chunks_exact(layer.outputs) {
                    gradient[layer.bias.clone()].iter_mut().zip(row).for_each(|(sum, slope)| *sum += slope);
                }
            }
            let turned = transpose(&parameters[layer.weight.clone()], layer.outputs);
            let mut before = vec![0.0; tape.rows * layer.inputs];
            add_product(View::rows(&slopes, layer.outputs), &turned, layer.outputs, &mut before);
            slopes = before;
        }
        slopes
    }

    /// How the outputs of the batch on the tape change with the parameters along a direction, `[rows × outputs]`.
    ///
    /// # Panics
    /// There are other parameters, or other numbers in the direction.
    pub fn tangent(&self, parameters: &[f32], direction: &[f32], tape: &Tape) -> Vec<f32> {
        self.check(parameters);
        self.check(direction);
        let mut change = vec![0.0; tape.rows * self.inputs()];
        for (k, layer) in self.layers.iter().enumerate() {
            let mut next = Vec::with_capacity(tape.rows * layer.outputs);
            (0..tape.rows).for_each(|_| next.extend_from_slice(&direction[layer.bias.clone()]));
            let (input, change_in) =
                (View::rows(&tape.values[k], layer.inputs), View::rows(&change, layer.inputs));
            add_product(input, &direction[layer.weight.clone()], layer.inputs, &mut next);
            if k > 0 {
                add_product(change_in, &parameters[layer.weight.clone()], layer.inputs, &mut next);
            }
            if k + 1 < self.layers.len() {
                if self.normalized {
                    layer_norm::derivative(layer.outputs, &tape.norms[k], &mut next);
                }
                self.activation.scale_by_derivative(&tape.values[k + 1], &mut next);
            }
            change = next;
        }
        change
    }

    fn check(&self, numbers: &[f32]) {
        assert_eq!(numbers.len(), self.parameters(), "numbers for the parameters of a network");
    }
}

/// The transpose of a matrix of `columns` columns, row after row.
fn transpose(values: &[f32], columns: usize) -> Vec<f32> {
    let rows = values.len() / columns;
    let mut turned = vec![0.0; values.len()];
    for (row, values) in values.chunks_exact(columns).enumerate() {
        for (column, value) in values.iter().enumerate() {
            turned[column * rows + row] = *value;
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    const BATCH: usize = 5;

    /// A network, parameters that are none of them small, and a batch.
    fn example(activation: Activation, normalized: bool) -> (Mlp, Vec<f32>, Vec<f32>) {
        let net = Mlp::new(&[3, 9, 6, 2], activation, normalized);
        let mut rng = Generator::pcg64(7_u64);
        let mut parameters = net.draw(1.0, &mut rng);
        parameters.iter_mut().for_each(|parameter| *parameter = *parameter * 1.5 + 0.05);
        let input = (0..BATCH * 3).map(|_| rng.random() as f32 * 4.0 - 2.0).collect();
        (net, parameters, input)
    }

    /// A weighted sum of the outputs, whose slopes are the weights.
    fn loss(net: &Mlp, parameters: &[f32], input: &[f32]) -> (f64, Vec<f32>, Tape) {
        let mut tape = Tape::default();
        net.forward(parameters, input, &mut tape);
        let slopes: Vec<f32> = (0..tape.output().len()).map(|k| 0.7 - 0.3 * k as f32).collect();
        let sum = tape.output().iter().zip(&slopes).map(|(y, slope)| f64::from(*y) * f64::from(*slope)).sum();
        (sum, slopes, tape)
    }

    /// Half the change of the loss from one value of a number to the other, over the step.
    fn slope(numbers: &[f32], place: usize, loss: impl Fn(&[f32]) -> f64) -> f64 {
        let step = 4e-3_f32;
        let at = |step: f32| {
            let mut numbers = numbers.to_vec();
            numbers[place] += step;
            (loss(&numbers), f64::from(numbers[place]))
        };
        let (above, below) = (at(step), at(-step));
        (above.0 - below.0) / (above.1 - below.1)
    }

    fn assert_near(what: &str, value: f32, expected: f64) {
        let error = (f64::from(value) - expected).abs();
        assert!(error < 2e-3 * expected.abs().max(0.3), "{what}: {value} where differences give {expected}");
    }

    #[test]
    fn gradients_are_differences() {
        for activation in [Activation::Tanh, Activation::Elu] {
            for normalized in [false, true] {
                let (net, parameters, input) = example(activation, normalized);
                let (_, slopes, tape) = loss(&net, &parameters, &input);
                let mut gradient = vec![0.0; net.parameters()];
                let inputs = net.backward(&parameters, &tape, &slopes, &mut gradient);
                assert_eq!(inputs, net.input_slopes(&parameters, &tape, &slopes));
                for (k, value) in gradient.iter().enumerate() {
                    let expected = slope(&parameters, k, |parameters| loss(&net, parameters, &input).0);
                    assert_near(&format!("{activation:?}, {normalized}, parameter {k}"), *value, expected);
                }
                for (k, value) in inputs.iter().enumerate() {
                    let expected = slope(&input, k, |input| loss(&net, &parameters, input).0);
                    assert_near(&format!("{activation:?}, {normalized}, input {k}"), *value, expected);
                }
            }
        }
    }

    #[test]
    fn a_relu_passes_slopes_of_what_is_positive() {
        let net = Mlp::new(&[1, 2, 1], Activation::Relu, false);
        // Hidden values 2x and -x, whose positive parts are weighted 3 and 5.
        let parameters = [2.0, -1.0, 0.0, 0.0, 3.0, 5.0, 0.0];
        let (mut tape, mut gradient) = (Tape::default(), vec![0.0; 7]);
        net.forward(&parameters, &[1.0, -2.0], &mut tape);
        assert_eq!(tape.output(), [6.0, 10.0]);
        let inputs = net.backward(&parameters, &tape, &[1.0, 1.0], &mut gradient);
        assert_eq!((inputs, gradient), (vec![6.0, -5.0], vec![3.0, -10.0, 3.0, 5.0, 2.0, 2.0, 2.0]));
    }

    #[test]
    fn tangents_and_gradients_are_one_derivative() {
        for normalized in [false, true] {
            let (net, parameters, input) = example(Activation::Tanh, normalized);
            let (_, slopes, tape) = loss(&net, &parameters, &input);
            let direction: Vec<f32> =
                (0..net.parameters()).map(|k| ((k * 37) % 19) as f32 / 9.0 - 1.0).collect();
            let change = net.tangent(&parameters, &direction, &tape);
            let mut gradient = vec![0.0; net.parameters()];
            net.backward(&parameters, &tape, &slopes, &mut gradient);
            let sum = |a: &[f32], b: &[f32]| -> f64 {
                a.iter().zip(b).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum()
            };
            let (forward, reverse) = (sum(&change, &slopes), sum(&gradient, &direction));
            assert!(
                (forward - reverse).abs() < 1e-5 * forward.abs() && forward.abs() > 0.1,
                "{forward} {reverse}"
            );
        }
    }

    #[test]
    fn rows_of_a_batch_have_the_bits_that_they_have_alone() {
        let (net, parameters, input) = example(Activation::Tanh, true);
        let together = loss(&net, &parameters, &input).2.output().to_vec();
        let alone = input.chunks(3).flat_map(|row| loss(&net, &parameters, row).2.output().to_vec());
        assert!(together.iter().zip(alone).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}
