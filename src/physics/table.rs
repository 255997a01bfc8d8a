//! Field tables: every array of `Model` and `Data` is declared once, and struct, allocation, reflection by name and
//! the bytes of a compiled file follow from that line.
//!
//! A row reads `name: type [rows; width]`: `width` is a constant (the element becomes `[type; width]`), or
//! `[rows, n; width]` where `n` is a run-time size and the array is kept flat.
//!
//! ```
//! let model = robohive_mjcf::load_str("<mujoco><worldbody><geom size='.1'/></worldbody></mujoco>")?.model;
//! let mut shapes = Vec::new();
//! model.visit(&mut |name, shape, values| {
//!     assert_eq!(shape.iter().product::<usize>(), values.len());
//!     shapes.push((name, shape));
//! });
//! assert!(shapes.contains(&("geom_size", vec![1, 3])));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

/// A borrowed array with its element type, as reflection hands it out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slice<'a> {
    /// Truth values.
    Bool(&'a [bool]),
    /// Bytes and characters.
    U8(&'a [u8]),
    /// Integers and indices, -1 for none.
    I32(&'a [i32]),
    /// File-sized offsets.
    I64(&'a [i64]),
    /// Single precision: colours, mesh vertices, height fields.
    F32(&'a [f32]),
    /// Numbers of the computation.
    F64(&'a [f64]),
}

/// A borrowed array to write, with its element type.
#[derive(Debug, PartialEq)]
pub enum SliceMut<'a> {
    /// Truth values.
    Bool(&'a mut [bool]),
    /// Bytes and characters.
    U8(&'a mut [u8]),
    /// Integers and indices, -1 for none.
    I32(&'a mut [i32]),
    /// File-sized offsets.
    I64(&'a mut [i64]),
    /// Single precision: colours, mesh vertices, height fields.
    F32(&'a mut [f32]),
    /// Numbers of the computation.
    F64(&'a mut [f64]),
}

/// Scalars handed out at a time.
const PIECE: usize = 1024;

impl Slice<'_> {
    /// Number of scalars.
    pub fn len(&self) -> usize {
        match self {
            Slice::Bool(s) => s.len(),
            Slice::U8(s) => s.len(),
            Slice::I32(s) => s.len(),
            Slice::I64(s) => s.len(),
            Slice::F32(s) => s.len(),
            Slice::F64(s) => s.len(),
        }
    }

    /// True when there is no scalar.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Every scalar widened to f64 (exact for all but 64-bit integers beyond 2^53).
    pub fn to_f64(&self) -> Vec<f64> {
        match self {
            Slice::Bool(s) => s.iter().map(|&x| f64::from(u8::from(x))).collect(),
            Slice::U8(s) => s.iter().map(|&x| f64::from(x)).collect(),
            Slice::I32(s) => s.iter().map(|&x| f64::from(x)).collect(),
            Slice::I64(s) => s.iter().map(|&x| x as f64).collect(),
            Slice::F32(s) => s.iter().map(|&x| f64::from(x)).collect(),
            Slice::F64(s) => s.to_vec(),
        }
    }

    /// Hands out every scalar in little-endian order of bytes, in pieces of whole words of eight bytes and a last one.
    pub fn pieces(&self, out: &mut dyn FnMut(&[u8])) {
        fn each<T: Copy, const N: usize>(s: &[T], bytes: impl Fn(T) -> [u8; N], out: &mut dyn FnMut(&[u8])) {
            let mut piece = [[0; N]; PIECE];
            for scalars in s.chunks(PIECE) {
                piece.iter_mut().zip(scalars).for_each(|(to, &x)| *to = bytes(x));
                out(piece[..scalars.len()].as_flattened());
            }
        }
        match self {
            Slice::Bool(s) => each(s, |x| [u8::from(x)], out),
            Slice::U8(s) => s.chunks(8 * PIECE).for_each(out),
            Slice::I32(s) => each(s, i32::to_le_bytes, out),
            Slice::I64(s) => each(s, i64::to_le_bytes, out),
            Slice::F32(s) => each(s, f32::to_le_bytes, out),
            Slice::F64(s) => each(s, f64::to_le_bytes, out),
        }
    }

    /// True for the two floating-point kinds.
    pub fn is_float(&self) -> bool {
        matches!(self, Slice::F32(_) | Slice::F64(_))
    }
}

/// The scalar type of a field.
pub trait Scalar: Copy + Default + PartialEq + std::fmt::Debug + Send + Sync + 'static {
    /// Wraps a slice with its type.
    fn slice(s: &[Self]) -> Slice<'_>;
    /// Wraps a slice to write with its type.
    fn slice_mut(s: &mut [Self]) -> SliceMut<'_>;
    /// Converts flat f64 values, the common currency of injected arrays.
    fn from_f64(x: f64) -> Self;
    /// Bytes in a compiled file.
    const BYTES: usize;
    /// Zero.
    const ZERO: Self;
    /// Reads `BYTES` little-endian bytes.
    fn from_bytes(bytes: &[u8]) -> Self;
}

/// The first bytes of a slice that is at least as long.
fn head<const N: usize>(bytes: &[u8]) -> [u8; N] {
    std::array::from_fn(|i| bytes[i])
}

macro_rules! scalar {
    ($t:ty, $v:ident, $zero:literal, |$x:ident| $e:expr, |$bytes:ident| $read:expr) => {
        impl Scalar for $t {
            fn slice(s: &[Self]) -> Slice<'_> {
                Slice::$v(s)
            }
            fn slice_mut(s: &mut [Self]) -> SliceMut<'_> {
                SliceMut::$v(s)
            }
            fn from_f64($x: f64) -> Self {
                $e
            }
            const BYTES: usize = size_of::<$t>();
            const ZERO: Self = $zero;
            fn from_bytes($bytes: &[u8]) -> Self {
                $read
            }
        }

        impl Row for $t {
            const COLUMNS: usize = 1;
            const BYTES: usize = <$t as Scalar>::BYTES;
            const ZERO: Self = $zero;
            fn scalars(rows: &[Self]) -> Slice<'_> {
                Slice::$v(rows)
            }
            fn scalars_mut(rows: &mut [Self]) -> SliceMut<'_> {
                SliceMut::$v(rows)
            }
            fn from_f64(values: &[f64]) -> Self {
                <$t as Scalar>::from_f64(values[0])
            }
            fn from_bytes(bytes: &[u8]) -> Self {
                <$t as Scalar>::from_bytes(bytes)
            }
        }
    };
}
scalar!(bool, Bool, false, |x| x != 0.0, |bytes| bytes[0] != 0);
scalar!(u8, U8, 0, |x| x as u8, |bytes| bytes[0]);
scalar!(i32, I32, 0, |x| x as i32, |bytes| i32::from_le_bytes(head(bytes)));
scalar!(i64, I64, 0, |x| x as i64, |bytes| i64::from_le_bytes(head(bytes)));
scalar!(f32, F32, 0.0, |x| x as f32, |bytes| f32::from_le_bytes(head(bytes)));
scalar!(f64, F64, 0.0, |x| x, |bytes| f64::from_le_bytes(head(bytes)));

/// One row of an array: a scalar, or a short vector of them.
pub trait Row: Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static {
    /// Scalars of a row.
    const COLUMNS: usize;
    /// Bytes of a row in a compiled file.
    const BYTES: usize;
    /// The row of zeros.
    const ZERO: Self;
    /// All scalars of some rows, in row-major order.
    fn scalars(rows: &[Self]) -> Slice<'_>;
    /// The same to write.
    fn scalars_mut(rows: &mut [Self]) -> SliceMut<'_>;
    /// A row of `COLUMNS` values.
    fn from_f64(values: &[f64]) -> Self;
    /// Reads `BYTES` little-endian bytes.
    fn from_bytes(bytes: &[u8]) -> Self;
}

impl<T: Scalar, const N: usize> Row for [T; N] {
    const COLUMNS: usize = N;
    const BYTES: usize = N * T::BYTES;
    const ZERO: Self = [T::ZERO; N];
    fn scalars(rows: &[Self]) -> Slice<'_> {
        T::slice(rows.as_flattened())
    }
    fn scalars_mut(rows: &mut [Self]) -> SliceMut<'_> {
        T::slice_mut(rows.as_flattened_mut())
    }
    fn from_f64(values: &[f64]) -> Self {
        std::array::from_fn(|i| T::from_f64(values[i]))
    }
    fn from_bytes(bytes: &[u8]) -> Self {
        std::array::from_fn(|i| T::from_bytes(&bytes[i * T::BYTES..]))
    }
}

/// Writes flat values over rows; false, with nothing written, when there are more or fewer.
pub(crate) fn assign_rows<R: Row>(rows: &mut [R], values: &[f64]) -> bool {
    let fits = values.len() == rows.len() * R::COLUMNS;
    if fits {
        rows.iter_mut().zip(values.chunks_exact(R::COLUMNS)).for_each(|(row, v)| *row = R::from_f64(v));
    }
    fits
}

/// Writes the rows that `bytes` holds over the first ones.
pub(crate) fn write_rows<R: Row>(rows: &mut [R], bytes: &[u8]) {
    rows.iter_mut().zip(bytes.chunks_exact(R::BYTES)).for_each(|(row, b)| *row = R::from_bytes(b));
}

/// Storage of one field: an array of rows.
pub trait Field {
    /// All scalars in row-major order.
    fn scalars(&self) -> Slice<'_>;
    /// Allocates `rows` zero rows of `width` run-time columns (1 for fixed-width fields).
    fn allocate(&mut self, rows: usize, width: usize);
    /// Replaces the content by flat values; false when they do not fill whole rows.
    fn assign(&mut self, values: &[f64]) -> bool;
    /// Overwrites rows from `first` on by as many as `bytes`, a multiple of `ROW_BYTES`, holds.
    fn write(&mut self, first: usize, bytes: &[u8]);
    /// Fixed columns of one row (1 for scalar rows).
    const COLUMNS: usize;
    /// Bytes of those columns in a compiled file.
    const ROW_BYTES: usize;
}

impl<R: Row> Field for Vec<R> {
    fn scalars(&self) -> Slice<'_> {
        R::scalars(self)
    }
    fn allocate(&mut self, rows: usize, width: usize) {
        self.clear();
        self.resize(rows * width, R::ZERO);
    }
    fn assign(&mut self, values: &[f64]) -> bool {
        let whole = values.len().is_multiple_of(R::COLUMNS);
        if whole {
            self.clear();
            self.extend(values.chunks_exact(R::COLUMNS).map(R::from_f64));
        }
        whole
    }
    fn write(&mut self, first: usize, bytes: &[u8]) {
        write_rows(&mut self[first..], bytes);
    }
    const COLUMNS: usize = R::COLUMNS;
    const ROW_BYTES: usize = R::BYTES;
}

macro_rules! row_type {
    ($t:ty, [$rows:ident; $n:literal]) => {
        [$t; $n]
    };
    ($t:ty, [$rows:ident $(, $w:ident)? $(; $n:literal)?]) => {
        $t
    };
}

macro_rules! field_type {
    ($t:ty, [$rows:ident; $n:literal]) => { Vec<[$t; $n]> };
    ($t:ty, [$rows:ident $(, $w:ident)? $(; $n:literal)?]) => { Vec<$t> };
}

macro_rules! field_shape {
    ($m:expr, [$rows:ident]) => {
        vec![$m.$rows]
    };
    ($m:expr, [$rows:ident; $n:literal]) => {
        vec![$m.$rows, $n]
    };
    ($m:expr, [$rows:ident, $w:ident]) => {
        vec![$m.$rows, $m.$w]
    };
    ($m:expr, [$rows:ident, $w:ident; $n:literal]) => {
        vec![$m.$rows, $m.$w * $n]
    };
}

macro_rules! field_width {
    ($m:expr, [$rows:ident]) => {
        1
    };
    ($m:expr, [$rows:ident; $n:literal]) => {
        1
    };
    ($m:expr, [$rows:ident, $w:ident]) => {
        $m.$w
    };
    ($m:expr, [$rows:ident, $w:ident; $n:literal]) => {
        $m.$w * $n
    };
}

macro_rules! field_rows {
    ($m:expr, [$rows:ident $($rest:tt)*]) => {
        $m.$rows
    };
}

pub(crate) use {field_rows, field_shape, field_type, field_width, row_type};
