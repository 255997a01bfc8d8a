//! The numpy array format, versions 1.0 to 3.0 (numpy documentation: `numpy.lib.format`).
//!
//! ```
//! use robohive_dataset::{Array, Values};
//!
//! let array = Array::f64(vec![2, 3], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
//! let read = Array::decode(&array.encode())?;
//! assert_eq!((read.rows(), read.values), (2, Values::F64(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])));
//! # Ok::<(), robohive_dataset::NpyError>(())
//! ```

use crate::half::F16;
use std::fmt;

/// Largest number of scalars an array may hold: 1 GiB of f64.
pub const MAX_SCALARS: usize = 1 << 27;

/// A type that arrays hold.
pub trait Scalar: Copy + 'static {
    /// How numpy calls it.
    const DTYPE: Dtype;

    /// Appends its bytes, little-endian.
    fn put(self, out: &mut Vec<u8>);

    /// From as many bytes as [`Dtype::bytes`] says, little-endian.
    fn take(bytes: &[u8]) -> Self;

    /// The nearest double.
    fn as_f64(self) -> f64;
}

/// Declares the types that arrays hold: variant, type, bytes, name in numpy's format, and conversions.
macro_rules! dtypes {
    ($($variant:ident: $scalar:ty, $bytes:literal, $descr:literal, $name:literal, $put:expr, $take:expr, $as_f64:expr;)*) => {
        /// Type of an array's scalars.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Dtype {
            $(#[doc = concat!("`", $descr, "`")] $variant,)*
        }

        impl Dtype {
            /// All of them.
            pub const ALL: [Dtype; 12] = [$(Dtype::$variant,)*];

            /// Bytes of one scalar.
            pub fn bytes(self) -> usize {
                match self {
                    $(Dtype::$variant => $bytes,)*
                }
            }

            /// Numpy's name, as in `float64`.
            pub fn name(self) -> &'static str {
                match self {
                    $(Dtype::$variant => $name,)*
                }
            }

            fn descr(self) -> &'static str {
                match self {
                    $(Dtype::$variant => $descr,)*
                }
            }
        }

        /// Scalars of an array in row-major order.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Values {
            $(#[doc = concat!("`", $descr, "`")] $variant(Vec<$scalar>),)*
        }

        impl Values {
            /// Number of scalars.
            pub fn len(&self) -> usize {
                match self {
                    $(Values::$variant(v) => v.len(),)*
                }
            }

            /// True when there is no scalar.
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// Every scalar as f64.
            pub fn to_f64(&self) -> Vec<f64> {
                match self {
                    $(Values::$variant(v) => v.iter().map(|&x| x.as_f64()).collect(),)*
                }
            }

            /// Type of the scalars.
            pub fn dtype(&self) -> Dtype {
                match self {
                    $(Values::$variant(_) => Dtype::$variant,)*
                }
            }

            /// Appends the bytes of all scalars, little-endian.
            pub fn put_bytes(&self, out: &mut Vec<u8>) {
                match self {
                    $(Values::$variant(v) => v.iter().for_each(|&x| x.put(out)),)*
                }
            }

            /// The scalars of little-endian bytes; of a last scalar that is not whole, nothing is read.
            pub fn from_bytes(dtype: Dtype, bytes: &[u8]) -> Self {
                match dtype {
                    $(Dtype::$variant => {
                        Values::$variant(bytes.chunks_exact($bytes).map(<$scalar>::take).collect())
                    })*
                }
            }
        }

        $(impl Scalar for $scalar {
            const DTYPE: Dtype = Dtype::$variant;

            fn put(self, out: &mut Vec<u8>) {
                let put: fn($scalar) -> [u8; $bytes] = $put;
                out.extend_from_slice(&put(self));
            }

            fn take(bytes: &[u8]) -> Self {
                let take: fn([u8; $bytes]) -> $scalar = $take;
                let mut own = [0; $bytes];
                own.copy_from_slice(&bytes[..$bytes]);
                take(own)
            }

            fn as_f64(self) -> f64 {
                let convert: fn($scalar) -> f64 = $as_f64;
                convert(self)
            }
        })*
    };
}

dtypes! {
    Bool: bool, 1, "|b1", "bool", |x| [u8::from(x)], |b| b[0] != 0, |x| f64::from(u8::from(x));
    U8: u8, 1, "|u1", "uint8", u8::to_le_bytes, u8::from_le_bytes, f64::from;
    U16: u16, 2, "<u2", "uint16", u16::to_le_bytes, u16::from_le_bytes, f64::from;
    U32: u32, 4, "<u4", "uint32", u32::to_le_bytes, u32::from_le_bytes, f64::from;
    U64: u64, 8, "<u8", "uint64", u64::to_le_bytes, u64::from_le_bytes, |x| x as f64;
    I8: i8, 1, "|i1", "int8", i8::to_le_bytes, i8::from_le_bytes, f64::from;
    I16: i16, 2, "<i2", "int16", i16::to_le_bytes, i16::from_le_bytes, f64::from;
    I32: i32, 4, "<i4", "int32", i32::to_le_bytes, i32::from_le_bytes, f64::from;
    I64: i64, 8, "<i8", "int64", i64::to_le_bytes, i64::from_le_bytes, |x| x as f64;
    F16: F16, 2, "<f2", "float16", |x| x.0.to_le_bytes(), |b| F16(u16::from_le_bytes(b)), F16::to_f64;
    F32: f32, 4, "<f4", "float32", f32::to_le_bytes, f32::from_le_bytes, f64::from;
    F64: f64, 8, "<f8", "float64", f64::to_le_bytes, f64::from_le_bytes, |x| x;
}

