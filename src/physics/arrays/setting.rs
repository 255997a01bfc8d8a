//! One setting of a group: how it is shown, assigned by name, and read from a compiled file.

use super::flags::{Disable, Enable};
use super::types::{Cone, Integrator, Jacobian, Solver};
use crate::table::{Scalar, Slice};

/// One setting: a scalar or a short vector.
pub(crate) trait Setting {
    fn scalars(&self) -> Slice<'_>;
    fn assign(&mut self, values: &[f64]) -> bool;
    /// Bytes in a compiled file.
    const BYTES: usize;
    /// Takes the value from a compiled file; false when the bytes stand for none.
    fn read(&mut self, bytes: &[u8]) -> bool;
}

impl<T: Scalar> Setting for T {
    fn scalars(&self) -> Slice<'_> {
        T::slice(std::slice::from_ref(self))
    }
    fn assign(&mut self, values: &[f64]) -> bool {
        if let [x] = values {
            *self = T::from_f64(*x);
        }
        values.len() == 1
    }
    const BYTES: usize = T::BYTES;
    fn read(&mut self, bytes: &[u8]) -> bool {
        *self = T::from_bytes(bytes);
        true
    }
}

impl<T: Scalar, const N: usize> Setting for [T; N] {
    fn scalars(&self) -> Slice<'_> {
        T::slice(self)
    }
    fn assign(&mut self, values: &[f64]) -> bool {
        if values.len() == N {
            *self = std::array::from_fn(|i| T::from_f64(values[i]));
        }
        values.len() == N
    }
    const BYTES: usize = N * T::BYTES;
    fn read(&mut self, bytes: &[u8]) -> bool {
        *self = std::array::from_fn(|i| T::from_bytes(&bytes[i * T::BYTES..]));
        true
    }
}

/// The codes of enumerations, each a slice of its own when a setting shows itself.
static CODES: [i32; 4] = [0, 1, 2, 3];

macro_rules! enumerated {
    ($($name:ident)*) => {$(
        impl Setting for $name {
            fn scalars(&self) -> Slice<'_> {
                let code = self.code() as usize;
                Slice::I32(&CODES[code..=code])
            }
            fn assign(&mut self, values: &[f64]) -> bool {
                let [x] = values else { return false };
                $name::from_code(*x as i32).map(|value| *self = value).is_some()
            }
            const BYTES: usize = size_of::<i32>();
            fn read(&mut self, bytes: &[u8]) -> bool {
                $name::from_code(i32::from_bytes(bytes)).map(|value| *self = value).is_some()
            }
        }
    )*};
}

macro_rules! switches {
    ($($name:ident)*) => {$(
        impl Setting for $name {
            fn scalars(&self) -> Slice<'_> {
                Slice::I32(self.as_slice())
            }
            fn assign(&mut self, values: &[f64]) -> bool {
                let [x] = values else { return false };
                *self = $name::from_bits(*x as i32);
                true
            }
            const BYTES: usize = size_of::<i32>();
            fn read(&mut self, bytes: &[u8]) -> bool {
                *self = $name::from_bits(i32::from_bytes(bytes));
                true
            }
        }
    )*};
}

enumerated! { Integrator Cone Jacobian Solver }
switches! { Disable Enable }
