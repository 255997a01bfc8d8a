//! Enumeration order of LLVM's `std::unordered_map` for keys that are pairs of doubles.
//!
//! The order of a mesh's polygons is that of such a map, so it is computed here: separate chaining
//! where all nodes form one list, a chain's new node goes to its front, and a new chain to the front
//! of the list.

const NONE: usize = usize::MAX;

/// Set of keys that remembers the map's order; entries are numbered by insertion.
#[derive(Default)]
pub(super) struct HashOrder {
    keys: Vec<(f64, f64)>,
    hash: Vec<u64>,
    /// Successor of each entry in the list.
    next: Vec<usize>,
    head: usize,
    /// Predecessor of each chain's first entry: `None` for an empty chain, `Some(NONE)` for the head.
    before: Vec<Option<usize>>,
}

impl HashOrder {
    /// Number of the entry with `key`.
    pub(super) fn find(&self, key: (f64, f64)) -> Option<usize> {
        if self.before.is_empty() {
            return None;
        }
        let hash = pair_hash(key);
        let chain = self.chain(hash);
        let mut at = self.successor(self.before[chain]?);
        while at != NONE && self.chain(self.hash[at]) == chain {
            if self.keys[at] == key {
                return Some(at);
            }
            at = self.next[at];
        }
        None
    }

    /// Adds a key that is not present.
    pub(super) fn insert(&mut self, key: (f64, f64)) {
        let chains = self.before.len();
        let size = self.keys.len();
        if size == 0 {
            self.head = NONE;
        }
        if size + 1 > chains {
            let power_of_two = chains > 2 && chains.is_power_of_two();
            self.rehash((2 * chains + usize::from(!power_of_two)).max(size + 1));
        }
        let entry = size;
        self.keys.push(key);
        self.hash.push(pair_hash(key));
        self.next.push(NONE);
        let chain = self.chain(self.hash[entry]);
        match self.before[chain] {
            Some(previous) => self.link_after(previous, entry),
            None => {
                self.link_after(NONE, entry);
                self.before[chain] = Some(NONE);
                if self.next[entry] != NONE {
                    let displaced = self.chain(self.hash[self.next[entry]]);
                    self.before[displaced] = Some(entry);
                }
            }
        }
    }

    /// Entries in the map's order.
    pub(super) fn order(&self) -> impl Iterator<Item = usize> + '_ {
        let first = if self.keys.is_empty() { NONE } else { self.head };
        std::iter::successors((first != NONE).then_some(first), |&at| {
            (self.next[at] != NONE).then_some(self.next[at])
        })
    }

    fn chain(&self, hash: u64) -> usize {
        let chains = self.before.len() as u64;
        (if chains.is_power_of_two() { hash & (chains - 1) } else { hash % chains }) as usize
    }

    fn successor(&self, at: usize) -> usize {
        if at == NONE { self.head } else { self.next[at] }
    }

    fn set_successor(&mut self, at: usize, to: usize) {
        if at == NONE {
            self.head = to;
        } else {
            self.next[at] = to;
        }
    }

    fn link_after(&mut self, previous: usize, entry: usize) {
        self.next[entry] = self.successor(previous);
        self.set_successor(previous, entry);
    }

    /// Redistributes the list over at least `wanted` chains, moving scattered entries behind the first
    /// of their chain.
    fn rehash(&mut self, wanted: usize) {
        let chains = match wanted {
            0 | 1 => 2,
            n if n.is_power_of_two() => n,
            n => next_prime(n),
        };
        self.before = vec![None; chains];
        if self.keys.is_empty() {
            return;
        }
        let mut previous = self.head;
        let mut current_chain = self.chain(self.hash[previous]);
        self.before[current_chain] = Some(NONE);
        while self.next[previous] != NONE {
            let at = self.next[previous];
            let chain = self.chain(self.hash[at]);
            if chain == current_chain {
                previous = at;
            } else if let Some(front) = self.before[chain] {
                self.next[previous] = self.next[at];
                self.link_after(front, at);
            } else {
                self.before[chain] = Some(previous);
                previous = at;
                current_chain = chain;
            }
        }
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
