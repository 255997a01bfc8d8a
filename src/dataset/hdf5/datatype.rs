//! Types of scalars as headers of datasets give them.

use super::bytes::Cursor;
use super::encode::float;
use super::error::Decoded;
use crate::npy::Dtype;

/// Type of the elements of a dataset.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Datatype {
    /// Numbers.
    Number {
        /// As numpy's.
        dtype: Dtype,
        /// True when the highest byte comes first.
        big_endian: bool,
    },
    /// Text of this many bytes at most.
    FixedText(u32),
    /// Text of any length, in a heap.
    Text,
    /// What is not read, by its name.
    Other(String),
}

const CLASSES: [&str; 12] = [
    "integer",
    "floating point",
    "time",
    "string",
    "bit field",
    "opaque",
    "compound",
    "reference",
    "enumeration",
    "sequence of any length",
    "array",
    "complex",
];

/// Decodes the body of a datatype message.
///
/// # Errors
/// The body is cut off.
pub fn decode(body: &[u8]) -> Decoded<Datatype> {
    let mut at = Cursor(body);
    decode_at(&mut at)
}

fn decode_at(at: &mut Cursor<'_>) -> Decoded<Datatype> {
    let whole = at.0;
    let head = at.byte()?;
    let (version, class) = (head >> 4, head & 15);
    let bits = at.number(3)?;
    let bytes = at.number(4)? as u32;
    let big_endian = bits & 1 == 1;
    let number = |dtype| Datatype::Number { dtype, big_endian };
    let other = |what: &str| Ok(Datatype::Other(what.to_owned()));
    match class {
        0 => {
            let (offset, precision) = (at.number(2)?, at.number(2)?);
            let plain = offset == 0 && precision == 8 * u64::from(bytes);
            match (bytes, bits & 8 != 0) {
                _ if !plain => other("integer with padding bits"),
                (1, false) => Ok(number(Dtype::U8)),
                (2, false) => Ok(number(Dtype::U16)),
                (4, false) => Ok(number(Dtype::U32)),
                (8, false) => Ok(number(Dtype::U64)),
                (1, true) => Ok(number(Dtype::I8)),
                (2, true) => Ok(number(Dtype::I16)),
                (4, true) => Ok(number(Dtype::I32)),
                (8, true) => Ok(number(Dtype::I64)),
                _ => other("integer of unusual size"),
            }
        }
        1 => {
            at.take(12)?;
            let ieee = |dtype: Dtype, fraction, bias| {
                let mut expected = float(dtype.bytes(), fraction, bias);
                // The version, and the order of bytes, may differ.
                expected[0] = head;
                expected[1] |= bits as u8 & 1;
                whole.starts_with(&expected)
            };
            let known = [(Dtype::F16, 10, 15), (Dtype::F32, 23, 127), (Dtype::F64, 52, 1023)];
            match known.into_iter().find(|&(dtype, fraction, bias)| ieee(dtype, fraction, bias)) {
                Some((dtype, ..)) => Ok(number(dtype)),
                None => other("floating point of unusual form"),
            }
        }
        3 if bytes > 0 => Ok(Datatype::FixedText(bytes)),
        8 => enumeration(at, version, (bits & 0xffff) as usize),
        9 if bits & 15 == 1 => Ok(Datatype::Text),
        _ => other(CLASSES.get(usize::from(class)).unwrap_or(&"unknown")),
    }
}

/// What h5py writes for numpy's bool is one; others are read as the integers that they are.
fn enumeration(at: &mut Cursor<'_>, version: u8, members: usize) -> Decoded<Datatype> {
    let base = decode_at(at)?;
    let Datatype::Number { dtype: Dtype::I8, .. } = base else { return Ok(base) };
    let mut names = Vec::new();
    for _ in 0..members {
        let length = at.0.iter().position(|&b| b == 0).ok_or("the names of an enumeration are cut off")?;
        names.push(at.0[..length].to_vec());
        let padded = if version < 3 { (length + 1).next_multiple_of(8) } else { length + 1 };
        at.take(padded)?;
    }
    let values = at.take(members)?;
    let truth =
        |name: &[u8], value| names.iter().zip(values).any(|(found, &given)| found == name && given == value);
    if members == 2 && truth(b"FALSE", 0) && truth(b"TRUE", 1) {
        return Ok(Datatype::Number { dtype: Dtype::Bool, big_endian: false });
    }
    Ok(base)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hdf5::encode::{Element, datatype};

    #[test]
    fn every_type_that_is_written_is_read() {
        for dtype in Dtype::ALL {
            let body = datatype(Element::Number(dtype));
            assert_eq!(decode(&body), Ok(Datatype::Number { dtype, big_endian: false }));
        }
        assert_eq!(decode(&datatype(Element::Text(7))), Ok(Datatype::FixedText(7)));
    }

    #[test]
    fn a_float_of_another_form_is_named() {
        let mut body = float(8, 52, 1023);
        body[16] = 0;
        assert_eq!(decode(&body), Ok(Datatype::Other("floating point of unusual form".into())));
        // bfloat16 has two bytes too.
        assert_eq!(decode(&float(2, 7, 127)), Ok(Datatype::Other("floating point of unusual form".into())));
    }
}
