//! How many bits a recording keeps of a number.

use crate::half::F16;
use crate::npy::{Dtype, Scalar, Values};

/// How many bits are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// All.
    #[default]
    Full,
    /// As RoboHive's own recordings: uint8, int8, float16. A number out of their range is an error.
    Reduced,
}

impl Precision {
    /// The type in which scalars of `dtype` are kept.
    pub fn kept(self, dtype: Dtype) -> Dtype {
        match (self, dtype) {
            (Precision::Full, other) | (_, other @ Dtype::Bool) => other,
            (_, Dtype::U8 | Dtype::U16 | Dtype::U32 | Dtype::U64) => Dtype::U8,
            (_, Dtype::I8 | Dtype::I16 | Dtype::I32 | Dtype::I64) => Dtype::I8,
            (_, Dtype::F16 | Dtype::F32 | Dtype::F64) => Dtype::F16,
        }
    }

    /// Appends the bytes of scalars in the type in which they are kept.
    ///
    /// # Errors
    /// A number is out of range; the message names it.
    pub(crate) fn put<T: Scalar>(self, scalars: &[T], out: &mut Vec<u8>) -> Result<(), String> {
        let kept = self.kept(T::DTYPE);
        if kept == T::DTYPE {
            scalars.iter().for_each(|&x| x.put(out));
            return Ok(());
        }
        for x in scalars {
            reduce(x.as_f64(), kept, out)?;
        }
        Ok(())
    }

    /// [`Precision::put`] of values whose type is known at run time only.
    ///
    /// # Errors
    /// A number is out of range; the message names it.
    pub(crate) fn put_values(self, values: &Values, out: &mut Vec<u8>) -> Result<(), String> {
        match values {
            Values::Bool(v) => self.put(v, out),
            Values::U8(v) => self.put(v, out),
            Values::U16(v) => self.put(v, out),
            Values::U32(v) => self.put(v, out),
            Values::U64(v) => self.put(v, out),
            Values::I8(v) => self.put(v, out),
            Values::I16(v) => self.put(v, out),
            Values::I32(v) => self.put(v, out),
            Values::I64(v) => self.put(v, out),
            Values::F16(v) => self.put(v, out),
            Values::F32(v) => self.put(v, out),
            Values::F64(v) => self.put(v, out),
        }
    }
}

/// Appends a number in a smaller type.
fn reduce(x: f64, kept: Dtype, out: &mut Vec<u8>) -> Result<(), String> {
    let fits = match kept {
        Dtype::U8 => (0.0..=255.0).contains(&x),
        Dtype::I8 => (-128.0..=127.0).contains(&x),
        _ => !x.is_finite() || F16::from_f64(x).to_f64().is_finite(),
    };
    if !fits {
        // Not three hundred digits.
        let x = if x.abs() < 1e15 { x.to_string() } else { format!("{x:e}") };
        return Err(format!("{x} does not fit into {}: record in full precision", kept.name()));
    }
    match kept {
        Dtype::U8 => (x as u8).put(out),
        Dtype::I8 => (x as i8).put(out),
        _ => F16::from_f64(x).put(out),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reduced<T: Scalar>(scalars: &[T]) -> Result<Values, String> {
        let mut out = Vec::new();
        Precision::Reduced.put(scalars, &mut out)?;
        Ok(Values::from_bytes(Precision::Reduced.kept(T::DTYPE), &out))
    }

    #[test]
    fn what_fits_is_kept_and_what_does_not_is_named() {
        assert_eq!(reduced(&[0u64, 255]), Ok(Values::U8(vec![0, 255])));
        assert_eq!(reduced(&[-128i64, 127]), Ok(Values::I8(vec![-128, 127])));
        assert_eq!(reduced(&[true]), Ok(Values::Bool(vec![true])));
        assert_eq!(reduced(&[65504.0, 0.1]).map(|v| v.to_f64()), Ok(vec![65504.0, 0.0999755859375]));
        assert!(reduced(&[f64::NAN]).is_ok_and(|v| v.to_f64()[0].is_nan()));
        assert_eq!(reduced(&[f64::INFINITY]).map(|v| v.to_f64()), Ok(vec![f64::INFINITY]));
        assert!(reduced(&[1e300]).unwrap_err().starts_with("1e300 does not fit into float16"));
        assert!(reduced(&[256u32]).unwrap_err().contains("256 does not fit into uint8"));
        assert!(reduced(&[128i32]).unwrap_err().contains("int8"));
        assert!(reduced(&[70000.0f32]).unwrap_err().contains("float16"));
    }
}
