//! Self-attention: every token takes from all others, by how well what it asks for fits what they offer.

use super::token::{Linear, LinearShape};
use crate::weights::{Parameter, Parameters};
use ndarray::linalg::general_mat_mul;
use ndarray::{Array2, ArrayView2, Axis, Slice};

/// Self-attention with several heads.
pub(super) struct Attention {
    heads: usize,
    /// Queries, keys and values of all heads, one after the other.
    offer: Linear,
    merge: Linear,
}

impl Attention {
    fn shapes(path: &str, width: usize) -> [LinearShape; 2] {
        [
            LinearShape { name: format!("{path}.qkv"), inputs: width, outputs: 3 * width },
            LinearShape { name: format!("{path}.proj"), inputs: width, outputs: width },
        ]
    }

    pub fn layout(path: &str, width: usize) -> Vec<Parameter> {
        Self::shapes(path, width).iter().flat_map(LinearShape::layout).collect()
    }

    pub fn new(path: &str, width: usize, heads: usize, parameters: &mut Parameters) -> Self {
        let [offer, merge] = Self::shapes(path, width).map(|shape| Linear::new(&shape, parameters));
        Attention { heads, offer, merge }
    }

    /// Adds to `out` what the tokens take from one another; all are tokens × width.
    pub fn add(&self, tokens: ArrayView2<'_, f32>, out: &mut Array2<f32>) {
        let (count, width) = tokens.dim();
        let offered = self.offer.apply(tokens);
        let each = width / self.heads;
        let scale = 1.0 / (each as f32).sqrt();
        let mut taken = Array2::zeros((count, width));
        let mut shares = Array2::zeros((count, count));
        for head in 0..self.heads {
            let columns = |k: usize| Slice::from(k * width + head * each..k * width + (head + 1) * each);
            let part = |k: usize| offered.slice_axis(Axis(1), columns(k));
            general_mat_mul(scale, &part(0), &part(1).t(), 0.0, &mut shares);
            shares.rows_mut().into_iter().for_each(|mut row| {
                softmax(row.as_slice_mut().expect("the rows of a fresh array are contiguous"));
            });
            let mut own = taken.slice_axis_mut(Axis(1), columns(0));
            general_mat_mul(1.0, &shares, &part(2), 0.0, &mut own);
        }
        self.merge.add(taken.view(), out);
    }
}

/// Turns numbers into shares of one: exponentials over their sum.
fn softmax(row: &mut [f32]) {
    let highest = row.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    row.iter_mut().for_each(|value| *value = libm::expf(*value - highest));
    let sum: f32 = row.iter().sum();
    row.iter_mut().for_each(|value| *value /= sum);
}
