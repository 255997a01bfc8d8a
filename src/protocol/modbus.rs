//! Modbus RTU: `address | function | data | CRC, 2 bytes`; numbers are big-endian, the CRC is not.
//!
//! Source: "MODBUS over serial line", modbus.org.

use crate::crc;

/// Functions, as the byte that says which.
pub mod function {
    #![allow(missing_docs)]
    pub const READ_HOLDING: u8 = 3;
    pub const READ_INPUT: u8 = 4;
    pub const WRITE_MULTIPLE: u8 = 16;
    /// Set where a reply is a refusal.
    pub const EXCEPTION: u8 = 0x80;
}

/// Why a device refused, in words.
pub fn describe_exception(code: u8) -> &'static str {
    match code {
        1 => "it does not know the function",
        2 => "it has no such register",
        3 => "it does not take the value",
        4 => "it failed",
        _ => "it gave a reason that the protocol does not define",
    }
}

/// Most registers of one message.
pub const MOST: u16 = 123;

/// What a device is asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// Registers from one on, by function 3 or 4.
    Read {
        /// 3 or 4.
        function: u8,
        /// The first register.
        from: u16,
        /// How many.
        count: u16,
    },
    /// Sets registers from one on.
    Write {
        /// The first register.
        from: u16,
        /// Their bytes, two of each.
        bytes: Vec<u8>,
    },
    /// A function that is none of these.
    Unknown(u8),
}

/// Appends the CRC of what is in `frame`.
fn seal(mut frame: Vec<u8>) -> Vec<u8> {
    frame.extend(crc::modbus(&frame).to_le_bytes());
    frame
}

impl Request {
    /// The bytes on the line.
    pub fn encode(&self, address: u8) -> Vec<u8> {
        let mut frame = vec![address];
        match self {
            Request::Read { function, from, count } => {
                frame.push(*function);
                frame.extend(from.to_be_bytes());
                frame.extend(count.to_be_bytes());
            }
            Request::Write { from, bytes } => {
                frame.push(function::WRITE_MULTIPLE);
                frame.extend(from.to_be_bytes());
                frame.extend((bytes.len() as u16 / 2).to_be_bytes());
                frame.push(bytes.len() as u8);
                frame.extend(bytes);
            }
            Request::Unknown(function) => frame.push(*function),
        }
        seal(frame)
    }

    /// The request at the start of `bytes` and how long it is; `None` until more come, an error where its CRC is wrong.
    pub fn decode(bytes: &[u8]) -> Option<Result<(u8, Request, usize), Corrupt>> {
        let [address, function, rest @ ..] = bytes else { return None };
        let length = match *function {
            function::READ_HOLDING | function::READ_INPUT => 8,
            function::WRITE_MULTIPLE => 9 + usize::from(*rest.get(4)?),
            _ => 4,
        };
        let frame = bytes.get(..length)?;
        let (covered, sum) = frame.split_at(length - 2);
        if crc::modbus(covered).to_le_bytes() != sum {
            return Some(Err(Corrupt));
        }
        let word = |at: usize| u16::from_be_bytes([covered[at], covered[at + 1]]);
        let request = match *function {
            function::READ_HOLDING | function::READ_INPUT => {
                Request::Read { function: *function, from: word(2), count: word(4) }
            }
            function::WRITE_MULTIPLE => Request::Write { from: word(2), bytes: covered[7..].to_vec() },
            other => Request::Unknown(other),
        };
        Some(Ok((*address, request, length)))
    }

    /// Bytes of the reply to it, where it is no refusal.
    pub fn reply_length(&self) -> usize {
        match self {
            Request::Read { count, .. } => 5 + 2 * usize::from(*count),
            Request::Write { .. } => 8,
            Request::Unknown(_) => 5,
        }
    }

    /// The reply that gives what was read, or says that it was written.
    pub fn reply(&self, address: u8, read: &[u8]) -> Vec<u8> {
        let mut frame = vec![address];
        match self {
            Request::Read { function, .. } => {
                frame.extend([*function, read.len() as u8]);
                frame.extend(read);
            }
            Request::Write { from, bytes } => {
                frame.push(function::WRITE_MULTIPLE);
                frame.extend(from.to_be_bytes());
                frame.extend((bytes.len() as u16 / 2).to_be_bytes());
            }
            Request::Unknown(function) => return refusal(address, *function, 1),
        }
        seal(frame)
    }

