//! Choices and numbers out of the bytes of an input.

/// Bytes that run out: zeros follow.
pub(crate) struct Bytes<'a>(pub(crate) &'a [u8]);

impl Bytes<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn next(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// One of `items`, of which there are some.
    pub(crate) fn one_of<'t, T>(&mut self, items: &'t [T]) -> &'t T {
        &items[usize::from(self.next()) % items.len()]
    }

    /// A number: of a fine grid, of a coarse one, an extreme one, or any bits.
    pub(crate) fn number(&mut self) -> f32 {
        const EXTREME: [f32; 16] = [
            0.0,
            -0.0,
            1.0,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::MAX,
            f32::MIN,
            f32::MIN_POSITIVE,
            1e-40,
            1e10,
            -1e10,
            1e-6,
            255.5,
            1e20,
            180.0,
        ];
        let kind = self.next();
        let fine = f32::from(self.next() as i8);
        match kind % 8 {
            0 => {
                f32::from_bits(u32::from_le_bytes([self.next(), self.next(), self.next(), fine as i8 as u8]))
            }
            1 => EXTREME[fine.abs() as usize % 16],
            2 => fine,
            _ => fine / 32.0,
        }
    }

    pub(crate) fn numbers<const N: usize>(&mut self) -> [f32; N] {
        std::array::from_fn(|_| self.number())
    }

    pub(crate) fn wide<const N: usize>(&mut self) -> [f64; N] {
        self.numbers().map(f64::from)
    }
}
