//! Arrays of models and states with the types of their numbers.

use super::wire::{Wire, WireError, split};
use physics::table::{Slice, SliceMut};

/// The numbers of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Truth values.
    Bool(Vec<bool>),
    /// Bytes.
    U8(Vec<u8>),
    /// Integers.
    I32(Vec<i32>),
    /// Offsets.
    I64(Vec<i64>),
    /// Single precision.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
}

impl From<Slice<'_>> for Numbers {
    fn from(slice: Slice<'_>) -> Self {
        match slice {
            Slice::Bool(s) => Numbers::Bool(s.to_vec()),
            Slice::U8(s) => Numbers::U8(s.to_vec()),
            Slice::I32(s) => Numbers::I32(s.to_vec()),
            Slice::I64(s) => Numbers::I64(s.to_vec()),
            Slice::F32(s) => Numbers::F32(s.to_vec()),
            Slice::F64(s) => Numbers::F64(s.to_vec()),
        }
    }
}

impl Numbers {
    /// The numbers, borrowed.
    pub fn slice(&self) -> Slice<'_> {
        match self {
            Numbers::Bool(s) => Slice::Bool(s),
            Numbers::U8(s) => Slice::U8(s),
            Numbers::I32(s) => Slice::I32(s),
            Numbers::I64(s) => Slice::I64(s),
            Numbers::F32(s) => Slice::F32(s),
            Numbers::F64(s) => Slice::F64(s),
        }
    }

    /// Whether they fit an array: the same type and length.
    pub fn fits(&self, to: &Slice<'_>) -> bool {
        let own = self.slice();
        std::mem::discriminant(&own) == std::mem::discriminant(to) && own.len() == to.len()
    }

    /// Overwrites an array that they fit; any other stays as it is.
    pub fn copy_to(&self, to: SliceMut<'_>) {
        match (self.slice(), to) {
            (Slice::Bool(s), SliceMut::Bool(to)) if s.len() == to.len() => to.copy_from_slice(s),
            (Slice::U8(s), SliceMut::U8(to)) if s.len() == to.len() => to.copy_from_slice(s),
            (Slice::I32(s), SliceMut::I32(to)) if s.len() == to.len() => to.copy_from_slice(s),
            (Slice::I64(s), SliceMut::I64(to)) if s.len() == to.len() => to.copy_from_slice(s),
            (Slice::F32(s), SliceMut::F32(to)) if s.len() == to.len() => to.copy_from_slice(s),
            (Slice::F64(s), SliceMut::F64(to)) if s.len() == to.len() => to.copy_from_slice(s),
            _ => {}
        }
    }
}

impl Wire for Numbers {
    fn put(&self, out: &mut Vec<u8>) {
        let slice = self.slice();
        out.push(match slice {
            Slice::Bool(_) => 0,
            Slice::U8(_) => 1,
            Slice::I32(_) => 2,
            Slice::I64(_) => 3,
            Slice::F32(_) => 4,
            Slice::F64(_) => 5,
        });
        slice.len().put(out);
        slice.pieces(&mut |piece| out.extend_from_slice(piece));
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        let (kind, count) = (u8::take(from)?, usize::take(from)?);
        let width = match kind {
            0 | 1 => 1,
            2 | 4 => 4,
            3 | 5 => 8,
            code => return Err(WireError::Unknown("type of numbers", code.into())),
        };
        let bytes = split(from, count.checked_mul(width).ok_or(WireError::Short)?)?;
        let (fours, eights) = (bytes.as_chunks::<4>().0, bytes.as_chunks::<8>().0);
        Ok(match kind {
            0 => Numbers::Bool(bytes.iter().map(|&byte| byte != 0).collect()),
            1 => Numbers::U8(bytes.to_vec()),
            2 => Numbers::I32(fours.iter().map(|&word| i32::from_le_bytes(word)).collect()),
            3 => Numbers::I64(eights.iter().map(|&word| i64::from_le_bytes(word)).collect()),
            4 => Numbers::F32(fours.iter().map(|&word| f32::from_le_bytes(word)).collect()),
            _ => Numbers::F64(eights.iter().map(|&word| f64::from_le_bytes(word)).collect()),
        })
    }
}
