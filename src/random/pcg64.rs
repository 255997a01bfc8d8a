//! The generator PCG XSL RR 128/64 (O'Neill, "PCG: a family of simple fast space-efficient statistically good
//! algorithms for random number generation", 2014), with numpy's seeding and its stream of 32 bits.

use crate::{BitGenerator, RandomError, SeedSequence};

/// Multiplier of the linear congruence.
const MULTIPLIER: u128 = 0x2360_ed05_1fc6_5da4_4385_df64_9fcc_f645;
/// Weight of one unit of a number of 53 bits, 2⁻⁵³.
const UNIT: f64 = 1.0 / (1_u64 << 53) as f64;

/// numpy's `PCG64`, the generator of `default_rng`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pcg64 {
    state: u128,
    increment: u128,
    /// Upper half of the last 64 bits, when their lower half was drawn alone.
    half: Option<u32>,
}

/// The state of a [`Pcg64`] under numpy's names: `bit_generator.state`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pcg64State {
    /// State of the congruence.
    pub state: u128,
    /// Increment of the congruence; odd.
    pub inc: u128,
    /// True when `uinteger` is the next draw of 32 bits.
    pub has_uint32: bool,
    /// 32 bits drawn and not yet given out.
    pub uinteger: u32,
}

impl Pcg64 {
    /// The generator that numpy seeds with this number.
    pub fn new(seed: impl Into<SeedSequence>) -> Self {
        let words: [u32; 8] = seed.into().generate_state();
        // Words come as numbers of 64 bits, lower half first; of two such numbers the first is the upper
        // half.
        let wide = |k: usize| [1, 0, 3, 2].iter().fold(0, |n, &j| (n << 32) | u128::from(words[4 * k + j]));
        let mut generator = Pcg64 { state: 0, increment: (wide(1) << 1) | 1, half: None };
        generator.advance();
        generator.state = generator.state.wrapping_add(wide(0));
        generator.advance();
        generator
    }

    /// The state, to be kept.
    pub fn state(&self) -> Pcg64State {
        Pcg64State {
            state: self.state,
            inc: self.increment,
            has_uint32: self.half.is_some(),
            uinteger: self.half.unwrap_or_default(),
        }
    }

    /// A generator that goes on from `state`.
    ///
    /// # Errors
    /// [`RandomError::BadState`] when the increment is even, which no seed leads to.
    pub fn from_state(state: &Pcg64State) -> Result<Self, RandomError> {
        if state.inc.is_multiple_of(2) {
            return Err(RandomError::BadState { what: "the increment of a PCG64 must be odd" });
        }
        let half = state.has_uint32.then_some(state.uinteger);
        Ok(Pcg64 { state: state.state, increment: state.inc, half })
    }

    fn advance(&mut self) {
        self.state = self.state.wrapping_mul(MULTIPLIER).wrapping_add(self.increment);
    }
}

impl BitGenerator for Pcg64 {
    #[inline]
    fn next_u32(&mut self) -> u32 {
        self.half.take().unwrap_or_else(|| {
            let both = self.next_u64();
            self.half = Some((both >> 32) as u32);
            both as u32
        })
    }

    #[inline]
    fn next_u64(&mut self) -> u64 {
        self.advance();
        let folded = (self.state >> 64) as u64 ^ self.state as u64;
        folded.rotate_right((self.state >> 122) as u32)
    }

    #[inline]
    fn next_f64(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * UNIT
    }
}
