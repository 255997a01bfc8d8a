//! Enumeration order of LLVM's `std::unordered_map` for keys that are pairs of doubles.
//!
//! The order of a mesh's polygons is that of such a map, so it is computed here. The map hashes with separate chaining (Knuth, The
//! Art of Computer Programming 3, section 6.4), and lists its keys chain by chain. Which chain comes first and which key in it
//! depends on when they were added:
//!
//! - A new key comes first in its chain, and a new chain first of all.
//! - When the number of chains grows, the keys are spread again in the order that they had. Then a new chain comes last. A key
//!   comes last in the chain that was begun last, but first in any other one.

use std::collections::VecDeque;

/// Set of keys that remembers the map's order; entries are numbered by insertion.
#[derive(Default)]
pub(super) struct HashOrder {
    entries: Vec<Entry>,
    /// Numbers of the entries of each chain, in order.
    chains: Vec<VecDeque<usize>>,
    /// Numbers of the chains that have entries, in order.
    begun: VecDeque<usize>,
}

struct Entry {
    key: (f64, f64),
    hash: u64,
}

impl HashOrder {
    /// Number of the entry with `key`.
    pub(super) fn find(&self, key: (f64, f64)) -> Option<usize> {
        let chain = self.chains.get(self.chain_of(pair_hash(key))?)?;
        chain.iter().copied().find(|&entry| self.entries[entry].key == key)
    }

    /// Adds a key that is not present.
    pub(super) fn insert(&mut self, key: (f64, f64)) {
        let number = self.entries.len();
        if number == self.chains.len() {
            self.spread(larger_table(number));
        }
        let hash = pair_hash(key);
        self.entries.push(Entry { key, hash });
        if let Some(chain) = self.chain_of(hash) {
            if self.chains[chain].is_empty() {
                self.begun.push_front(chain);
            }
            self.chains[chain].push_front(number);
        }
    }

    /// Entries in the map's order.
    pub(super) fn order(&self) -> impl Iterator<Item = usize> + '_ {
        self.begun.iter().flat_map(|&chain| self.chains[chain].iter().copied())
    }

    /// The chain of keys with this hash; `None` before there are chains.
    fn chain_of(&self, hash: u64) -> Option<usize> {
        match self.chains.len() as u64 {
            0 => None,
            count if count.is_power_of_two() => Some((hash & (count - 1)) as usize),
            count => Some((hash % count) as usize),
        }
    }

    /// Spreads the entries over this many chains.
    fn spread(&mut self, count: usize) {
        let listed: Vec<usize> = self.order().collect();
        self.chains = vec![VecDeque::new(); count];
        self.begun.clear();
        for entry in listed {
            let Some(chain) = self.chain_of(self.entries[entry].hash) else { continue };
            if self.chains[chain].is_empty() {
                self.begun.push_back(chain);
            }
            if self.begun.back() == Some(&chain) {
                self.chains[chain].push_back(entry);
            } else {
                self.chains[chain].push_front(entry);
            }
        }
    }
}

/// Number of chains that follows on `full` ones, each with one entry on average: a power of two or a prime.
fn larger_table(full: usize) -> usize {
    let keeps_powers = full > 2 && full.is_power_of_two();
    match 2 * full + usize::from(!keeps_powers) {
        0 | 1 => 2,
        wanted if wanted.is_power_of_two() => wanted,
        wanted => next_prime(wanted),
    }
}

/// Bits of both numbers combined by exclusive or; either zero counts as no bits.
fn pair_hash((a, b): (f64, f64)) -> u64 {
    let bits = |x: f64| if x == 0.0 { 0 } else { x.to_bits() };
    bits(a) ^ bits(b)
}

fn next_prime(from: usize) -> usize {
    (from..).find(|&n| n >= 2 && (2..).take_while(|d| d * d <= n).all(|d| n % d != 0)).unwrap_or(from)
}
