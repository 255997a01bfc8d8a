//! How much compressed bytes may become.
//!
//! Deflate makes up to a thousand bytes of one, so that a small file could ask for all memory. Constant numbers are
//! compressed that much in good faith: a part is free, and beyond it fifty bytes may come of one.

/// Bytes that may come of any file.
const FREE: u64 = 256 << 20;

/// Bytes that may come of each byte beyond.
const RATIO: u64 = 50;

/// Most bytes that `packed` bytes may become.
pub(crate) fn most(packed: u64) -> u64 {
    packed.saturating_mul(RATIO).saturating_add(FREE)
}
