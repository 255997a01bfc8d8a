//! Packets of protocol 1.0, which Feetech servos also use.
//!
//! `FF FF | id | length | instruction or error | parameters | checksum`: the length is the number of bytes after it, the checksum is the
//! complement of the sum of all bytes from the id.

use crate::servo::{Answer, Packets, Request, RequestError, Verdict, words};

/// The id to which all servos listen.
pub const BROADCAST: u8 = 0xFE;

const HEADER: [u8; 2] = [0xFF, 0xFF];
/// Bytes of a packet besides its parameters.
const FRAME: usize = 6;
/// Most bytes of parameters: the length, one byte, also counts the code and the checksum.
const MOST: usize = 253;

/// Codes of instructions. Only Feetech servos support the sync read, and only Dynamixel MX the bulk read.
pub mod instruction {
    #![allow(missing_docs)]
    pub const PING: u8 = 1;
    pub const READ: u8 = 2;
    pub const WRITE: u8 = 3;
    pub const REG_WRITE: u8 = 4;
    pub const ACTION: u8 = 5;
    pub const FACTORY_RESET: u8 = 6;
    pub const SYNC_READ: u8 = 0x82;
    pub const SYNC_WRITE: u8 = 0x83;
    pub const BULK_READ: u8 = 0x92;
}

/// Bits of the error byte.
pub mod error {
    #![allow(missing_docs)]
    use super::{Verdict, words};

    pub const VOLTAGE: u8 = 1;
    pub const ANGLE: u8 = 2;
    pub const HEAT: u8 = 4;
    pub const RANGE: u8 = 8;
    pub const CHECKSUM: u8 = 16;
    pub const OVERLOAD: u8 = 32;
    pub const INSTRUCTION: u8 = 64;

    const TROUBLE: [(u8, &str); 3] =
        [(VOLTAGE, "input voltage out of range"), (HEAT, "overheating"), (OVERLOAD, "overload")];
    const REFUSAL: [(u8, &str); 3] = [
        (ANGLE, "the goal is beyond its angle limits"),
        (RANGE, "the value is outside the register's range"),
        (INSTRUCTION, "it does not know the instruction"),
    ];

    /// The meaning of the bits.
    pub fn verdict(error: u8) -> Verdict {
        let said = |names: &[(u8, &str)]| {
            names.iter().any(|(bit, _)| error & bit != 0).then(|| words(names, error).into())
        };
        Verdict { damaged: error & CHECKSUM != 0, refusal: said(&REFUSAL), trouble: said(&TROUBLE) }
    }
}

/// A packet: an instruction, or an answer whose `code` is the error byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Packet<'a> {
    /// The servo that receives the instruction or sends the answer.
    pub id: u8,
    /// The instruction, or the error byte.
    pub code: u8,
    /// Parameters.
    pub parameters: &'a [u8],
}

/// Appends a packet to `out`.
///
/// # Errors
/// [`RequestError::TooLong`] for more than 253 bytes of parameters; `out` is then unchanged.
///
/// ```
/// use robohive_protocol::dynamixel::v1::{encode, instruction};
///
/// let mut bytes = Vec::new();
/// encode(&mut bytes, 1, instruction::PING, &[])?;
/// assert_eq!(bytes, [0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB]);
/// # Ok::<(), robohive_protocol::servo::RequestError>(())
/// ```
pub fn encode(out: &mut Vec<u8>, id: u8, code: u8, parameters: &[&[u8]]) -> Result<(), RequestError> {
    let length: usize = parameters.iter().map(|piece| piece.len()).sum();
    if length > MOST {
        return Err(RequestError::TooLong);
    }
    out.extend(HEADER);
    let start = out.len();
    out.extend([id, (length + 2) as u8, code]);
    parameters.iter().for_each(|piece| out.extend_from_slice(piece));
    let sum = checksum(&out[start..]);
    out.push(sum);
    Ok(())
}

fn checksum(bytes: &[u8]) -> u8 {
    !bytes.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte))
}

/// Finds packets in a stream of bytes, which may begin anywhere. Allocates nothing after the longest packet.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    bytes: Vec<u8>,
    used: usize,
}

