//! Adam, with decoupled weight decay (Kingma and Ba, 2015, algorithm 1; Loshchilov and Hutter, 2019, algorithm 2).

use crate::archive::{Entry, Numbers};

/// Decay of the averages, and what keeps a step finite.
const DECAY: [f32; 2] = [0.9, 0.999];
const FLOOR: f32 = 1e-8;

/// The state of an optimiser of one vector of parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Adam {
    /// Steps made.
    steps: u64,
    /// Decaying averages of the gradient and of its square.
    mean: Vec<f32>,
    square: Vec<f32>,
}

impl Adam {
    /// Before the first step of `parameters` numbers.
    pub fn new(parameters: usize) -> Self {
        Adam { steps: 0, mean: vec![0.0; parameters], square: vec![0.0; parameters] }
    }

    /// All that it is, by names.
    pub(crate) fn entries(&mut self) -> [Entry<'_>; 3] {
        [
            Entry::new("steps", Numbers::U64(std::slice::from_mut(&mut self.steps))),
            Entry::new("mean", Numbers::F32(&mut self.mean)),
            Entry::new("square", Numbers::F32(&mut self.square)),
        ]
    }

    /// Moves the parameters down the gradient by steps of the size `rate`, and shrinks them by `rate * decay`.
    ///
    /// # Panics
    /// There are other parameters than at first.
    pub fn step(&mut self, rate: f32, decay: f32, gradient: &[f32], parameters: &mut [f32]) {
        assert_eq!((gradient.len(), parameters.len()), (self.mean.len(), self.mean.len()));
        self.steps += 1;
        // Products of equal factors, since powers of a library differ in their last bits.
        let steps = self.steps.min(100_000) as i32;
        let unbias = DECAY.map(|decay| (1.0 - power(f64::from(decay), steps)) as f32);
        let moments = self.mean.iter_mut().zip(&mut self.square);
        for ((parameter, slope), (mean, square)) in parameters.iter_mut().zip(gradient).zip(moments) {
            *mean += (1.0 - DECAY[0]) * (slope - *mean);
            *square += (1.0 - DECAY[1]) * (slope * slope - *square);
            let step = (*mean / unbias[0]) / ((*square / unbias[1]).sqrt() + FLOOR);
            *parameter -= rate * (step + decay * *parameter);
        }
    }
}

/// `base` to the power `exponent`, by squares.
fn power(base: f64, exponent: i32) -> f64 {
    let (mut product, mut square, mut left) = (1.0, base, exponent);
    while left > 0 {
        if left & 1 == 1 {
            product *= square;
        }
        square *= square;
        left >>= 1;
    }
    product
}

/// Shortens a gradient to the length `longest` if it is longer, and gives the length that it had.
pub fn clip(gradient: &mut [f32], longest: f64) -> f64 {
    let length = gradient.iter().map(|slope| f64::from(*slope) * f64::from(*slope)).sum::<f64>().sqrt();
    if length > longest {
        let share = (longest / length) as f32;
        gradient.iter_mut().for_each(|slope| *slope *= share);
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_have_the_size_of_the_rate_and_end_in_the_valley() {
        let (mut adam, mut x) = (Adam::new(2), [3.0_f32, -2.0]);
        let slopes = |x: &[f32; 2]| [2.0 * (x[0] - 1.0), 20.0 * (x[1] + 1.0)];
        adam.step(0.1, 0.0, &slopes(&x), &mut x);
        assert!((x[0] - 2.9).abs() < 1e-6 && (x[1] + 1.9).abs() < 1e-6, "the first step is the rate: {x:?}");
        (0..500).for_each(|_| adam.step(0.05, 0.0, &slopes(&x), &mut x));
        assert!((x[0] - 1.0).abs() < 1e-3 && (x[1] + 1.0).abs() < 1e-3, "{x:?}");
    }

    #[test]
    fn decay_shrinks_what_has_no_slope() {
        let (mut adam, mut x) = (Adam::new(1), [2.0_f32]);
        adam.step(0.1, 0.5, &[0.0], &mut x);
        assert!((x[0] - 1.9).abs() < 1e-6, "{x:?}");
    }

    #[test]
    fn long_gradients_are_shortened() {
        let mut gradient = [3.0, 4.0];
        assert_eq!(clip(&mut gradient, 10.0), 5.0);
        assert_eq!(gradient, [3.0, 4.0]);
        assert_eq!(clip(&mut gradient, 1.0), 5.0);
        assert!((gradient[0] - 0.6).abs() < 1e-6 && (gradient[1] - 0.8).abs() < 1e-6, "{gradient:?}");
    }
}
