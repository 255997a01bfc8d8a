//! Instructions of protocol 2.0, and the answer to its fast sync read.

use crate::chain::{Answer, Asked, Bus, Member};
use crate::plant::Plant;
use protocol::crc;
use protocol::dynamixel::{BROADCAST, instruction};

/// What an instruction asks for.
pub(super) fn asked(code: u8, parameters: &[u8]) -> Asked {
    let word = |low: &u8, high: &u8| u16::from_le_bytes([*low, *high]);
    match (code, parameters) {
        (instruction::PING, _) => Asked::Ping,
        (instruction::READ, [a, b, n, m]) => Asked::Read(word(a, b), word(n, m)),
        (instruction::WRITE, [a, b, data @ ..]) => Asked::Write(word(a, b), data.to_vec()),
        (instruction::REG_WRITE, [a, b, data @ ..]) => Asked::Register(word(a, b), data.to_vec()),
        (instruction::ACTION, []) => Asked::Action,
        (instruction::REBOOT, []) => Asked::Reboot,
        (instruction::FACTORY_RESET, [how]) => Asked::FactoryReset(*how),
        (instruction::CLEAR, _) => Asked::Nothing,
        (instruction::SYNC_READ, [a, b, n, m, ids @ ..]) => {
            Asked::ReadEach(ids.iter().map(|id| (*id, word(a, b), word(n, m))).collect())
        }
        (instruction::FAST_SYNC_READ, [a, b, n, m, ids @ ..]) => {
            Asked::ReadTogether(word(a, b), word(n, m), ids.to_vec())
        }
        (instruction::BULK_READ, entries) => {
            let read = |e: &[u8]| (e[0], word(&e[1], &e[2]), word(&e[3], &e[4]));
            Asked::ReadEach(entries.chunks_exact(5).map(read).collect())
        }
        (instruction::SYNC_WRITE, [a, b, n, m, data @ ..]) => {
            let write = |entry: &[u8]| (entry[0], word(a, b), entry[1..].to_vec());
            Asked::WriteEach(data.chunks_exact(usize::from(word(n, m)) + 1).map(write).collect())
        }
        (instruction::BULK_WRITE, mut rest) => {
            let mut writes = Vec::new();
            while let [id, a, b, n, m, data @ ..] = rest {
                let Some((data, left)) = data.split_at_checked(usize::from(word(n, m))) else { break };
                writes.push((*id, word(a, b), data.to_vec()));
                rest = left;
            }
            Asked::WriteEach(writes)
        }
        _ => Asked::Unknown,
    }
}

/// One packet from all servos in `ids`: of each an error, its id, its data and the checksum of all before it.
pub(super) fn together<S: Member>(
    bus: &mut Bus<S>,
    plant: &Plant,
    from: u16,
    length: u16,
    ids: &[u8],
) -> Vec<Answer> {
    let mut packet = vec![0xFF, 0xFF, 0xFD, 0x00, BROADCAST];
    let size = 1 + ids.len() * (usize::from(length) + 4);
    packet.extend((size as u16).to_le_bytes());
    packet.push(instruction::STATUS);
    let mut delay = 0.0;
    for (place, id) in ids.iter().enumerate() {
        let mut listening = bus.listening(*id);
        // After a missing servo, the others do not answer either: each waits for the one before.
        let Some(servo) = listening.first_mut() else { break };
        let mut data = Vec::new();
        let error = servo.read(plant, from, length, &mut data).err().unwrap_or(0);
        data.resize(usize::from(length), 0);
        packet.extend([error | servo.alarm(), *id]);
        packet.extend(data);
        delay = if place == 0 { servo.return_delay() } else { delay };
        let sum = crc::buypass(0, &packet);
        packet.extend(sum.to_le_bytes());
    }
    vec![Answer { delay, bytes: packet }]
}