impl Decoder {
    /// Takes received bytes.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.used);
        self.used = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// Drops bytes that are not decoded yet.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.used = 0;
    }

    /// The next packet with a correct checksum; `None` until more bytes arrive.
    pub fn next_packet(&mut self) -> Option<Packet<'_>> {
        let end = loop {
            let bytes = &self.bytes[self.used..];
            let start = (0..bytes.len()).find(|&at| bytes[at..].iter().zip(HEADER).all(|(b, h)| *b == h));
            self.used += start.unwrap_or(bytes.len());
            let bytes = &self.bytes[self.used..];
            let (&id, &length) = (bytes.get(2)?, bytes.get(3)?);
            let end = 4 + usize::from(length);
            // No id is FF: of three FF in a row, the packet begins at the second.
            if id == 0xFF || length < 2 {
                self.used += 1;
                continue;
            }
            let packet = bytes.get(..end)?;
            if checksum(&packet[2..end - 1]) == packet[end - 1] {
                break self.used + end;
            }
            self.used += 1;
        };
        let start = std::mem::replace(&mut self.used, end);
        let packet = &self.bytes[start..end];
        Some(Packet { id: packet[2], code: packet[4], parameters: &packet[5..packet.len() - 1] })
    }
}

/// Requests and answers of protocol 1.0.
pub struct PacketsV1 {
    decoder: Decoder,
    verdict: fn(u8) -> Verdict,
}

impl PacketsV1 {
    /// Packets whose error byte has this meaning.
    pub fn new(verdict: fn(u8) -> Verdict) -> PacketsV1 {
        PacketsV1 { decoder: Decoder::default(), verdict }
    }
}

impl Packets for PacketsV1 {
    fn frame(&self) -> usize {
        FRAME
    }

    fn encode(&mut self, out: &mut Vec<u8>, id: u8, request: Request<'_>) -> Result<(), RequestError> {
        let byte = |number: u16| u8::try_from(number).map_err(|_| RequestError::TooLong);
        match request {
            Request::Read(from, size) => encode(out, id, instruction::READ, &[&[byte(from)?, byte(size)?]]),
            Request::Write(from, data) => encode(out, id, instruction::WRITE, &[&[byte(from)?], data]),
            Request::Reboot | Request::FastSyncRead(..) => Err(RequestError::Unknown),
            Request::SyncRead(from, size, ids) => {
                encode(out, BROADCAST, instruction::SYNC_READ, &[&[byte(from)?, byte(size)?], ids])
            }
            Request::SyncWrite(from, size, data) => {
                encode(out, BROADCAST, instruction::SYNC_WRITE, &[&[byte(from)?, byte(size)?], data])
            }
        }
    }

