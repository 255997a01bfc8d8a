//! Values as bytes, and messages as frames: little-endian numbers one after the other, counts before what they count.

use std::fmt;
use std::io::{Read, Write};

/// Most bytes of a message, 1 GiB: models with their meshes and textures are the longest.
pub const LONGEST: usize = 1 << 30;

/// Why bytes are no message.
#[derive(Debug)]
#[non_exhaustive]
pub enum WireError {
    /// The bytes end within a value, or a count exceeds them.
    Short,
    /// Bytes are left over after the value.
    Long(usize),
    /// A number that stands for none of the cases of a type.
    Unknown(&'static str, u64),
    /// The message has more bytes than [`LONGEST`].
    TooLarge(usize),
    /// The other side speaks another version of the protocol, or something else.
    Version(String),
    /// Nothing can be read or written any more.
    Io(std::io::Error),
}

impl fmt::Display for WireError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WireError::Short => f.write_str("the message is shorter than what it announces"),
            WireError::Long(bytes) => write!(f, "{bytes} bytes follow the end of the message"),
            WireError::Unknown(kind, code) => write!(f, "{code} stands for no {kind}"),
            WireError::TooLarge(bytes) => {
                write!(f, "a message of {bytes} bytes; the longest has {LONGEST}, 1 GiB")
            }
            WireError::Version(found) => {
                write!(f, "the other side speaks {found:?}, this one {:?}", super::PROTOCOL)
            }
            WireError::Io(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for WireError {}

impl From<std::io::Error> for WireError {
    fn from(error: std::io::Error) -> Self {
        WireError::Io(error)
    }
}

/// What can be written as bytes and read back.
pub trait Wire: Sized {
    /// Appends the value.
    fn put(&self, out: &mut Vec<u8>);

    /// Reads a value and removes it from the front of `from`.
    ///
    /// # Errors
    /// The bytes are no such value.
    fn take(from: &mut &[u8]) -> Result<Self, WireError>;
}

/// The first `count` bytes of `from`, which are removed.
pub fn split<'a>(from: &mut &'a [u8], count: usize) -> Result<&'a [u8], WireError> {
    let (head, tail) = from.split_at_checked(count).ok_or(WireError::Short)?;
    *from = tail;
    Ok(head)
}

macro_rules! numbers {
    ($($type:ty),*) => {$(
        impl Wire for $type {
            fn put(&self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }

            fn take(from: &mut &[u8]) -> Result<Self, WireError> {
                let bytes = split(from, size_of::<$type>())?;
                Ok(<$type>::from_le_bytes(bytes.try_into().map_err(|_| WireError::Short)?))
            }
        }
    )*};
}
numbers!(u8, i32, u32, u64, f32, f64);

impl Wire for bool {
    fn put(&self, out: &mut Vec<u8>) {
        out.push(u8::from(*self));
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        match u8::take(from)? {
            code @ 0..=1 => Ok(code == 1),
            code => Err(WireError::Unknown("truth value", code.into())),
        }
    }
}

impl Wire for usize {
    fn put(&self, out: &mut Vec<u8>) {
        (*self as u64).put(out);
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        let number = u64::take(from)?;
        usize::try_from(number).map_err(|_| WireError::Unknown("number of this machine", number))
    }
}

impl<T: Wire + Copy + Default, const N: usize> Wire for [T; N] {
    fn put(&self, out: &mut Vec<u8>) {
        self.iter().for_each(|value| value.put(out));
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        let mut values = [T::default(); N];
        values.iter_mut().try_for_each(|value| T::take(from).map(|taken| *value = taken))?;
        Ok(values)
    }
}

impl<T: Wire> Wire for Vec<T> {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        self.iter().for_each(|value| value.put(out));
    }

    /// Grows with what is there, whatever the count says.
    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        let count = usize::take(from)?;
        if count > from.len() {
            return Err(WireError::Short);
        }
        (0..count).map(|_| T::take(from)).collect()
    }
}

impl Wire for String {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        out.extend_from_slice(self.as_bytes());
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        let count = usize::take(from)?;
        Ok(String::from_utf8_lossy(split(from, count)?).into_owned())
    }
}

impl<T: Wire> Wire for Option<T> {
    fn put(&self, out: &mut Vec<u8>) {
        self.is_some().put(out);
        if let Some(value) = self {
            value.put(out);
        }
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        bool::take(from)?.then(|| T::take(from)).transpose()
    }
}

