//! Whether the C library of this machine has the functions that the recorded MuJoCo called: only then can values that
//! follow from them be equal to the last bit.

use std::f64::consts::GOLDEN_RATIO;

/// Arguments of each function.
const ARGUMENTS: u32 = 20_000;

/// The [`digest`] of glibc 2.36 on an x86-64 processor with fused multiply-add.
const RECORDED: u64 = 0x442b_fd92_b701_844f;

/// True where every probed value is the recorded library's.
pub fn is_recorded() -> bool {
    digest() == RECORDED
}

/// FNV-1a over the bits of all functions that a model may call. Libraries round between one argument in a hundred and one
/// in several thousand differently, and so does one library on processors without fused multiply-add.
fn digest() -> u64 {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    for i in 1..=ARGUMENTS {
        // Multiples of the golden ratio fill the interval evenly.
        let unit = (f64::from(i) * GOLDEN_RATIO).fract();
        let (angle, share, positive) = (8.0 * unit - 4.0, 2.0 * unit - 1.0, 50.0 * unit + 1e-3);
        let values = [
            angle.sin(),
            angle.cos(),
            angle.tan(),
            share.asin(),
            share.acos(),
            share.atan2(0.3),
            (5.0 * angle).exp(),
            positive.ln(),
            positive.powf(share),
            angle.tanh(),
        ];
        for byte in values.into_iter().flat_map(f64::to_le_bytes) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    hash
}