    fn answers(&mut self, sent: &[u8], came: &[u8], take: &mut dyn FnMut(Answer<'_>) -> bool) -> bool {
        self.decoder.push(came);
        while let Some(Packet { id, code, parameters }) = self.decoder.next_packet() {
            // A converter that does not switch its receiver off echoes the request.
            let echoed = sent.get(2) == Some(&id)
                && sent.get(4) == Some(&code)
                && sent.get(5..sent.len() - 1) == Some(parameters);
            if !echoed && take(Answer { id, error: code, data: parameters }) {
                return true;
            }
        }
        false
    }

    fn clear(&mut self) {
        self.decoder.clear();
    }

    fn verdict(&self, error: u8) -> Verdict {
        (self.verdict)(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Examples of the e-Manual's page, and of Feetech's document the first.
    #[test]
    fn bytes_of_the_documents_examples() {
        let examples: [(u8, u8, &[u8], &[u8]); 11] = [
            (1, instruction::READ, &[0x38, 2], &[0xFF, 0xFF, 1, 4, 2, 0x38, 2, 0xBE]),
            (1, 3, &[0x0C, 0x64, 0xAA], &[0xFF, 0xFF, 1, 5, 3, 0x0C, 0x64, 0xAA, 0xDC]),
            (1, instruction::PING, &[], &[0xFF, 0xFF, 1, 2, 1, 0xFB]),
            (1, error::OVERLOAD | error::HEAT, &[], &[0xFF, 0xFF, 1, 2, 0x24, 0xD8]),
            (1, instruction::READ, &[0x2B, 1], &[0xFF, 0xFF, 1, 4, 2, 0x2B, 1, 0xCC]),
            (1, 0, &[0x20], &[0xFF, 0xFF, 1, 3, 0, 0x20, 0xDB]),
            (BROADCAST, instruction::WRITE, &[3, 1], &[0xFF, 0xFF, 0xFE, 4, 3, 3, 1, 0xF6]),
            (1, instruction::REG_WRITE, &[0x1E, 0xF4, 1], &[0xFF, 0xFF, 1, 5, 4, 0x1E, 0xF4, 1, 0xE2]),
            (BROADCAST, instruction::ACTION, &[], &[0xFF, 0xFF, 0xFE, 2, 5, 0xFA]),
            (
                BROADCAST,
                instruction::SYNC_WRITE,
                &[0x1E, 4, 0, 0x10, 0, 0x50, 1, 1, 0x20, 2, 0x60, 3],
                &[0xFF, 0xFF, 0xFE, 0x0E, 0x83, 0x1E, 4, 0, 0x10, 0, 0x50, 1, 1, 0x20, 2, 0x60, 3, 0x67],
            ),
            (
                BROADCAST,
                instruction::BULK_READ,
                &[0, 2, 1, 0x1E, 2, 2, 0x24],
                &[0xFF, 0xFF, 0xFE, 9, 0x92, 0, 2, 1, 0x1E, 2, 2, 0x24, 0x1D],
            ),
        ];
        for (id, code, parameters, expected) in examples {
            let mut bytes = Vec::new();
            encode(&mut bytes, id, code, &[parameters]).unwrap();
            assert_eq!(bytes, expected);
            let mut decoder = Decoder::default();
            decoder.push(expected);
            assert_eq!(decoder.next_packet(), Some(Packet { id, code, parameters }));
        }
        let mut decoder = Decoder::default();
        decoder.push(&[0x00, 0xFF, 0xFF, 0xFF, 0x01, 0x04, 0x00, 0x18, 0x05, 0xDD]);
        let packet = Packet { id: 1, code: 0, parameters: &[0x18, 0x05] };
        assert_eq!(decoder.next_packet(), Some(packet));
        assert_eq!(decoder.next_packet(), None);
    }

    #[test]
    fn an_error_byte_says_what_is_refused_and_what_is_broken() {
        assert_eq!(error::verdict(0), Verdict::default());
        let both = error::verdict(error::ANGLE | error::HEAT | error::OVERLOAD);
        assert_eq!(both.refusal.as_deref(), Some("the goal is beyond its angle limits"));
        assert_eq!(both.trouble.as_deref(), Some("overheating, overload"));
        assert!(!both.damaged && error::verdict(error::CHECKSUM).damaged);
    }

    #[test]
    fn an_echo_is_told_from_an_answer_of_its_length() {
        let mut first = PacketsV1::new(error::verdict);
        let mut sent = Vec::new();
        first.encode(&mut sent, 1, Request::Read(36, 2)).unwrap();
        let mut answer = Vec::new();
        encode(&mut answer, 1, error::ANGLE, &[&[0x20, 0x02]]).unwrap();
        assert_eq!(sent.len(), answer.len());
        let mut heard = Vec::new();
        first.answers(&sent, &[&sent[..], &answer].concat(), &mut |answer| {
            heard.push((answer.error, answer.data.to_vec()));
            false
        });
        assert_eq!(heard, [(error::ANGLE, vec![0x20, 0x02])]);
    }

    #[test]
    fn what_the_protocol_cannot_say_is_an_error() {
        let (mut first, mut bytes) = (PacketsV1::new(error::verdict), Vec::new());
        assert_eq!(first.encode(&mut bytes, 1, Request::Reboot), Err(RequestError::Unknown));
        assert_eq!(
            first.encode(&mut bytes, 1, Request::FastSyncRead(36, 2, &[1])),
            Err(RequestError::Unknown)
        );
        // Of each servo an id and two bytes, after the address and the number of bytes: 83 servos fit.
        assert_eq!(
            first.encode(&mut bytes, 1, Request::SyncWrite(30, 2, &[0; 84 * 3])),
            Err(RequestError::TooLong)
        );
        assert_eq!(bytes, []);
        first.encode(&mut bytes, 1, Request::SyncWrite(30, 2, &[0; 83 * 3])).unwrap();
        let mut decoder = Decoder::default();
        decoder.push(&bytes);
        assert_eq!(decoder.next_packet().map(|packet| packet.parameters.len()), Some(2 + 83 * 3));
    }

    #[test]
    fn a_damaged_packet_does_not_hide_the_next() {
        let mut bytes = Vec::new();
        encode(&mut bytes, 1, instruction::WRITE, &[&[42, 0, 8]]).unwrap();
        let one = bytes.len();
        encode(&mut bytes, 2, instruction::PING, &[]).unwrap();
        for damaged in 0..one {
            let mut copy = bytes.clone();
            copy[damaged] ^= 0x40;
            let mut decoder = Decoder::default();
            decoder.push(&copy);
            // A length that is too long waits for bytes; more traffic uncovers what it hid.
            decoder.push(&bytes[one..].repeat(20));
            let found =
                std::iter::from_fn(|| decoder.next_packet().map(|packet| packet.id)).filter(|id| *id == 2);
            assert!(found.count() > 0, "byte {damaged}");
        }
    }
}
