//! The numpy array format, versions 1.0 to 3.0 (numpy documentation: `numpy.lib.format`).

/// Largest number of scalars an array may hold: 1 GiB of f64.
pub const MAX_SCALARS: usize = 1 << 27;

/// Type of an array's scalars.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dtype {
    /// `|b1`
    Bool,
    /// `|u1`
    U8,
    /// `<i4`
    I32,
    /// `<i8`
    I64,
    /// `<f4`
    F32,
    /// `<f8`
    F64,
}

impl Dtype {
    /// Bytes of one scalar.
    pub fn bytes(self) -> usize {
        match self {
            Dtype::Bool | Dtype::U8 => 1,
            Dtype::I32 | Dtype::F32 => 4,
            Dtype::I64 | Dtype::F64 => 8,
        }
    }

    fn descr(self) -> &'static str {
        match self {
            Dtype::Bool => "|b1",
            Dtype::U8 => "|u1",
            Dtype::I32 => "<i4",
            Dtype::I64 => "<i8",
            Dtype::F32 => "<f4",
            Dtype::F64 => "<f8",
        }
    }
}

/// Scalars of an array in row-major order.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// `|b1`
    Bool(Vec<bool>),
    /// `|u1`
    U8(Vec<u8>),
    /// `<i4`
    I32(Vec<i32>),
    /// `<i8`
    I64(Vec<i64>),
    /// `<f4`
    F32(Vec<f32>),
    /// `<f8`
    F64(Vec<f64>),
}

/// An n-dimensional array.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Lengths of the axes; empty for a scalar.
    pub shape: Vec<usize>,
    /// Scalars, row-major.
    pub values: Values,
}

impl Values {
    /// Number of scalars.
    pub fn len(&self) -> usize {
        match self {
            Values::Bool(v) => v.len(),
            Values::U8(v) => v.len(),
            Values::I32(v) => v.len(),
            Values::I64(v) => v.len(),
            Values::F32(v) => v.len(),
            Values::F64(v) => v.len(),
        }
    }

    /// True when there is no scalar.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Every scalar as f64.
    pub fn to_f64(&self) -> Vec<f64> {
        match self {
            Values::Bool(v) => v.iter().map(|&x| f64::from(u8::from(x))).collect(),
            Values::U8(v) => v.iter().map(|&x| f64::from(x)).collect(),
            Values::I32(v) => v.iter().map(|&x| f64::from(x)).collect(),
            Values::I64(v) => v.iter().map(|&x| x as f64).collect(),
            Values::F32(v) => v.iter().map(|&x| f64::from(x)).collect(),
            Values::F64(v) => v.clone(),
        }
    }

    /// Type of the scalars.
    pub fn dtype(&self) -> Dtype {
        match self {
            Values::Bool(_) => Dtype::Bool,
            Values::U8(_) => Dtype::U8,
            Values::I32(_) => Dtype::I32,
            Values::I64(_) => Dtype::I64,
            Values::F32(_) => Dtype::F32,
            Values::F64(_) => Dtype::F64,
        }
    }
}

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
        match &self.values {
            Values::Bool(v) => out.extend(v.iter().map(|&x| u8::from(x))),
            Values::U8(v) => out.extend(v),
            Values::I32(v) => out.extend(v.iter().flat_map(|x| x.to_le_bytes())),
            Values::I64(v) => out.extend(v.iter().flat_map(|x| x.to_le_bytes())),
            Values::F32(v) => out.extend(v.iter().flat_map(|x| x.to_le_bytes())),
            Values::F64(v) => out.extend(v.iter().flat_map(|x| x.to_le_bytes())),
        }
        out
    }

    /// Reads the bytes of a `.npy` file.
    ///
    /// # Errors
    /// A sentence saying what is wrong with the bytes or unsupported in them.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
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
    fn chunks<const N: usize>(bytes: &[u8], count: usize) -> Result<impl Iterator<Item = [u8; N]>, String> {
        if bytes.len() != count * N {
            return Err(format!("{} bytes of data where the shape needs {}", bytes.len(), count * N));
        }
        Ok(bytes.as_chunks::<N>().0.iter().copied())
    }
    Ok(match descr {
        "|b1" => Values::Bool(chunks::<1>(bytes, count)?.map(|b| b[0] != 0).collect()),
        "|u1" => Values::U8(chunks::<1>(bytes, count)?.map(|b| b[0]).collect()),
        "<i4" => Values::I32(chunks(bytes, count)?.map(i32::from_le_bytes).collect()),
        "<i8" => Values::I64(chunks(bytes, count)?.map(i64::from_le_bytes).collect()),
        "<f4" => Values::F32(chunks(bytes, count)?.map(f32::from_le_bytes).collect()),
        "<f8" => Values::F64(chunks(bytes, count)?.map(f64::from_le_bytes).collect()),
        other => {
            return Err(format!(
                "dtype {other:?} is not read: use bool, uint8, int32, int64, float32 or float64"
            ));
        }
    })
}
