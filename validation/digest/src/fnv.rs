//! The hash FNV-1a with 64 bits (Fowler, Noll and Vo) over named arrays.

use physics::table::Slice;

/// A hash under way.
pub struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Fnv(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Takes in a name, a shape and every bit of the values.
    pub fn array(&mut self, name: &str, shape: &[usize], values: Slice<'_>) {
        self.bytes(name.as_bytes());
        shape.iter().for_each(|&n| self.bytes(&(n as u64).to_le_bytes()));
        match values {
            Slice::Bool(v) => v.iter().for_each(|&x| self.bytes(&[u8::from(x)])),
            Slice::U8(v) => self.bytes(v),
            Slice::I32(v) => v.iter().for_each(|x| self.bytes(&x.to_le_bytes())),
            Slice::I64(v) => v.iter().for_each(|x| self.bytes(&x.to_le_bytes())),
            Slice::F32(v) => v.iter().for_each(|x| self.bytes(&x.to_bits().to_le_bytes())),
            Slice::F64(v) => v.iter().for_each(|x| self.bytes(&x.to_bits().to_le_bytes())),
        }
    }

    /// The hash.
    pub fn finish(&self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_value() {
        let mut hash = Fnv::default();
        hash.array("foobar", &[], Slice::U8(&[]));
        assert_eq!(hash.finish(), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn the_sign_of_zero_counts() {
        let of = |x: f64| {
            let mut hash = Fnv::default();
            hash.array("x", &[1], Slice::F64(&[x]));
            hash.finish()
        };
        assert_ne!(of(0.0), of(-0.0));
    }
}
