//! Sets of small numbers, as bits of words.

/// Words of a set of numbers below `n`.
pub fn words(n: usize) -> usize {
    n.div_ceil(64)
}

/// Whether `i` is in the set.
#[inline]
pub fn contains(set: &[u64], i: usize) -> bool {
    set[i / 64] >> (i % 64) & 1 == 1
}

/// Adds `i`.
#[inline]
pub fn insert(set: &mut [u64], i: usize) {
    set[i / 64] |= 1 << (i % 64);
}

/// Adds the members of `other`.
#[inline]
pub fn unite(set: &mut [u64], other: &[u64]) {
    set.iter_mut().zip(other).for_each(|(x, y)| *x |= y);
}

/// Calls `f` for the members, increasing.
#[inline]
pub fn for_each(set: &[u64], f: impl FnMut(usize)) {
    for_each_common(set, set, f);
}

/// Calls `f` for the members that two sets share, increasing.
#[inline]
pub fn for_each_common(a: &[u64], b: &[u64], mut f: impl FnMut(usize)) {
    for (w, (x, y)) in a.iter().zip(b).enumerate() {
        let mut left = x & y;
        while left != 0 {
            f(64 * w + left.trailing_zeros() as usize);
            left &= left - 1;
        }
    }
}

/// Calls `f` for the members, decreasing.
#[inline]
pub fn for_each_reversed(set: &[u64], mut f: impl FnMut(usize)) {
    for (w, &word) in set.iter().enumerate().rev() {
        let mut left = word;
        while left != 0 {
            let bit = left.ilog2() as usize;
            left ^= 1 << bit;
            f(64 * w + bit);
        }
    }
}
