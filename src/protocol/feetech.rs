//! Feetech servos of the STS series, as the arms SO-100 and SO-101 have them.
//!
//! A packet is `FF FF | id | length | instruction or error | parameters | checksum`: the length counts what follows it, the
//! checksum is the complement of the sum of all from the id on. Numbers of 16 bits are little-endian; those that can be
//! negative have their sign in a bit of its own.
//!
//! Source: Feetech, "STS series communication protocol" and memory table of the STS3215, checked against the table of the
//! crate `rustypot`.

/// The id that all servos listen to.
pub const BROADCAST: u8 = 0xFE;
/// What the register "model" of an STS3215 says.
pub const STS3215: u16 = 777;
/// Steps of one turn.
pub const STEPS_PER_TURN: f64 = 4096.0;
/// One step of position \[rad\], and one unit of velocity \[rad/s\].
pub const STEP: f64 = std::f64::consts::TAU / STEPS_PER_TURN;
/// One unit of acceleration \[rad/s²\]: 100 steps.
pub const ACCELERATION_UNIT: f64 = 100.0 * STEP;
/// One unit of current \[A\].
pub const CURRENT_UNIT: f64 = 6.5e-3;
/// Bytes of the memory table.
pub const TABLE: usize = 88;

const HEADER: [u8; 2] = [0xFF, 0xFF];

/// Instructions.
pub mod instruction {
    #![allow(missing_docs)]
    pub const PING: u8 = 1;
    pub const READ: u8 = 2;
    pub const WRITE: u8 = 3;
    pub const REG_WRITE: u8 = 4;
    pub const ACTION: u8 = 5;
    pub const SYNC_READ: u8 = 0x82;
    pub const SYNC_WRITE: u8 = 0x83;
}

/// Bits of the error byte, and of the register "status".
pub mod trouble {
    #![allow(missing_docs)]
    pub const VOLTAGE: u8 = 1;
    pub const SENSOR: u8 = 2;
    pub const HEAT: u8 = 4;
    pub const CURRENT: u8 = 8;
    pub const OVERLOAD: u8 = 32;

    /// The bits in words.
    pub fn describe(bits: u8) -> String {
        let names = [
            (VOLTAGE, "voltage"),
            (SENSOR, "position sensor"),
            (HEAT, "overheating"),
            (CURRENT, "too much current"),
            (OVERLOAD, "overload"),
        ];
        let words: Vec<_> = names.iter().filter(|(bit, _)| bits & bit != 0).map(|(_, word)| *word).collect();
        if words.is_empty() { format!("unknown ({bits:#04x})") } else { words.join(", ") }
    }
}

/// Addresses of the memory table.
pub mod address {
    #![allow(missing_docs)]
    pub const MODEL: u8 = 3;
    pub const ID: u8 = 5;
    pub const BAUD_RATE: u8 = 6;
    pub const RETURN_DELAY: u8 = 7;
    pub const MIN_ANGLE: u8 = 9;
    pub const MAX_ANGLE: u8 = 11;
    pub const MAX_TEMPERATURE: u8 = 13;
    pub const MAX_TORQUE: u8 = 16;
    pub const OFFSET: u8 = 31;
    pub const MODE: u8 = 33;
    pub const TORQUE_ENABLE: u8 = 40;
    pub const ACCELERATION: u8 = 41;
    pub const GOAL_POSITION: u8 = 42;
    pub const GOAL_TIME: u8 = 44;
    pub const GOAL_VELOCITY: u8 = 46;
    pub const TORQUE_LIMIT: u8 = 48;
    /// Registers below [`TORQUE_ENABLE`] outlive a restart, and are written only while this is 0.
    pub const LOCK: u8 = 55;
    pub const PRESENT_POSITION: u8 = 56;
    pub const PRESENT_VELOCITY: u8 = 58;
    pub const PRESENT_LOAD: u8 = 60;
    pub const PRESENT_VOLTAGE: u8 = 62;
    pub const PRESENT_TEMPERATURE: u8 = 63;
    pub const STATUS: u8 = 65;
    pub const MOVING: u8 = 66;
    pub const PRESENT_CURRENT: u8 = 69;
}