/// Writes and reads structs field by field. With `start`, those that others may add fields to: these keep their start value.
macro_rules! record {
    ($type:ident { $($field:ident),* $(,)? } $(start $start:expr)?) => {
        impl $crate::remote::wire::Wire for $type {
            fn put(&self, out: &mut Vec<u8>) {
                $(self.$field.put(out);)*
            }

            fn take(from: &mut &[u8]) -> Result<Self, $crate::remote::wire::WireError> {
                $(let $field = $crate::remote::wire::Wire::take(from)?;)*
                record!(@made $type { $($field),* } $($start)?)
            }
        }
    };
    (@made $type:ident { $($field:ident),* }) => { Ok($type { $($field),* }) };
    (@made $type:ident { $($field:ident),* } $start:expr) => {{
        let mut made: $type = $start;
        $(made.$field = $field;)*
        Ok(made)
    }};
}

/// Writes and reads enums: a code for each case, then what it holds.
macro_rules! cases {
    ($type:ident { $($code:literal => $case:ident $(($field:ident))?,)* }) => {
        impl $crate::remote::wire::Wire for $type {
            fn put(&self, out: &mut Vec<u8>) {
                match self {
                    $($type::$case $(($field))? => {
                        out.push($code);
                        $($field.put(out);)?
                    })*
                }
            }

            fn take(from: &mut &[u8]) -> Result<Self, $crate::remote::wire::WireError> {
                match u8::take(from)? {
                    $($code => Ok($type::$case $(({
                        let $field = $crate::remote::wire::Wire::take(from)?;
                        $field
                    }))?),)*
                    code => Err($crate::remote::wire::WireError::Unknown(stringify!($type), code.into())),
                }
            }
        }
    };
}

pub(super) use {cases, record};

/// Sends a message: its length, then its bytes.
///
/// # Errors
/// It is too long, or nobody listens any more.
pub fn send<T: Wire>(message: &T, to: &mut impl Write) -> Result<(), WireError> {
    let mut bytes = vec![0; 8];
    message.put(&mut bytes);
    let length = bytes.len() - 8;
    if length > LONGEST {
        return Err(WireError::TooLarge(length));
    }
    bytes[..8].copy_from_slice(&(length as u64).to_le_bytes());
    to.write_all(&bytes)?;
    Ok(to.flush()?)
}

/// Receives a message; `None` where the other side has closed its end between two messages.
///
/// # Errors
/// It is none, it is too long, or it breaks off.
pub fn receive<T: Wire>(from: &mut impl Read) -> Result<Option<T>, WireError> {
    let mut head = [0; 8];
    let mut filled = 0;
    while filled < head.len() {
        match from.read(&mut head[filled..]) {
            Ok(0) if filled == 0 => return Ok(None),
            Ok(0) => return Err(WireError::Short),
            Ok(count) => filled += count,
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error.into()),
        }
    }
    let length = usize::try_from(u64::from_le_bytes(head)).unwrap_or(usize::MAX);
    if length > LONGEST {
        return Err(WireError::TooLarge(length));
    }
    // Grows with what arrives, so that a length alone takes no memory.
    let mut bytes = Vec::new();
    from.by_ref().take(length as u64).read_to_end(&mut bytes)?;
    if bytes.len() < length {
        return Err(WireError::Short);
    }
    let mut rest = &bytes[..];
    let message = T::take(&mut rest)?;
    if rest.is_empty() { Ok(Some(message)) } else { Err(WireError::Long(rest.len())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_message_is_an_error() {
        let mut sent = Vec::new();
        send(&vec!["one".to_owned(), "zwölf".to_owned()], &mut sent).unwrap();
        let mut read = &sent[..];
        assert_eq!(receive::<Vec<String>>(&mut read).unwrap().unwrap(), ["one", "zwölf"]);
        assert!(receive::<Vec<String>>(&mut read).unwrap().is_none(), "the end");
        for cut in 1..sent.len() {
            assert!(matches!(receive::<Vec<String>>(&mut &sent[..cut]), Err(WireError::Short)), "{cut}");
        }
        let mut long = sent.clone();
        long[0] += 1;
        long.push(7);
        assert!(matches!(receive::<Vec<String>>(&mut &long[..]), Err(WireError::Long(1))));
        assert!(matches!(receive::<Vec<bool>>(&mut &sent[..]), Err(WireError::Unknown("truth value", 3))));
        let huge = [u64::MAX.to_le_bytes(), [0; 8]].concat();
        assert!(matches!(receive::<Vec<String>>(&mut &huge[..]), Err(WireError::TooLarge(_))));
        // A count beyond the bytes takes no memory.
        let count = [8_u64.to_le_bytes(), (1_u64 << 40).to_le_bytes()].concat();
        assert!(matches!(receive::<Vec<f64>>(&mut &count[..]), Err(WireError::Short)));
    }
}
