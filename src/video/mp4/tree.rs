//! Boxes: a length, a name of four letters, contents.

/// Numbers as they stand in boxes: the most significant byte first.
#[derive(Debug, Default)]
pub(crate) struct Contents(Vec<u8>);

impl Contents {
    /// Contents of a plain box.
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Contents of a box with a version and flags.
    pub(crate) fn versioned(version: u8, flags: u32) -> Self {
        Self::new().u32(u32::from(version) << 24 | flags)
    }

    /// A number of 8 bits.
    pub(crate) fn u8(self, value: u8) -> Self {
        self.bytes(&[value])
    }

    /// A number of 16 bits.
    pub(crate) fn u16(self, value: u16) -> Self {
        self.bytes(&value.to_be_bytes())
    }

    /// A number of 32 bits.
    pub(crate) fn u32(self, value: u32) -> Self {
        self.bytes(&value.to_be_bytes())
    }

    /// A number of 64 bits.
    pub(crate) fn u64(self, value: u64) -> Self {
        self.bytes(&value.to_be_bytes())
    }

    /// A table of numbers of 32 bits after the count of its rows.
    pub(crate) fn table(self, rows: &[u32]) -> Self {
        let start = self.u32(rows.len() as u32);
        rows.iter().fold(start, |contents, &value| contents.u32(value))
    }

    /// Bytes as they are: texts, reserved zeros, boxes inside.
    pub(crate) fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    /// The box with these contents.
    pub(crate) fn named(self, name: &[u8; 4]) -> Vec<u8> {
        let length = (self.0.len() + 8) as u32;
        [&length.to_be_bytes()[..], name, &self.0].concat()
    }
}

/// A box of boxes.
pub(crate) fn parent(name: &[u8; 4], children: &[Vec<u8>]) -> Vec<u8> {
    Contents::new().bytes(&children.concat()).named(name)
}
