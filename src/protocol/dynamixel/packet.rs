//! Packets of protocol 2.0.
//!
//! `FF FF FD 00 | id | length, 2 bytes | instruction | parameters | CRC, 2 bytes`, where the length counts what follows it.
//! `FF FF FD` after the length gets a further `FD`, so that a header stands nowhere else; the CRC is over all before it,
//! as it is sent.

use crate::crc;

/// The id that all servos listen to.
pub const BROADCAST: u8 = 0xFE;

const HEADER: [u8; 4] = [0xFF, 0xFF, 0xFD, 0x00];
/// Header, id, length.
const PREFIX: usize = 7;
/// Longest packet that is taken for one; a sync write to all 253 servos is shorter.
const MAX_LENGTH: usize = 4096;

/// Instructions, as the byte that says which.
pub mod instruction {
    #![allow(missing_docs)]
    pub const PING: u8 = 0x01;
    pub const READ: u8 = 0x02;
    pub const WRITE: u8 = 0x03;
    pub const REG_WRITE: u8 = 0x04;
    pub const ACTION: u8 = 0x05;
    pub const FACTORY_RESET: u8 = 0x06;
    pub const REBOOT: u8 = 0x08;
    pub const CLEAR: u8 = 0x10;
    pub const STATUS: u8 = 0x55;
    pub const SYNC_READ: u8 = 0x82;
    pub const SYNC_WRITE: u8 = 0x83;
    pub const FAST_SYNC_READ: u8 = 0x8A;
    pub const BULK_READ: u8 = 0x92;
    pub const BULK_WRITE: u8 = 0x93;
}

/// Why a servo refused, as the lower seven bits of the error byte; bit 7 says that its hardware has an error.
pub mod status_error {
    #![allow(missing_docs)]
    pub const RESULT: u8 = 1;
    pub const INSTRUCTION: u8 = 2;
    pub const CRC: u8 = 3;
    pub const DATA_RANGE: u8 = 4;
    pub const DATA_LENGTH: u8 = 5;
    pub const DATA_LIMIT: u8 = 6;
    pub const ACCESS: u8 = 7;
    pub const ALERT: u8 = 0x80;

    /// The number in words.
    pub fn describe(error: u8) -> &'static str {
        match error & !ALERT {
            0 => "no error",
            RESULT => "it could not process the packet",
            INSTRUCTION => "it does not know the instruction",
            CRC => "the checksum was wrong",
            DATA_RANGE => "the value is outside the register's range",
            DATA_LENGTH => "the data are shorter than the register",
            DATA_LIMIT => "the value is beyond a limit register",
            ACCESS => "the register cannot be written now (read-only, or torque is on)",
            _ => "an error that the protocol does not define",
        }
    }
}

/// An instruction or a status, without its stuffing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Packet<'a> {
    /// The servo that is asked or answers.
    pub id: u8,
    /// One of [`instruction`].
    pub instruction: u8,
    /// Parameters; of a status, the error byte comes first.
    pub parameters: &'a [u8],
}

/// What looked like a packet and was none: its checksum or length is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corrupt {
    /// The id that it named, which may be wrong as well.
    pub id: u8,
}

/// Appends a packet to `out`. The parameters are given in pieces, so that nobody must put them together first.
///
/// ```
/// use robohive_protocol::dynamixel::{encode, instruction};
///
/// let mut bytes = Vec::new();
/// encode(&mut bytes, 1, instruction::PING, &[]);
/// assert_eq!(bytes, [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01, 0x19, 0x4E]);
/// ```
pub fn encode(out: &mut Vec<u8>, id: u8, instruction: u8, parameters: &[&[u8]]) {
    let start = out.len();
    out.extend(HEADER);
    out.extend([id, 0, 0, instruction]);
    let body = out.len() - 1;
    for byte in parameters.iter().copied().flatten() {
        out.push(*byte);
        if out[body..].ends_with(&HEADER[..3]) {
            out.push(0xFD);
        }
    }
    let length = (out.len() - body + 2) as u16;
    out[start + 5..start + 7].copy_from_slice(&length.to_le_bytes());
    let crc = crc::buypass(0, &out[start..]);
    out.extend(crc.to_le_bytes());
}

/// Finds packets in a stream of bytes, wherever it begins.
///
/// Decoding allocates nothing once the buffer has held the longest packet.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    /// Bytes that came, up to `used` already decoded.
    bytes: Vec<u8>,
    used: usize,
    /// Parameters of the last packet without stuffing.
    parameters: Vec<u8>,
}

impl Decoder {
    /// One that never allocates again where at most `most` bytes come at once, whatever they are.
    pub fn with_room(most: usize) -> Decoder {
        Decoder {
            bytes: Vec::with_capacity(PREFIX + MAX_LENGTH + most),
            used: 0,
            parameters: Vec::with_capacity(MAX_LENGTH),
        }
    }

