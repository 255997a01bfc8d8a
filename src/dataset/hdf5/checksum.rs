//! Checksums of HDF5: Jenkins' lookup3 of metadata, Fletcher's of chunks.

/// Bob Jenkins' lookup3 (`hashlittle`, public domain) with initial value 0: the checksum of metadata.
pub fn lookup3(bytes: &[u8]) -> u32 {
    let mut words = [0xdead_beef_u32.wrapping_add(bytes.len() as u32); 3];
    let mut rest = bytes;
    while rest.len() > 12 {
        add(&mut words, &rest[..12]);
        mix(&mut words);
        rest = &rest[12..];
    }
    if !rest.is_empty() {
        let mut last = [0; 12];
        last[..rest.len()].copy_from_slice(rest);
        add(&mut words, &last);
        finish(&mut words);
    }
    words[2]
}

fn add(words: &mut [u32; 3], block: &[u8]) {
    for (word, bytes) in words.iter_mut().zip(block.as_chunks().0) {
        *word = word.wrapping_add(u32::from_le_bytes(*bytes));
    }
}

/// Each line takes the word before from a word, and adds the word after to the word before.
fn mix(words: &mut [u32; 3]) {
    for (line, turn) in [4, 6, 8, 16, 19, 4].into_iter().enumerate() {
        let (word, after, before) = (line % 3, (line + 1) % 3, (line + 2) % 3);
        words[word] = words[word].wrapping_sub(words[before]) ^ words[before].rotate_left(turn);
        words[before] = words[before].wrapping_add(words[after]);
    }
}

/// Each line changes a word by the word before.
fn finish(words: &mut [u32; 3]) {
    for (line, turn) in [14, 11, 25, 16, 4, 14, 24].into_iter().enumerate() {
        let (word, before) = ((line + 2) % 3, (line + 1) % 3);
        words[word] = (words[word] ^ words[before]).wrapping_sub(words[before].rotate_left(turn));
    }
}

/// Fletcher's checksum over big-endian 16-bit words; an odd last byte is the high one of its word.
pub fn fletcher32(bytes: &[u8]) -> u32 {
    let (mut low, mut high) = (0u32, 0u32);
    for pair in bytes.chunks(2) {
        let word = u32::from(pair[0]) << 8 | pair.get(1).map_or(0, |&b| u32::from(b));
        low = fold(low + word);
        high = fold(high + low);
    }
    high << 16 | low
}

/// The residue modulo 65535 that ones' complement addition keeps: 65535 stands for zero once anything was added.
fn fold(sum: u32) -> u32 {
    (sum & 0xffff) + (sum >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vectors of lookup3's own self-test.
    #[test]
    fn lookup3_gives_the_published_values() {
        assert_eq!(lookup3(b""), 0xdead_beef);
        assert_eq!(lookup3(b"Four score and seven years ago"), 0x1777_0551);
    }

    /// Every byte counts, wherever it stands in its block.
    #[test]
    fn a_changed_byte_changes_the_sums() {
        let bytes: Vec<u8> = (0..61).collect();
        for at in 0..bytes.len() {
            let mut other = bytes.clone();
            other[at] ^= 64;
            assert_ne!(lookup3(&bytes), lookup3(&other));
            assert_ne!(fletcher32(&bytes), fletcher32(&other));
        }
    }

    /// The common example of Fletcher's sum, with the bytes of its words in big-endian order.
    #[test]
    fn fletcher_gives_the_published_value() {
        assert_eq!(fletcher32(b"badcfe"), 0x5650_2d2a);
    }
}
