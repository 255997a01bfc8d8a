//! Mixing of packed colours in integers.

/// The mix `p + (q - p) * k / 256` of four bytes each, rounded half up; `k` is at most 256.
#[inline]
pub(super) fn lerp(p: u32, q: u32, k: u32) -> u32 {
    const LOW: u32 = 0x00ff_00ff;
    const HALF: u32 = 0x0080_0080;
    let rest = 256 - k;
    let even = (p & LOW) * rest + (q & LOW) * k + HALF;
    let odd = ((p >> 8) & LOW) * rest + ((q >> 8) & LOW) * k + HALF;
    (even >> 8) & LOW | odd & !LOW
}

/// The mix with equal weights: `lerp(p, q, 128)`.
#[inline]
fn mean(p: u32, q: u32) -> u32 {
    (p | q) - (((p ^ q) >> 1) & 0x7f7f_7f7f)
}

/// Pixels of two rows, mixed in twos along both.
pub(super) fn mean_row(out: &mut [u32], upper: &[u32], lower: &[u32]) {
    for ((pixel, a), b) in out.iter_mut().zip(upper.chunks_exact(2)).zip(lower.chunks_exact(2)) {
        *pixel = mean(mean(a[0], a[1]), mean(b[0], b[1]));
    }
}

/// The four bytes as numbers from 0 to 1.
#[inline]
pub(super) fn unpack(packed: u32) -> [f32; 4] {
    packed.to_le_bytes().map(|byte| f32::from(byte) * (1.0 / 255.0))
}

/// The mix `p + (q - p) * k` of four numbers each.
#[inline]
pub(super) fn lerp_f32(p: [f32; 4], q: [f32; 4], k: f32) -> [f32; 4] {
    [0, 1, 2, 3].map(|i| p[i] + (q[i] - p[i]) * k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_bytes_mix_as_single_ones_do() {
        let formula =
            |p: u8, q: u8, k: i32| (i32::from(p) + (((i32::from(q) - i32::from(p)) * k + 128) >> 8)) as u8;
        for k in 0..=256 {
            for (p, q) in [
                ([0, 255, 1, 254], [255, 0, 254, 1]),
                ([7, 7, 200, 13], [8, 7, 3, 250]),
                ([255; 4], [255; 4]),
            ] {
                let mixed = lerp(u32::from_le_bytes(p), u32::from_le_bytes(q), k).to_le_bytes();
                assert_eq!(mixed, [0, 1, 2, 3].map(|i| formula(p[i], q[i], k as i32)), "k {k}");
                let even = mean(u32::from_le_bytes(p), u32::from_le_bytes(q)).to_le_bytes();
                assert_eq!(even, [0, 1, 2, 3].map(|i| formula(p[i], q[i], 128)));
            }
        }
    }
}