    /// Takes what came.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.used);
        self.used = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// Drops what came and was not decoded.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.used = 0;
    }

    /// The next packet; `None` until more bytes come. Bytes that belong to no packet are skipped.
    pub fn next_packet(&mut self) -> Option<Result<Packet<'_>, Corrupt>> {
        self.used += start_of_packet(&self.bytes[self.used..]);
        let bytes = &self.bytes[self.used..];
        if bytes.len() < PREFIX {
            return None;
        }
        let id = bytes[4];
        let length = usize::from(u16::from_le_bytes([bytes[5], bytes[6]]));
        if !(3..=MAX_LENGTH).contains(&length) {
            self.used += HEADER.len();
            return Some(Err(Corrupt { id }));
        }
        let end = PREFIX + length;
        let packet = bytes.get(..end)?;
        let (covered, sum) = packet.split_at(end - 2);
        if crc::buypass(0, covered).to_le_bytes() != sum {
            // A wrong length would swallow the packets after it: only the header is left behind.
            self.used += HEADER.len();
            return Some(Err(Corrupt { id }));
        }
        let instruction = packet[PREFIX];
        if id == BROADCAST && packet[PREFIX] == instruction::STATUS {
            // Servos that answer a fast sync read together put nothing in between.
            self.parameters.clear();
            self.parameters.extend_from_slice(&covered[PREFIX..]);
        } else {
            unstuff(&covered[PREFIX..], &mut self.parameters);
        }
        self.used += end;
        Some(Ok(Packet { id, instruction, parameters: &self.parameters[1..] }))
    }
}

/// Bytes before what is, or may become, a header.
fn start_of_packet(bytes: &[u8]) -> usize {
    (0..bytes.len()).find(|&at| bytes[at..].iter().zip(HEADER).all(|(b, h)| *b == h)).unwrap_or(bytes.len())
}

/// Copies `stuffed` without the `FD` that follows each `FF FF FD`.
fn unstuff(stuffed: &[u8], plain: &mut Vec<u8>) {
    plain.clear();
    let mut bytes = stuffed.iter();
    while let Some(&byte) = bytes.next() {
        plain.push(byte);
        if plain.ends_with(&HEADER[..3]) && bytes.as_slice().first() == Some(&0xFD) {
            bytes.next();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Examples of the e-Manual: ping 1; read present position of 1; write goal position 512 to 1; its status.
    #[test]
    fn bytes_of_the_documents_examples() {
        let encoded = |id, instruction, parameters: &[u8]| {
            let mut bytes = Vec::new();
            encode(&mut bytes, id, instruction, &[parameters]);
            bytes
        };
        assert_eq!(
            encoded(1, instruction::READ, &[0x84, 0x00, 0x04, 0x00]),
            [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00, 0x02, 0x84, 0x00, 0x04, 0x00, 0x1D, 0x15]
        );
        assert_eq!(
            encoded(1, instruction::WRITE, &[0x74, 0x00, 0x00, 0x02, 0x00, 0x00]),
            [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x03, 0x74, 0x00, 0x00, 0x02, 0x00, 0x00, 0xCA, 0x89]
        );
        assert_eq!(
            encoded(1, instruction::STATUS, &[0x00, 0xA6, 0x00, 0x00, 0x00]),
            [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x55, 0x00, 0xA6, 0x00, 0x00, 0x00, 0x8C, 0xC0]
        );
    }

    #[test]
    fn every_pattern_of_stuffing_comes_back() {
        for parameters in [
            &[0xFF, 0xFF, 0xFD][..],
            &[0xFF, 0xFF, 0xFD, 0xFD],
            &[0xFF, 0xFF, 0xFF, 0xFD, 0x00],
            &[0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xFD],
            &[0xFD, 0xFF, 0xFF],
        ] {
            let mut bytes = vec![0xFF, 0x12];
            encode(&mut bytes, 7, instruction::WRITE, &[parameters]);
            assert!(!bytes[9..].windows(4).any(|w| w == HEADER), "a header inside {bytes:02X?}");
            let mut decoder = Decoder::default();
            for byte in &bytes[..bytes.len() - 1] {
                decoder.push(&[*byte]);
                assert_eq!(decoder.next_packet(), None);
            }
            decoder.push(&bytes[bytes.len() - 1..]);
            let packet = Packet { id: 7, instruction: instruction::WRITE, parameters };
            assert_eq!(decoder.next_packet(), Some(Ok(packet)));
            assert_eq!(decoder.next_packet(), None);
        }
    }

    #[test]
    fn a_packet_after_a_damaged_one_is_found() {
        let mut bytes = Vec::new();
        encode(&mut bytes, 1, instruction::PING, &[]);
        let one = bytes.len();
        encode(&mut bytes, 2, instruction::PING, &[]);
        for damaged in 0..one {
            let mut decoder = Decoder::default();
            let mut copy = bytes.clone();
            copy[damaged] ^= 0x40;
            decoder.push(&copy);
            // A damaged length may ask for bytes that never come; more traffic uncovers what it hid.
            decoder.push(&bytes[one..].repeat(if (5..7).contains(&damaged) { 2000 } else { 1 }));
            let mut found = 0;
            while let Some(packet) = decoder.next_packet() {
                found += usize::from(packet.is_ok_and(|packet| packet.id == 2));
            }
            assert!(found > 0, "byte {damaged}");
        }
    }
}