/// A packet: an instruction, or an answer whose `code` is the error byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Packet<'a> {
    /// Who is asked, or answers.
    pub id: u8,
    /// The instruction, or the error byte.
    pub code: u8,
    /// Parameters.
    pub parameters: &'a [u8],
}

/// Appends a packet to `out`.
///
/// ```
/// use robohive_protocol::feetech::{encode, instruction};
///
/// let mut bytes = Vec::new();
/// encode(&mut bytes, 1, instruction::PING, &[]);
/// assert_eq!(bytes, [0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB]);
/// ```
pub fn encode(out: &mut Vec<u8>, id: u8, code: u8, parameters: &[&[u8]]) {
    let length: usize = parameters.iter().map(|piece| piece.len()).sum();
    out.extend(HEADER);
    let start = out.len();
    out.extend([id, (length + 2) as u8, code]);
    parameters.iter().for_each(|piece| out.extend_from_slice(piece));
    let sum = checksum(&out[start..]);
    out.push(sum);
}

fn checksum(bytes: &[u8]) -> u8 {
    !bytes.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte))
}

/// Finds packets in a stream of bytes, wherever it begins. It allocates nothing once its buffer has held the longest.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    bytes: Vec<u8>,
    used: usize,
}

impl Decoder {
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

    /// The next packet whose checksum is right; `None` until more bytes come.
    pub fn next_packet(&mut self) -> Option<Packet<'_>> {
        let end = loop {
            let bytes = &self.bytes[self.used..];
            let start = (0..bytes.len()).find(|&at| bytes[at..].iter().zip(HEADER).all(|(b, h)| *b == h));
            self.used += start.unwrap_or(bytes.len());
            let bytes = &self.bytes[self.used..];
            let (&id, &length) = (bytes.get(2)?, bytes.get(3)?);
            let end = 4 + usize::from(length);
            // No id is FF, so that three in a row begin one byte later.
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

/// A number as the register has it whose sign is bit 15; what is too large is clipped.
pub fn signed(value: i32) -> u16 {
    let magnitude = value.unsigned_abs().min(0x7FFF) as u16;
    if value < 0 { magnitude | 0x8000 } else { magnitude }
}

/// The number in a register whose sign is bit 15.
pub fn unsigned(register: u16) -> i32 {
    let magnitude = i32::from(register & 0x7FFF);
    if register & 0x8000 != 0 { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Examples of Feetech's protocol document: read two bytes from address 56 of servo 1, and its answer.
    #[test]
    fn bytes_of_the_documents_examples() {
        let mut bytes = Vec::new();
        encode(&mut bytes, 1, instruction::READ, &[&[0x38], &[0x02]]);
        assert_eq!(bytes, [0xFF, 0xFF, 0x01, 0x04, 0x02, 0x38, 0x02, 0xBE]);
        let mut decoder = Decoder::default();
        decoder.push(&[0x00, 0xFF, 0xFF, 0xFF, 0x01, 0x04, 0x00, 0x18, 0x05, 0xDD]);
        let packet = Packet { id: 1, code: 0, parameters: &[0x18, 0x05] };
        assert_eq!(decoder.next_packet(), Some(packet));
        assert_eq!(decoder.next_packet(), None);
    }

    #[test]
    fn a_damaged_packet_does_not_hide_the_next() {
        let mut bytes = Vec::new();
        encode(&mut bytes, 1, instruction::WRITE, &[&[42, 0, 8]]);
        let one = bytes.len();
        encode(&mut bytes, 2, instruction::PING, &[]);
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

    #[test]
    fn signs_have_a_bit_of_their_own() {
        for value in [0, 1, -1, 4095, -4095, 32_767, -32_767] {
            assert_eq!(unsigned(signed(value)), value);
        }
        assert_eq!((signed(-2), signed(-100_000)), (0x8002, 0xFFFF));
    }
}