    fn function(&self) -> u8 {
        match self {
            Request::Read { function, .. } | Request::Unknown(function) => *function,
            Request::Write { .. } => function::WRITE_MULTIPLE,
        }
    }

    /// What a reply to it says: bytes that were read, or the number of a refusal. `None` where it is no whole reply to it.
    pub fn answer<'a>(&self, address: u8, reply: &'a [u8]) -> Option<Result<&'a [u8], u8>> {
        let refused = *reply.get(1)? == self.function() | function::EXCEPTION;
        let length = if refused { 5 } else { self.reply_length() };
        let frame = reply.get(..length)?;
        let (covered, sum) = frame.split_at(length - 2);
        if covered[0] != address || crc::modbus(covered).to_le_bytes() != sum {
            return None;
        }
        match self {
            _ if refused => Some(Err(covered[2])),
            _ if covered[1] != self.function() => None,
            Request::Read { count, .. } => {
                (usize::from(covered[2]) == 2 * usize::from(*count)).then(|| Ok(&covered[3..]))
            }
            Request::Write { from, bytes } => {
                let echo = [from.to_be_bytes(), (bytes.len() as u16 / 2).to_be_bytes()];
                (covered[2..] == *echo.as_flattened()).then_some(Ok(&[][..]))
            }
            Request::Unknown(_) => None,
        }
    }
}

/// A refusal of a function, with its reason.
pub fn refusal(address: u8, function: u8, code: u8) -> Vec<u8> {
    seal(vec![address, function | function::EXCEPTION, code])
}

/// Bytes whose CRC is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corrupt;

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of Robotiq's manual.
    #[test]
    fn frames_are_those_of_the_manual() {
        let write = Request::Write { from: 0x03E8, bytes: vec![0x09, 0, 0, 0, 0xFF, 0xFF] };
        let bytes = write.encode(9);
        assert_eq!(bytes, [9, 0x10, 0x03, 0xE8, 0, 3, 6, 9, 0, 0, 0, 0xFF, 0xFF, 0x72, 0x19]);
        assert_eq!(write.reply(9, &[]), [9, 0x10, 0x03, 0xE8, 0, 3, 0x01, 0x30]);
        let read = Request::Read { function: 4, from: 0x07D0, count: 3 };
        assert_eq!(read.encode(9), [9, 4, 0x07, 0xD0, 0, 3, 0xB1, 0xCE]);
        let six = Request::Read { function: 3, from: 0x07D0, count: 6 };
        assert_eq!(six.encode(9), [9, 3, 0x07, 0xD0, 0, 6, 0xC4, 0x0D]);
        assert_eq!(
            Request::Write { from: 0x03E8, bytes: vec![1, 0, 0, 0, 0, 0] }.encode(9)[13..],
            [0x72, 0xE1]
        );
        assert_eq!(Request::Write { from: 0x03E8, bytes: vec![0; 6] }.encode(9)[13..], [0x73, 0x30]);
        assert_eq!(Request::decode(&bytes), Some(Ok((9, write, 15))));
    }

    #[test]
    fn replies_are_told_from_refusals_and_from_damage() {
        let read = Request::Read { function: 4, from: 0x07D0, count: 1 };
        let reply = read.reply(9, &[1, 2]);
        assert_eq!(read.answer(9, &reply), Some(Ok(&[1, 2][..])));
        assert_eq!(read.answer(8, &reply), None);
        assert_eq!(read.answer(9, &reply[..6]), None);
        assert_eq!(read.answer(9, &refusal(9, 4, 2)), Some(Err(2)));
        for at in 0..reply.len() {
            let mut damaged = reply.clone();
            damaged[at] ^= 4;
            assert_eq!(read.answer(9, &damaged), None, "byte {at}");
        }
        assert_eq!(Request::decode(&[9, 7, 0, 0]), Some(Err(Corrupt)));
        assert_eq!(Request::decode(&read.encode(9)[..7]), None);
    }
}
