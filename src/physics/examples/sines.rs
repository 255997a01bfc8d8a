//! Arguments in ±4 with our sine and cosine, as bits in hexadecimal: `validation/reference/sines.py` judges them.

use robohive_physics::math::ops::{cos, sin};
use std::io::Write;

fn main() -> std::io::Result<()> {
    let count = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(300_000_u64);
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    // Weyl's sequence: multiples of the golden ratio modulo one, which fill the interval evenly.
    let mut turn = 0_u64;
    for _ in 0..count {
        turn = turn.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = 8.0 * ((turn >> 11) as f64 / (1_u64 << 53) as f64) - 4.0;
        writeln!(out, "{:016x} {:016x} {:016x}", x.to_bits(), sin(x).to_bits(), cos(x).to_bits())?;
    }
    out.flush()
}
