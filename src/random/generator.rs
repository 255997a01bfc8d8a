//! numpy's `Generator`.

use crate::bounds::{self, Bounds, Integer, Method};
use crate::choice::{self, Sampling};
use crate::normal::{self, Normal};
use crate::uniform::{self, Interval};
use crate::{BitGenerator, Mt19937, Pcg64, RandomError, SeedSequence};

/// Draws as numpy's `Generator` makes them, from any source of bits.
///
/// ```
/// use robohive_random::Generator;
/// // numpy.random.default_rng(0).uniform([-1, 0], [1, 2])
/// let mut generator = Generator::pcg64(0_u64);
/// let mut position = [0.0; 2];
/// generator.fill_uniform_each(&[-1.0, 0.0], &[1.0, 2.0], &mut position)?;
/// assert_eq!(position, [0.2739233746429086, 0.5395734275277406]);
/// # Ok::<(), robohive_random::RandomError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generator<B> {
    bits: B,
}

impl Generator<Pcg64> {
    /// `default_rng(seed)`, which is also gymnasium's `np_random`.
    pub fn pcg64(seed: impl Into<SeedSequence>) -> Self {
        Generator::new(Pcg64::new(seed))
    }
}

impl Generator<Mt19937> {
    /// `Generator(MT19937(seed))`.
    pub fn mt19937(seed: impl Into<SeedSequence>) -> Self {
        Generator::new(Mt19937::new(seed))
    }
}

impl<B: BitGenerator> Generator<B> {
    /// Draws from `bits`.
    pub fn new(bits: B) -> Self {
        Generator { bits }
    }

    /// The source of bits, whose state decides all further draws.
    pub fn bits(&self) -> &B {
        &self.bits
    }

    /// A number in [0, 1).
    pub fn random(&mut self) -> f64 {
        self.bits.next_f64()
    }

    /// Numbers in [0, 1).
    pub fn fill_random(&mut self, out: &mut [f64]) {
        out.fill_with(|| self.bits.next_f64());
    }

    /// A number from `low` up to `high`.
    ///
    /// # Errors
    /// Intervals that are reversed or have no finite length.
    pub fn uniform(&mut self, low: f64, high: f64) -> Result<f64, RandomError> {
        Ok(Interval::upward(low, high)?.draw(&mut self.bits))
    }

    /// Numbers from `low` up to `high`.
    ///
    /// # Errors
    /// Intervals that are reversed or have no finite length.
    pub fn fill_uniform(&mut self, low: f64, high: f64, out: &mut [f64]) -> Result<(), RandomError> {
        let interval = Interval::upward(low, high)?;
        out.fill_with(|| interval.draw(&mut self.bits));
        Ok(())
    }

    /// Numbers, each from its own `low` up to its own `high`.
    ///
    /// # Errors
    /// Slices of different lengths; intervals that are reversed or have no finite length.
    pub fn fill_uniform_each(
        &mut self,
        low: &[f64],
        high: &[f64],
        out: &mut [f64],
    ) -> Result<(), RandomError> {
        uniform::fill_each(&mut self.bits, Interval::upward, [low, high], out)
    }

    /// A number of mean 0 and standard deviation 1.
    pub fn standard_normal(&mut self) -> f64 {
        normal::ziggurat(&mut self.bits)
    }

    /// Numbers of mean 0 and standard deviation 1.
    pub fn fill_standard_normal(&mut self, out: &mut [f64]) {
        out.fill_with(|| normal::ziggurat(&mut self.bits));
    }

    /// A normal number of this mean and standard deviation.
    ///
    /// # Errors
    /// [`RandomError::BadScale`].
    pub fn normal(&mut self, mean: f64, scale: f64) -> Result<f64, RandomError> {
        Ok(Normal::new(mean, scale)?.of_standard(self.standard_normal()))
    }

    /// Normal numbers of this mean and standard deviation.
    ///
    /// # Errors
    /// [`RandomError::BadScale`].
    pub fn fill_normal(&mut self, mean: f64, scale: f64, out: &mut [f64]) -> Result<(), RandomError> {
        let normal = Normal::new(mean, scale)?;
        out.fill_with(|| normal.of_standard(normal::ziggurat(&mut self.bits)));
        Ok(())
    }

    /// An integer of the range.
    ///
    /// ```
    /// # use robohive_random::Generator;
    /// let mut generator = Generator::pcg64(1_u64);
    /// let die = generator.integer(1..=6)?;
    /// let byte: u8 = generator.integer(0..=u8::MAX)?;
    /// let any = generator.integer(i64::MIN..=i64::MAX)?;
    /// assert_eq!((die, byte, any), (3, 243, 8309588520621746278));
    /// # Ok::<(), robohive_random::RandomError>(())
    /// ```
    ///
    /// # Errors
    /// [`RandomError::EmptyRange`].
    pub fn integer<T: Integer>(&mut self, bounds: impl Into<Bounds<T>>) -> Result<T, RandomError> {
        let bounds = bounds.into();
        let mut one = [bounds.first_and_span()?.0];
        bounds::fill(&mut self.bits, bounds, Method::Multiply, &mut one)?;
        Ok(one[0])
    }

    /// Integers of the range.
    ///
    /// # Errors
    /// [`RandomError::EmptyRange`].
    pub fn fill_integers<T: Integer>(
        &mut self,
        bounds: impl Into<Bounds<T>>,
        out: &mut [T],
    ) -> Result<(), RandomError> {
        bounds::fill(&mut self.bits, bounds.into(), Method::Multiply, out)
    }

    /// `count` indices below `population`.
    ///
    /// # Errors
    /// Choices among nothing, of more than there is, or by bad weights.
    pub fn choice(
        &mut self,
        population: usize,
        count: usize,
        sampling: Sampling,
    ) -> Result<Vec<usize>, RandomError> {
        choice::check(population, count, sampling)?;
        let bits = &mut self.bits;
        match sampling {
            Sampling::WithReplacement => choice::with_replacement(bits, population, count, Method::Multiply),
            Sampling::WithoutReplacement => choice::without_replacement(bits, population, count, true),
            Sampling::Unordered => choice::without_replacement(bits, population, count, false),
            Sampling::Weighted(weights) => choice::weighted(bits, weights, count),
            Sampling::WeightedWithoutReplacement(weights) => {
                choice::weighted_without_replacement(bits, weights, count)
            }
        }
    }

    /// One of `items`.
    ///
    /// ```
    /// # use robohive_random::Generator;
    /// let shapes = ["sphere", "capsule", "ellipsoid", "cylinder", "box"];
    /// assert_eq!(Generator::pcg64(5_u64).choose(&shapes)?, &"cylinder");
    /// # Ok::<(), robohive_random::RandomError>(())
    /// ```
    ///
    /// # Errors
    /// [`RandomError::EmptyPopulation`].
    pub fn choose<'a, T>(&mut self, items: &'a [T]) -> Result<&'a T, RandomError> {
        let last = items.len().checked_sub(1).ok_or(RandomError::EmptyPopulation)?;
        Ok(&items[bounds::up_to(&mut self.bits, last as u64, Method::Multiply) as usize])
    }

    /// Brings `items` into random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        choice::shuffle(&mut self.bits, items);
    }

    /// The numbers below `count` in random order.
    ///
    /// # Errors
    /// [`RandomError::OutOfMemory`].
    pub fn permutation(&mut self, count: usize) -> Result<Vec<usize>, RandomError> {
        choice::permutation(&mut self.bits, count)
    }
}
