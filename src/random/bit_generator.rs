//! The source of random bits behind every draw.

/// A source of random bits. Every distribution is drawn from these three streams, which share one state.
pub trait BitGenerator {
    /// 32 random bits.
    fn next_u32(&mut self) -> u32;

    /// 64 random bits.
    fn next_u64(&mut self) -> u64;

    /// A multiple of 2⁻⁵³ in [0, 1).
    fn next_f64(&mut self) -> f64;
}