/// An n-dimensional array.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Lengths of the axes; empty for a scalar.
    pub shape: Vec<usize>,
    /// Scalars, row-major.
    pub values: Values,
}

/// Why bytes are no array file that can be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NpyError(String);

impl fmt::Display for NpyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NpyError {}

impl Array {
    /// An f64 array.
    pub fn f64(shape: Vec<usize>, values: Vec<f64>) -> Self {
        Array { shape, values: Values::F64(values) }
    }

    /// An integer scalar.
    pub fn scalar_i64(value: i64) -> Self {
        Array { shape: vec![], values: Values::I64(vec![value]) }
    }

    /// Number of rows: the first axis, or one for a scalar.
    pub fn rows(&self) -> usize {
        self.shape.first().copied().unwrap_or(1)
    }

    /// The bytes of a `.npy` file, version 1.0.
    pub fn encode(&self) -> Vec<u8> {
        let mut out = header(self.values.dtype(), &self.shape, 0);
        self.values.put_bytes(&mut out);
        out
    }

    /// Reads the bytes of a `.npy` file.
    ///
    /// # Errors
    /// A sentence saying what is wrong with the bytes or unsupported in them.
    pub fn decode(bytes: &[u8]) -> Result<Self, NpyError> {
        Self::read(bytes).map_err(NpyError)
    }

    fn read(bytes: &[u8]) -> Result<Self, String> {
        if bytes.len() < 10 || &bytes[..6] != b"\x93NUMPY" {
            return Err("not a numpy array: the magic bytes are missing".into());
        }
        let (start, length) = match bytes[6] {
            1 => (10usize, u16::from_le_bytes([bytes[8], bytes[9]]) as usize),
            2 | 3 if bytes.len() >= 12 => {
                (12, u32::from_le_bytes([bytes[8], bytes[9], bytes[10], bytes[11]]) as usize)
            }
            v => return Err(format!("numpy format version {v} is unknown (1 to 3 are read)")),
        };
        let header = bytes.get(start..start.saturating_add(length)).ok_or("the header is cut off")?;
        let header = std::str::from_utf8(header).map_err(|_| "the header is not text")?;
        let (descr, fortran, shape) = parse_header(header)?;
        let count = shape
            .iter()
            .try_fold(1usize, |n, &axis| n.checked_mul(axis))
            .filter(|&n| n <= MAX_SCALARS)
            .ok_or_else(|| format!("shape {shape:?} has more than {MAX_SCALARS} values"))?;
        let values = decode_values(&bytes[start + length..], &descr, count)?;
        if fortran && shape.len() > 1 {
            return Err("Fortran order is not read: save numpy.ascontiguousarray(x)".into());
        }
        Ok(Array { shape, values })
    }
}

/// The bytes before the scalars, version 1.0: a multiple of 64, and at least `least`, which leaves room for axes that
/// grow.
pub(crate) fn header(dtype: Dtype, shape: &[usize], least: usize) -> Vec<u8> {
    let axes: Vec<String> = shape.iter().map(|n| format!("{n},")).collect();
    let (descr, axes) = (dtype.descr(), axes.join(" "));
    let mut text = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({axes}), }}");
    // Before the text stand ten bytes, after it a line end.
    let length = (text.len() + 11).max(least).next_multiple_of(64);
    text.extend(std::iter::repeat_n(' ', length - 11 - text.len()));
    text.push('\n');
    let mut out = b"\x93NUMPY\x01\x00".to_vec();
    out.extend((text.len() as u16).to_le_bytes());
    out.extend(text.bytes());
    out
}

/// The three entries of the header's dict literal.
fn parse_header(header: &str) -> Result<(String, bool, Vec<usize>), String> {
    let entry = |key: &str| {
        let at = header.find(key).ok_or_else(|| format!("the header has no {key}"))?;
        let rest = header[at + key.len()..].trim_start();
        rest.strip_prefix(':').map(str::trim_start).ok_or_else(|| format!("the header's {key} has no value"))
    };
    let descr = entry("'descr'")?
        .strip_prefix('\'')
        .and_then(|s| s.split('\'').next())
        .ok_or("structured dtypes are not read: save each field as its own array")?;
    let fortran = entry("'fortran_order'")?.starts_with("True");
    let shape = entry("'shape'")?
        .strip_prefix('(')
        .and_then(|s| s.split(')').next())
        .ok_or("the header's shape is no tuple")?
        .split(',')
        .map(str::trim)
        .filter(|s| !s.is_empty())
        .map(|s| s.parse().map_err(|_| format!("bad axis {s:?} in the header's shape")))
        .collect::<Result<_, _>>()?;
    Ok((descr.to_owned(), fortran, shape))
}

fn decode_values(bytes: &[u8], descr: &str, count: usize) -> Result<Values, String> {
    let dtype = Dtype::ALL.into_iter().find(|dtype| dtype.descr() == descr).ok_or_else(|| {
        let names: Vec<_> = Dtype::ALL.iter().map(|dtype| dtype.name()).collect();
        format!("dtype {descr:?} is not read: use one of {}", names.join(", "))
    })?;
    if bytes.len() != count * dtype.bytes() {
        let needed = count * dtype.bytes();
        return Err(format!("{} bytes of data where the shape needs {needed}", bytes.len()));
    }
    Ok(Values::from_bytes(dtype, bytes))
}
