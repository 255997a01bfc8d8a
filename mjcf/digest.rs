//! Digests that tell one content from another: SipHash-1-3 with 128 bits (Aumasson and Bernstein, "SipHash: a fast
//! short-input PRF", 2012; the 128-bit output as in the authors' reference code), with a key of zeros.
//!
//! 128 bits keep contents apart by accident; they do not keep out somebody who wants two contents to collide. Whoever
//! may write the files or the cache decides what is loaded anyway.

use std::io::{ErrorKind, Read};

/// Digest of some content.
pub(crate) type Digest = [u8; 16];

/// The digest of `content`.
pub(crate) fn digest(content: &[u8]) -> Digest {
    let mut hasher = Hasher::default();
    hasher.update(content);
    hasher.finish()
}

/// The digest of all that `source` yields.
///
/// # Errors
/// The source cannot be read.
pub(crate) fn digest_of(mut source: impl Read) -> std::io::Result<Digest> {
    let mut hasher = Hasher::default();
    let mut piece = vec![0; 1 << 16];
    loop {
        match source.read(&mut piece) {
            Ok(0) => return Ok(hasher.finish()),
            Ok(length) => hasher.update(&piece[..length]),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// The digest of several parts; where one ends and the next begins enters it.
pub(crate) fn digest_parts<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> Digest {
    let mut hasher = Hasher::default();
    for part in parts {
        hasher.update(&(part.len() as u64).to_le_bytes());
        hasher.update(part);
    }
    hasher.finish()
}

/// The digest as lower-case hexadecimal digits.
pub(crate) fn hex(digest: Digest) -> String {
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// SipHash with `WORD` rounds a word and `LAST` rounds for each half of the output.
struct SipHash<const WORD: usize, const LAST: usize> {
    state: [u64; 4],
    /// Bytes that fill no word yet, `length % 8` of them.
    pending: [u8; 8],
    length: usize,
}

type Hasher = SipHash<1, 3>;

impl<const WORD: usize, const LAST: usize> Default for SipHash<WORD, LAST> {
    fn default() -> Self {
        Self::keyed([0, 0])
    }
}

impl<const WORD: usize, const LAST: usize> SipHash<WORD, LAST> {
    fn keyed([k0, k1]: [u64; 2]) -> Self {
        // "somepseudorandomlygeneratedbytes", and 0xee for the output of 128 bits.
        let state = [
            k0 ^ 0x736f_6d65_7073_6575,
            k1 ^ 0x646f_7261_6e64_6f6d ^ 0xee,
            k0 ^ 0x6c79_6765_6e65_7261,
            k1 ^ 0x7465_6462_7974_6573,
        ];
        SipHash { state, pending: [0; 8], length: 0 }
    }

    fn update(&mut self, mut bytes: &[u8]) {
        let filled = self.length % 8;
        self.length += bytes.len();
        if filled > 0 {
            let (head, rest) = bytes.split_at(bytes.len().min(8 - filled));
            self.pending[filled..filled + head.len()].copy_from_slice(head);
            if filled + head.len() < 8 {
                return;
            }
            self.state = absorb::<WORD>(self.state, u64::from_le_bytes(self.pending));
            bytes = rest;
        }
        let (words, rest) = bytes.as_chunks::<8>();
        self.state =
            words.iter().fold(self.state, |state, word| absorb::<WORD>(state, u64::from_le_bytes(*word)));
        self.pending[..rest.len()].copy_from_slice(rest);
    }

    fn finish(mut self) -> Digest {
        self.pending[self.length % 8..].fill(0);
        let last = u64::from_le_bytes(self.pending) | (self.length as u64) << 56;
        let mut state = absorb::<WORD>(self.state, last);
        let mut digest = [0; 16];
        for (half, (word, mark)) in digest.as_chunks_mut::<8>().0.iter_mut().zip([(2, 0xee), (1, 0xdd)]) {
            state[word] ^= mark;
            state = (0..LAST).fold(state, |state, _| mixed(state));
            *half = (state[0] ^ state[1] ^ state[2] ^ state[3]).to_le_bytes();
        }
        digest
    }
}

#[inline]
fn absorb<const ROUNDS: usize>(mut state: [u64; 4], word: u64) -> [u64; 4] {
    state[3] ^= word;
    state = (0..ROUNDS).fold(state, |state, _| mixed(state));
    state[0] ^= word;
    state
}

/// One round: two half rounds. Each adds, rotates and exclusive-ors two pairs of words.
#[inline]
fn mixed([a, b, c, d]: [u64; 4]) -> [u64; 4] {
    let (a, b) = mixed_pair(a, b, 13);
    let (c, d) = mixed_pair(c, d, 16);
    let (c, b) = mixed_pair(c, b, 17);
    let (a, d) = mixed_pair(a.rotate_left(32), d, 21);
    [a, b, c.rotate_left(32), d]
}

#[inline]
fn mixed_pair(a: u64, b: u64, bits: u32) -> (u64, u64) {
    let sum = a.wrapping_add(b);
    (sum, b.rotate_left(bits) ^ sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `vectors_sip128` of the authors' reference code (SipHash-2-4, key and message 00 01 02 …): no, one and fifteen bytes.
    #[test]
    fn two_four_has_the_published_digests() {
        let key = [0x0706_0504_0302_0100, 0x0f0e_0d0c_0b0a_0908];
        for (length, expected) in [
            (0, "a3817f04ba25a8e66df67214c7550293"),
            (1, "da87c1d86b99af44347659119b22fc45"),
            (15, "5493e99933b0a8117e08ec0f97cfc3d9"),
        ] {
            let mut hasher = SipHash::<2, 4>::keyed(key);
            hasher.update(&(0..length).collect::<Vec<u8>>());
            assert_eq!(hex(hasher.finish()), expected, "{length} bytes");
        }
    }

    #[test]
    fn pieces_make_no_difference_and_parts_do() {
        let content: Vec<u8> = (0..200u8).collect();
        for piece in 1..30 {
            let mut hasher = Hasher::default();
            content.chunks(piece).for_each(|bytes| hasher.update(bytes));
            assert_eq!(hasher.finish(), digest(&content), "{piece} bytes a piece");
        }
        assert_eq!(digest_of(&content[..]).unwrap(), digest(&content));
        assert_ne!(digest_parts([&b"ab"[..], b"c"]), digest_parts([&b"a"[..], b"bc"]));
    }
}
