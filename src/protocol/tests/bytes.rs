//! Bytes that no device sends: decoders must neither panic, nor wait for ever, nor take them for what they are not.

use robohive_protocol::franka::{Decoder, Field, Move, Request as Greeting, Setpoint, State, Version, hand};
use robohive_protocol::modbus::{Request, function};
use robohive_protocol::robotiq::{Action, Status};
use robohive_protocol::{dynamixel, feetech, servo};

/// A generator of numbers, the same every time.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn bytes(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.next() as u8).collect()
    }
}

#[test]
fn noise_leaves_no_decoder_of_messages_in_a_loop() {
    let mut noise = Noise(1);
    for mut decoder in [Decoder::arm(), Decoder::hand()] {
        let (mut frames, mut errors) = (0, 0);
        for _ in 0..20_000 {
            let count = noise.next() as usize % 40;
            let mut bytes = noise.bytes(count);
            // Lengths that are possible are rare among random ones.
            if count >= 12 && noise.next().is_multiple_of(2) {
                bytes[6..12].copy_from_slice(&[16, 0, 16, 0, 0, 0]);
            }
            decoder.push(&bytes);
            while let Some(frame) = decoder.next_frame() {
                if frame.is_err() {
                    // The stream is lost; a client begins another.
                    errors += 1;
                    decoder = if errors % 2 == 0 { Decoder::arm() } else { Decoder::hand() };
                    break;
                }
                frames += 1;
            }
        }
        assert!(errors > 100, "{errors} errors, {frames} messages");
    }
}

#[test]
fn states_and_commands_of_random_bytes_come_back_as_they_were_read() {
    let mut noise = Noise(2);
    for _ in 0..500 {
        for version in [Version::V5, Version::V10] {
            let bytes = noise.bytes(State::size(version));
            let state = State::decode(&bytes, version).expect("a state of its length");
            let again = state.encode(version);
            assert_eq!(again.len(), bytes.len());
            // Flags of many values become 0 or 1, so that the second reading is the first.
            let twice = State::decode(&again, version).expect("a state of its length");
            let all: Field<284> = Field(0);
            let bits = |state: &State| state.get(all).map(f64::to_bits);
            assert_eq!((bits(&state), state.errors, state.mode), (bits(&twice), twice.errors, twice.mode));

            let bytes = noise.bytes(Setpoint::size(version));
            let setpoint = Setpoint::decode(&bytes, version).expect("a command of its length");
            let mut again = Vec::new();
            setpoint.encode(version, &mut again);
            assert_eq!(bytes[8..312], again[8..312]);
            let count = noise.next() as usize % 120;
            let payload = noise.bytes(count);
            if let Some(asked) = Move::decode(&payload, version) {
                assert_eq!(asked.encode(version).len(), payload.len());
            }
            assert_eq!(Greeting::decode(&payload).is_some(), count == 4);
        }
        assert!(hand::State::decode(&noise.bytes(hand::STATE)).is_some());
    }
}

#[test]
fn noise_is_no_request_and_no_reply_of_modbus() {
    let mut noise = Noise(3);
    let read = Request::Read { function: function::READ_INPUT, from: 0x07D0, count: 3 };
    let mut taken = 0;
    for _ in 0..50_000 {
        let count = noise.next() as usize % 24;
        let mut bytes = noise.bytes(count);
        if count > 2 {
            (bytes[0], bytes[1]) = (9, [3, 4, 16, 0x84][noise.next() as usize % 4]);
        }
        taken += usize::from(matches!(Request::decode(&bytes), Some(Ok(_))));
        taken += usize::from(read.answer(9, &bytes).is_some());
        if let Ok(registers) = <[u8; 6]>::try_from(&bytes[..]) {
            let action = Action::decode(registers);
            assert_eq!(Action::decode(action.encode()), action);
            let status = Status::decode(registers);
            assert_eq!(Status::decode(status.encode()), status);
        }
    }
    // A checksum of 16 bits lets one in 65 536 through.
    assert!(taken < 10, "{taken}");
}

#[test]
fn noise_is_no_answer_of_a_servo() {
    let mut noise = Noise(4);
    for family in [&dynamixel::FAMILY, &dynamixel::v1::FAMILY, &feetech::FAMILY] {
        let mut packets = (family.packets)();
        let mut taken = 0;
        for round in 0..20_000 {
            let (mut sent, size) = (Vec::new(), (noise.next() % 12) as u16);
            let ids = &[1, 2, 3];
            let request = if family.kinds.iter().any(|kind| kind.fast_sync_read.is_some()) {
                servo::Request::FastSyncRead(100, size, ids)
            } else {
                servo::Request::SyncRead(100, size, ids)
            };
            packets.encode(&mut sent, 1, request).unwrap();
            let count = noise.next() as usize % 80;
            let mut bytes = noise.bytes(count);
            // Headers, lengths and ids that are possible are rare among random ones.
            let possible: &[u8] = if round % 2 == 0 {
                &[0xFF, 0xFF, 0xFD, 0, 0xFE, 33, 0, 0x55]
            } else {
                &[0xFF, 0xFF, 1, 9, 0]
            };
            let length = possible.len().min(bytes.len());
            bytes[..length].copy_from_slice(&possible[..length]);
            packets.answers(&sent, &bytes, &mut |answer| {
                taken += usize::from(answer.data.len() == usize::from(size));
                false
            });
            let verdict = packets.verdict(noise.next() as u8);
            assert!(verdict.refusal.is_none_or(|why| !why.is_empty()));
            if round % 7 == 0 {
                packets.clear();
            }
        }
        // A checksum of eight bits lets one in 256 through, and few of these have the right length.
        assert!(taken < 100, "{taken}");
    }
}
