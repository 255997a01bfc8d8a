//! Requests and answers of protocol 2.0, and the registers that drivers use.

use super::model::{KINDS, Model, hardware_error};
use super::packet::{BROADCAST, Decoder, encode, instruction, status_error};
use super::registers::address;
use crate::crc;
use crate::servo::{Answer, Cell, Family, Layout, Packets, Request, RequestError, Sign, Verdict};

/// Largest number of bytes of an answer besides its data: header, id, length, instruction, error, checksum, and stuffing.
const FRAME: usize = 16;
/// Bytes besides the data of each servo in the answer to a fast sync read: error and id before, a checksum after the data.
const BLOCK: usize = 4;

const fn signed(address: u16, size: u16) -> Cell {
    Cell::new(address, size).with_sign(Sign::Complement)
}

/// Registers that drivers use.
const LAYOUT: Layout = Layout {
    model: Cell::new(address::MODEL_NUMBER, 2),
    firmware: Some(Cell::new(address::FIRMWARE, 1)),
    return_delay: Some((Cell::new(address::RETURN_DELAY, 1), Model::DELAY_UNIT)),
    limits: [Cell::new(address::MIN_POSITION, 4), Cell::new(address::MAX_POSITION, 4)],
    torque: Cell::new(address::TORQUE_ENABLE, 1),
    lock: None,
    torque_limit: None,
    watchdog: Some(Cell::new(address::BUS_WATCHDOG, 1)),
    hardware_error: Some((Cell::new(address::HARDWARE_ERROR, 1), hardware_error::describe)),
    velocity_limit: Some(Cell::new(address::VELOCITY_LIMIT, 4)),
    acceleration: Some(Cell::new(address::PROFILE_ACCELERATION, 4)),
    speed: Cell::new(address::PROFILE_VELOCITY, 4),
    goal_position: signed(address::GOAL_POSITION, 4),
    goal_velocity: signed(address::GOAL_VELOCITY, 4),
    goal_current: Some(signed(address::GOAL_CURRENT, 2)),
    position: signed(address::PRESENT_POSITION, 4),
    velocity: signed(address::PRESENT_VELOCITY, 4),
    current: Some(signed(address::PRESENT_CURRENT, 2)),
};

/// Servos with protocol 2.0, for drivers.
pub static FAMILY: Family = Family {
    layout: &LAYOUT,
    kinds: &KINDS,
    sync_read: true,
    reboots: true,
    packets: || Box::new(PacketsV2::default()),
};

/// Packets of protocol 2.0. Allocates nothing after the longest answer.
struct PacketsV2 {
    decoder: Decoder,
    /// Number of bytes of each servo in the last fast sync read.
    fast: usize,
}

impl Default for PacketsV2 {
    fn default() -> PacketsV2 {
        /// Bytes that can be received at once without an allocation.
        const ROOM: usize = 1024;
        PacketsV2 { decoder: Decoder::with_room(ROOM), fast: 0 }
    }
}

impl Packets for PacketsV2 {
    fn frame(&self) -> usize {
        FRAME
    }

    fn encode(&mut self, out: &mut Vec<u8>, id: u8, request: Request<'_>) -> Result<(), RequestError> {
        let range = |from: u16, size: u16| [from.to_le_bytes(), size.to_le_bytes()];
        let mut all = |code: u8, from, size, rest: &[u8]| {
            encode(out, BROADCAST, code, &[range(from, size).as_flattened(), rest]);
        };
        match request {
            Request::SyncRead(from, size, ids) => all(instruction::SYNC_READ, from, size, ids),
            Request::FastSyncRead(from, size, ids) => {
                self.fast = usize::from(size);
                all(instruction::FAST_SYNC_READ, from, size, ids);
            }
            Request::SyncWrite(from, size, data) => all(instruction::SYNC_WRITE, from, size, data),
            Request::Read(from, size) => {
                encode(out, id, instruction::READ, &[range(from, size).as_flattened()]);
            }
            Request::Write(from, data) => encode(out, id, instruction::WRITE, &[&from.to_le_bytes(), data]),
            Request::Reboot => encode(out, id, instruction::REBOOT, &[]),
        }
        Ok(())
    }

