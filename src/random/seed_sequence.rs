//! Seeds of any size, mixed into the states of generators (numpy's `SeedSequence`; after O'Neill, "Developing
//! a seed_seq alternative", 2015).

use crate::RandomError;
use std::str::FromStr;

/// Words in the pool that the entropy is mixed into.
const POOL: usize = 4;
/// Digits that a seed given as text may have.
const MAX_DIGITS: usize = 4096;

/// A non-negative integer of any size, or a sequence of them, as words of 32 bits, the lowest first.
///
/// ```
/// use robohive_random::{Entropy, SeedSequence};
/// let large: Entropy = "243799254704924441050048792905230269161".parse()?;
/// assert_eq!(SeedSequence::new(large).generate_state::<1>(), [0xb678_4e7f]);
/// let several: Entropy = [3, 1 << 40].into_iter().collect();
/// assert_eq!(several.words(), [3, 0, 256]);
/// # Ok::<(), robohive_random::RandomError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entropy(Vec<u32>);

impl Entropy {
    /// The words.
    pub fn words(&self) -> &[u32] {
        &self.0
    }
}

/// The words of `n` up to the highest that is not zero, at least one.
fn words_of(n: u128) -> impl Iterator<Item = u32> {
    let count = (128 - n.leading_zeros()).div_ceil(32).max(1);
    (0..count).map(move |k| (n >> (32 * k)) as u32)
}

impl From<u128> for Entropy {
    fn from(n: u128) -> Self {
        Entropy(words_of(n).collect())
    }
}

impl From<u64> for Entropy {
    fn from(n: u64) -> Self {
        u128::from(n).into()
    }
}

impl From<u32> for Entropy {
    fn from(n: u32) -> Self {
        u128::from(n).into()
    }
}

/// A sequence of integers, as `SeedSequence([3, 1])`.
impl FromIterator<u64> for Entropy {
    fn from_iter<I: IntoIterator<Item = u64>>(numbers: I) -> Self {
        Entropy(numbers.into_iter().flat_map(|n| words_of(n.into())).collect())
    }
}

/// A decimal integer, or a hexadecimal one after `0x`, of at most 4096 digits.
impl FromStr for Entropy {
    type Err = RandomError;

    fn from_str(text: &str) -> Result<Self, RandomError> {
        let (digits, base) = text.strip_prefix("0x").map_or((text, 10), |digits| (digits, 16));
        if digits.is_empty() || digits.len() > MAX_DIGITS {
            return Err(RandomError::BadSeed);
        }
        let mut words = vec![0];
        for digit in digits.chars() {
            let mut carry = u64::from(digit.to_digit(base).ok_or(RandomError::BadSeed)?);
            for word in &mut words {
                let sum = u64::from(*word) * u64::from(base) + carry;
                *word = sum as u32;
                carry = sum >> 32;
            }
            if carry > 0 {
                words.push(carry as u32);
            }
        }
        Ok(Entropy(words))
    }
}

/// A hash of words whose multiplier changes with every word.
struct Hash {
    constant: u32,
    multiplier: u32,
}

impl Hash {
    const INTO_POOL: Hash = Hash { constant: 0x43b0_d7e5, multiplier: 0x931e_8875 };
    const OUT_OF_POOL: Hash = Hash { constant: 0x8b51_f9dd, multiplier: 0x58f3_8ded };

    fn next(&mut self, word: u32) -> u32 {
        let word = word ^ self.constant;
        self.constant = self.constant.wrapping_mul(self.multiplier);
        fold(word.wrapping_mul(self.constant))
    }
}

/// Combines two words.
fn combine(a: u32, b: u32) -> u32 {
    fold(a.wrapping_mul(0xca01_f9dd).wrapping_sub(b.wrapping_mul(0x4973_f715)))
}

/// Carries the upper half of a word into the lower one.
fn fold(word: u32) -> u32 {
    word ^ (word >> 16)
}

/// Entropy mixed so that every bit of it affects every word of a generator's state, with children whose
/// states are independent of each other.
///
/// ```
/// use robohive_random::SeedSequence;
/// let mut parent = SeedSequence::new(42_u64);
/// let children: Vec<_> = (0..3).map(|_| parent.spawn()).collect();
/// assert_eq!(children[2].spawn_key(), [2]);
/// assert_ne!(children[0].generate_state::<4>(), children[1].generate_state::<4>());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SeedSequence {
    entropy: Entropy,
    spawn_key: Vec<u64>,
    spawned: u64,
}

impl SeedSequence {
    /// The sequence that `entropy` gives.
    pub fn new(entropy: impl Into<Entropy>) -> Self {
        Self::with_spawn_key(entropy, Vec::new())
    }

    /// The descendant of [`SeedSequence::new`] that `spawn_key` leads to: the number of a child, of its
    /// child, and so on.
    pub fn with_spawn_key(entropy: impl Into<Entropy>, spawn_key: impl Into<Vec<u64>>) -> Self {
        SeedSequence { entropy: entropy.into(), spawn_key: spawn_key.into(), spawned: 0 }
    }

    /// The entropy it was made from.
    pub fn entropy(&self) -> &Entropy {
        &self.entropy
    }

    /// The numbers of the children that lead to it.
    pub fn spawn_key(&self) -> &[u64] {
        &self.spawn_key
    }

    /// The next child.
    pub fn spawn(&mut self) -> SeedSequence {
        let mut spawn_key = self.spawn_key.clone();
        spawn_key.push(self.spawned);
        self.spawned += 1;
        SeedSequence { entropy: self.entropy.clone(), spawn_key, spawned: 0 }
    }

    /// The first `N` words of 32 bits of a generator's state.
    pub fn generate_state<const N: usize>(&self) -> [u32; N] {
        let pool = self.pool();
        let mut hash = Hash::OUT_OF_POOL;
        std::array::from_fn(|k| hash.next(pool[k % POOL]))
    }

    fn pool(&self) -> [u32; POOL] {
        let mut words = self.entropy.0.clone();
        if !self.spawn_key.is_empty() {
            // Short entropy and a spawn key must not look like longer entropy.
            words.resize(words.len().max(POOL), 0);
            words.extend(self.spawn_key.iter().flat_map(|&n| words_of(n.into())));
        }
        let mut hash = Hash::INTO_POOL;
        let mut pool: [u32; POOL] =
            std::array::from_fn(|k| hash.next(words.get(k).copied().unwrap_or_default()));
        for source in 0..POOL {
            for target in (0..POOL).filter(|&target| target != source) {
                pool[target] = combine(pool[target], hash.next(pool[source]));
            }
        }
        for &word in words.iter().skip(POOL) {
            for target in &mut pool {
                *target = combine(*target, hash.next(word));
            }
        }
        pool
    }
}

impl<E: Into<Entropy>> From<E> for SeedSequence {
    fn from(entropy: E) -> Self {
        SeedSequence::new(entropy)
    }
}
