//! The Mersenne Twister (Matsumoto, Nishimura, "Mersenne Twister: a 623-dimensionally equidistributed uniform
//! pseudorandom number generator", 1998; seeding by arrays: their `mt19937ar`, 2002).

use crate::{BitGenerator, RandomError, SeedSequence};

/// Words of the state.
const WORDS: usize = 624;
/// Distance of the words that the recurrence combines.
const DISTANCE: usize = 397;

/// numpy's `MT19937`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mt19937 {
    words: [u32; WORDS],
    /// Next word to give out; [`WORDS`] when the state must be renewed first.
    position: usize,
}

/// The state of a [`Mt19937`] under numpy's names: `bit_generator.state['state']`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mt19937State {
    /// The words of the recurrence.
    pub key: [u32; WORDS],
    /// Number of words given out since they were renewed, 0 to 624.
    pub pos: usize,
}

impl Mt19937 {
    /// The generator that numpy seeds with this number: `MT19937(seed)`.
    pub fn new(seed: impl Into<SeedSequence>) -> Self {
        let mut words: [u32; WORDS] = seed.into().generate_state();
        words[0] = 1 << 31;
        // numpy starts at the last word, not behind it.
        Mt19937 { words, position: WORDS - 1 }
    }

    /// The generator behind `RandomState(seed)`.
    pub fn from_legacy_seed(seed: u32) -> Self {
        let mut words = [seed; WORDS];
        for k in 1..WORDS {
            words[k] = spread(words[k - 1]).wrapping_mul(1_812_433_253).wrapping_add(k as u32);
        }
        Mt19937 { words, position: WORDS }
    }

    /// The generator behind `RandomState([…])`.
    ///
    /// # Errors
    /// [`RandomError::EmptyKey`] when there is no number.
    pub fn from_legacy_key(key: &[u32]) -> Result<Self, RandomError> {
        if key.is_empty() {
            return Err(RandomError::EmptyKey);
        }
        let mut words = Mt19937::from_legacy_seed(19_650_218).words;
        let mut previous = words[0];
        let mut places = (1..WORDS).cycle();
        let numbers = (0_u32..).zip(key).take(key.len()).cycle();
        for (place, (k, number)) in places.by_ref().zip(numbers).take(key.len().max(WORDS)) {
            let mixed = words[place] ^ spread(previous).wrapping_mul(1_664_525);
            previous = mixed.wrapping_add(*number).wrapping_add(k);
            words[place] = previous;
        }
        for place in places.take(WORDS - 1) {
            let mixed = words[place] ^ spread(previous).wrapping_mul(1_566_083_941);
            previous = mixed.wrapping_sub(place as u32);
            words[place] = previous;
        }
        // Not all words may be zero.
        words[0] = 1 << 31;
        Ok(Mt19937 { words, position: WORDS })
    }

    /// The state, to be kept.
    pub fn state(&self) -> Mt19937State {
        Mt19937State { key: self.words, pos: self.position }
    }

    /// A generator that goes on from `state`.
    ///
    /// # Errors
    /// [`RandomError::BadState`] when the position is beyond the last word, or all bits that decide what
    /// follows are zero.
    pub fn from_state(state: &Mt19937State) -> Result<Self, RandomError> {
        if state.pos > WORDS {
            return Err(RandomError::BadState { what: "the position of an MT19937 must be from 0 to 624" });
        }
        if state.key[0] >> 31 == 0 && state.key[1..].iter().all(|&word| word == 0) {
            return Err(RandomError::BadState { what: "the words of an MT19937 must not all be zero" });
        }
        Ok(Mt19937 { words: state.key, position: state.pos })
    }

    /// Applies the recurrence to every word.
    fn renew(&mut self) {
        let wrapped = |k: usize| if k < WORDS { k } else { k - WORDS };
        for k in 0..WORDS {
            let joined = (self.words[k] & 1 << 31) | (self.words[wrapped(k + 1)] & !(1 << 31));
            let twist = if joined & 1 == 1 { 0x9908_b0df } else { 0 };
            self.words[k] = self.words[wrapped(k + DISTANCE)] ^ (joined >> 1) ^ twist;
        }
        self.position = 0;
    }
}

/// Carries the two highest bits of a word into its lowest ones.
fn spread(word: u32) -> u32 {
    word ^ (word >> 30)
}

impl BitGenerator for Mt19937 {
    #[inline]
    fn next_u32(&mut self) -> u32 {
        if self.position >= WORDS {
            self.renew();
        }
        let mut word = self.words[self.position];
        self.position += 1;
        word ^= word >> 11;
        word ^= (word << 7) & 0x9d2c_5680;
        word ^= (word << 15) & 0xefc6_0000;
        word ^ (word >> 18)
    }

    #[inline]
    fn next_u64(&mut self) -> u64 {
        let upper = u64::from(self.next_u32());
        upper << 32 | u64::from(self.next_u32())
    }

    #[inline]
    fn next_f64(&mut self) -> f64 {
        let upper = u64::from(self.next_u32() >> 5);
        let both = upper << 26 | u64::from(self.next_u32() >> 6);
        both as f64 / (1_u64 << 53) as f64
    }
}