    fn answers(&mut self, _sent: &[u8], came: &[u8], take: &mut dyn FnMut(Answer<'_>) -> bool) -> bool {
        let PacketsV2 { decoder, fast } = self;
        decoder.push(came);
        while let Some(packet) = decoder.next_packet() {
            // Damaged packets, and the echo of our own instruction, are skipped.
            let Ok(packet) = packet else { continue };
            if packet.instruction != instruction::STATUS {
                continue;
            }
            let done = if packet.id == BROADCAST {
                whole(packet.parameters, *fast) && blocks(packet.parameters, *fast).any(&mut *take)
            } else {
                packet
                    .parameters
                    .split_first()
                    .is_some_and(|(error, data)| take(Answer { id: packet.id, error: *error, data }))
            };
            if done {
                return true;
            }
        }
        false
    }

    fn clear(&mut self) {
        self.decoder.clear();
    }

    fn verdict(&self, error: u8) -> Verdict {
        let refused = error & !status_error::ALERT;
        Verdict {
            damaged: refused == status_error::CRC,
            refusal: (refused != 0).then(|| status_error::describe(refused).into()),
            trouble: (error & status_error::ALERT != 0).then(|| "an error of its hardware".into()),
        }
    }
}

/// The answers of all servos in the parameters of the answer to a fast sync read of `size` bytes.
fn blocks(parameters: &[u8], size: usize) -> impl Iterator<Item = Answer<'_>> {
    parameters.chunks(size + BLOCK).filter_map(move |block| {
        let [error, id, rest @ ..] = block else { return None };
        Some(Answer { id: *id, error: *error, data: rest.get(..size)? })
    })
}

/// Whether the checksum of every servo, over all bytes before it, is right. The last servo computes the packet's checksum from the
/// bytes that it received, so that one does not detect damage that the last servo received as well.
fn whole(parameters: &[u8], size: usize) -> bool {
    let length = (parameters.len() + 3) as u16;
    let [low, high] = length.to_le_bytes();
    let mut crc = crc::buypass(0, &[0xFF, 0xFF, 0xFD, 0x00, BROADCAST, low, high, instruction::STATUS]);
    // The checksum of the last servo is the packet's, which the decoder has verified.
    (parameters.len() + 2).is_multiple_of(size + BLOCK)
        && parameters.chunks(size + BLOCK).all(|block| {
            let (said, sum) = block.split_at(size + 2);
            crc = crc::buypass(crc, said);
            let right = sum.is_empty() || crc.to_le_bytes() == sum;
            crc = crc::buypass(crc, sum);
            right
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of the e-Manual: two servos whose present position, 4 bytes from 580 on, is 2000 and 9.
    const ANSWER: [u8; 24] = [
        0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x11, 0x00, 0x55, 0x00, 0x01, 0xD0, 0x07, 0x00, 0x00, 0x0C, 0x83, 0x00,
        0x02, 0x09, 0x00, 0x00, 0x00, 0x11, 0x40,
    ];

    fn heard(second: &mut PacketsV2, bytes: &[u8]) -> Vec<(u8, u8, Vec<u8>)> {
        let mut all = Vec::new();
        second.answers(&[], bytes, &mut |answer| {
            all.push((answer.id, answer.error, answer.data.to_vec()));
            false
        });
        all
    }

    #[test]
    fn a_fast_sync_read_is_that_of_the_document() {
        let mut second = PacketsV2::default();
        let mut bytes = Vec::new();
        second.encode(&mut bytes, BROADCAST, Request::FastSyncRead(580, 4, &[1, 2])).unwrap();
        assert_eq!(
            bytes,
            [0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x09, 0x00, 0x8A, 0x44, 0x02, 0x04, 0x00, 0x01, 0x02, 0x72, 0xF2]
        );
        let expected = [(1, 0, vec![0xD0, 0x07, 0, 0]), (2, 0, vec![9, 0, 0, 0])];
        assert_eq!(heard(&mut second, &ANSWER), expected);
        // In pieces, and behind an echo of the instruction.
        assert!(heard(&mut second, &[&bytes[..], &ANSWER[..20]].concat()).is_empty());
        assert_eq!(heard(&mut second, &ANSWER[20..]), expected);
    }

    #[test]
    fn what_the_last_servo_heard_wrongly_as_well_is_not_taken() {
        let mut second = PacketsV2::default();
        second.encode(&mut Vec::new(), BROADCAST, Request::FastSyncRead(580, 4, &[1, 2])).unwrap();
        for damaged in 8..16 {
            let mut bytes = ANSWER;
            bytes[damaged] ^= 0x10;
            let sum = crc::buypass(0, &bytes[..22]).to_le_bytes();
            bytes[22..].copy_from_slice(&sum);
            assert_eq!(heard(&mut second, &bytes), [], "{damaged}");
        }
        // A packet of another size is not the answer to this read.
        second.encode(&mut Vec::new(), BROADCAST, Request::FastSyncRead(580, 3, &[1, 2])).unwrap();
        assert_eq!(heard(&mut second, &ANSWER), []);
    }

    #[test]
    fn current_velocity_and_position_are_next_to_each_other() {
        assert_eq!(LAYOUT.present(), (126, 10));
    }
}
