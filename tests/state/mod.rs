//! What a step leaves behind.

use robohive::physics::{Data, Model};

/// Everything a step leaves behind, to the bit.
pub fn bits(m: &Model, d: &Data) -> Vec<u64> {
    let mut bits = Vec::new();
    d.visit(m, &mut |_, _, values| bits.extend(values.to_f64().into_iter().map(f64::to_bits)));
    bits
}
