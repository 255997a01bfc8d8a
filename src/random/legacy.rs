//! numpy's legacy `RandomState`, which is also the module `numpy.random`.

use crate::bounds::{self, Bounds, Integer, Method};
use crate::choice::{self, Sampling};
use crate::normal::{self, Normal};
use crate::uniform::{self, Interval};
use crate::{BitGenerator, Mt19937, Mt19937State, RandomError};

/// Draws as numpy's `RandomState` makes them.
///
/// ```
/// use robohive_random::RandomState;
/// // numpy.random.seed(0); numpy.random.rand(2); numpy.random.randint(0, 5)
/// let mut random = RandomState::new(0);
/// let mut pair = [0.0; 2];
/// random.fill_random(&mut pair);
/// assert_eq!(pair, [0.5488135039273248, 0.7151893663724195]);
/// assert_eq!(random.randint(0..5)?, 3);
///
/// let saved = random.state();
/// let next = random.standard_normal();
/// assert_eq!(RandomState::from_state(&saved)?.standard_normal(), next);
/// # Ok::<(), robohive_random::RandomError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RandomState {
    bits: Mt19937,
    /// Second of the last two normal draws.
    normal: Option<f64>,
}

/// The state of a [`RandomState`] under numpy's names: `get_state(legacy=False)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomStateSnapshot {
    /// The source of bits.
    pub state: Mt19937State,
    /// True when `gauss` is the next normal draw.
    pub has_gauss: bool,
    /// A normal number drawn and not yet given out.
    pub gauss: f64,
}

impl RandomState {
    /// `RandomState(seed)`, or `numpy.random.seed(seed)`.
    pub fn new(seed: u32) -> Self {
        Mt19937::from_legacy_seed(seed).into()
    }

    /// `RandomState([…])`: a sequence of seeds. A sequence of one number is not the number itself.
    ///
    /// # Errors
    /// [`RandomError::EmptyKey`].
    pub fn from_key(key: &[u32]) -> Result<Self, RandomError> {
        Ok(Mt19937::from_legacy_key(key)?.into())
    }

    /// The state, to be kept.
    pub fn state(&self) -> RandomStateSnapshot {
        RandomStateSnapshot {
            state: self.bits.state(),
            has_gauss: self.normal.is_some(),
            gauss: self.normal.unwrap_or_default(),
        }
    }

    /// Goes on from `snapshot`.
    ///
    /// # Errors
    /// [`RandomError::BadState`].
    pub fn from_state(snapshot: &RandomStateSnapshot) -> Result<Self, RandomError> {
        let normal = snapshot.has_gauss.then_some(snapshot.gauss);
        Ok(RandomState { bits: Mt19937::from_state(&snapshot.state)?, normal })
    }

    /// A number in [0, 1): `random_sample()`, `rand()`.
    pub fn random(&mut self) -> f64 {
        self.bits.next_f64()
    }

    /// Numbers in [0, 1).
    pub fn fill_random(&mut self, out: &mut [f64]) {
        out.fill_with(|| self.bits.next_f64());
    }

    /// A number between `low` and `high`, which may be in either order.
    ///
    /// # Errors
    /// Intervals without a finite length.
    pub fn uniform(&mut self, low: f64, high: f64) -> Result<f64, RandomError> {
        Ok(Interval::between(low, high)?.draw(&mut self.bits))
    }

    /// Numbers between `low` and `high`.
    ///
    /// # Errors
    /// Intervals without a finite length.
    pub fn fill_uniform(&mut self, low: f64, high: f64, out: &mut [f64]) -> Result<(), RandomError> {
        let interval = Interval::between(low, high)?;
        out.fill_with(|| interval.draw(&mut self.bits));
        Ok(())
    }

    /// Numbers, each between its own `low` and its own `high`.
    ///
    /// # Errors
    /// Slices of different lengths; intervals without a finite length.
    pub fn fill_uniform_each(
        &mut self,
        low: &[f64],
        high: &[f64],
        out: &mut [f64],
    ) -> Result<(), RandomError> {
        uniform::fill_each(&mut self.bits, Interval::between, [low, high], out)
    }

    /// A number of mean 0 and standard deviation 1: `standard_normal()`, `randn()`.
    pub fn standard_normal(&mut self) -> f64 {
        self.normal.take().unwrap_or_else(|| {
            let [first, second] = normal::polar(&mut self.bits);
            self.normal = Some(second);
            first
        })
    }

    /// Numbers of mean 0 and standard deviation 1.
    pub fn fill_standard_normal(&mut self, out: &mut [f64]) {
        out.fill_with(|| self.standard_normal());
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
        out.fill_with(|| normal.of_standard(self.standard_normal()));
        Ok(())
    }

    /// An integer of the range.
    ///
    /// # Errors
    /// [`RandomError::EmptyRange`].
    pub fn randint<T: Integer>(&mut self, bounds: impl Into<Bounds<T>>) -> Result<T, RandomError> {
        let bounds = bounds.into();
        let mut one = [bounds.first_and_span()?.0];
        bounds::fill(&mut self.bits, bounds, Method::Mask, &mut one)?;
        Ok(one[0])
    }

    /// Integers of the range.
    ///
    /// # Errors
    /// [`RandomError::EmptyRange`].
    pub fn fill_randint<T: Integer>(
        &mut self,
        bounds: impl Into<Bounds<T>>,
        out: &mut [T],
    ) -> Result<(), RandomError> {
        bounds::fill(&mut self.bits, bounds.into(), Method::Mask, out)
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
            Sampling::WithReplacement => choice::with_replacement(bits, population, count, Method::Mask),
            Sampling::WithoutReplacement | Sampling::Unordered => {
                let mut order = choice::permutation(bits, population)?;
                order.truncate(count);
                Ok(order)
            }
            Sampling::Weighted(weights) => choice::weighted(bits, weights, count),
            Sampling::WeightedWithoutReplacement(weights) => {
                choice::weighted_without_replacement(bits, weights, count)
            }
        }
    }

    /// One of `items`.
    ///
    /// # Errors
    /// [`RandomError::EmptyPopulation`].
    pub fn choose<'a, T>(&mut self, items: &'a [T]) -> Result<&'a T, RandomError> {
        let last = items.len().checked_sub(1).ok_or(RandomError::EmptyPopulation)?;
        Ok(&items[bounds::up_to(&mut self.bits, last as u64, Method::Mask) as usize])
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

/// `RandomState(MT19937(…))`.
impl From<Mt19937> for RandomState {
    fn from(bits: Mt19937) -> Self {
        RandomState { bits, normal: None }
    }
}
