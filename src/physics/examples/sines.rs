//! Arguments `x`, `y` in ±4 with our sine, cosine and tangent of `x`, the arc cosine of `x/4` and the angle of the direction
//! `(y, x)`, as bits in hexadecimal: `validation/reference/sines.py` judges them.

use robohive_physics::math::ops::{angle, arc_cosine, cos, sin, tangent};
use std::io::Write;

fn main() -> std::io::Result<()> {
    let count = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(300_000_u64);
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    // Weyl's sequence: multiples of the golden ratio modulo one, which fill the interval evenly.
    let mut turn = 0_u64;
    let mut next = || {
        turn = turn.wrapping_add(0x9e37_79b9_7f4a_7c15);
        8.0 * ((turn >> 11) as f64 / (1_u64 << 53) as f64) - 4.0
    };
    for _ in 0..count {
        let (x, y) = (next(), next());
        let row = [x, y, sin(x), cos(x), tangent(x), arc_cosine(x / 4.0), angle(x, y)];
        writeln!(out, "{}", row.map(|value| format!("{:016x}", value.to_bits())).join(" "))?;
    }
    out.flush()
}
