//! Samples in a drawn order, by minibatches.

use random::{BitGenerator, Generator};

/// The order of samples, and how many of them make a step.
pub(super) struct Minibatches {
    order: Vec<usize>,
    batch: usize,
}

impl Minibatches {
    /// All of `samples` in their own order, by at most `batch`.
    pub fn new(samples: usize, batch: usize) -> Self {
        Minibatches { order: (0..samples).collect(), batch: batch.max(1) }
    }

    /// Draws another order.
    pub fn shuffle(&mut self, rng: &mut Generator<impl BitGenerator>) {
        rng.shuffle(&mut self.order);
    }

    /// The samples of each step. A last step of less than half of the others is left out.
    pub fn iter(&self) -> impl Iterator<Item = &[usize]> {
        let whole = self.order.len().min(self.batch);
        self.order.chunks(self.batch).filter(move |rows| rows.len() * 2 >= whole)
    }

    /// The rows of these samples, `width` numbers each as there are for every sample.
    pub fn gather(&self, rows: &[usize], values: &[f32]) -> Vec<f32> {
        let width = values.len() / self.order.len().max(1);
        rows.iter().flat_map(|row| &values[row * width..(row + 1) * width]).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_is_in_one_step() {
        let mut batches = Minibatches::new(23, 5);
        batches.shuffle(&mut Generator::pcg64(2_u64));
        let mut rows: Vec<usize> = batches.iter().flatten().copied().collect();
        assert_ne!(rows, (0..23).collect::<Vec<_>>());
        rows.sort_unstable();
        assert_eq!(rows, (0..23).collect::<Vec<_>>());
        let values: Vec<f32> = (0..46).map(|k| k as f32).collect();
        assert_eq!(batches.gather(&[3, 0], &values), [6.0, 7.0, 0.0, 1.0]);
        assert_eq!(Minibatches::new(11, 5).iter().count(), 2, "one sample makes no step");
    }
}
