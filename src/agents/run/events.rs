//! Files of events, as TensorBoard reads them: scalars over a step.
//!
//! A file is a sequence of records in the framing of TFRecord, and the content of each is an `Event` as a protocol buffer. Numbers are
//! little-endian:
//!
//! | bytes | content of a record |
//! |---|---|
//! | 8 | length n of the event |
//! | 4 | masked CRC-32C of these 8 bytes |
//! | n | the event |
//! | 4 | masked CRC-32C of the event |
//!
//! | field | name | type | in |
//! |---|---|---|---|
//! | 1 | `wall_time` \[s\] | double | `Event` |
//! | 2 | `step` | int64 | `Event` |
//! | 3 | `file_version` | string | `Event`, the first one only |
//! | 5 | `summary` | `Summary` | `Event` |
//! | 1 | `value`, repeated | `Value` | `Summary` |
//! | 1 | `tag` | string | `Value` |
//! | 2 | `simple_value` | float | `Value` |

use crc::{CRC_32_ISCSI, Crc};

/// What the first event says of the file.
const VERSION: &str = "brain.Event:2";

/// CRC-32C; the catalogue of CRCs names it after iSCSI.
static CRC_32C: Crc<u32> = Crc::<u32>::new(&CRC_32_ISCSI);

/// How the content of a field is written.
#[derive(Clone, Copy)]
enum Wire {
    Varint = 0,
    Fixed64 = 1,
    Bytes = 2,
    Fixed32 = 5,
}

/// The record that begins a file.
pub(super) fn version() -> Vec<u8> {
    let mut event = Vec::new();
    bytes(&mut event, 3, VERSION.as_bytes());
    record(&event)
}

/// The record of scalars with their tags, at a step and a wall time \[s\].
pub(super) fn scalars<'a>(
    wall_time: f64,
    step: i64,
    values: impl IntoIterator<Item = (&'a str, f32)>,
) -> Vec<u8> {
    let mut summary = Vec::new();
    for (tag, number) in values {
        let mut value = Vec::new();
        bytes(&mut value, 1, tag.as_bytes());
        key(&mut value, 2, Wire::Fixed32);
        value.extend(number.to_le_bytes());
        bytes(&mut summary, 1, &value);
    }
    let mut event = Vec::new();
    key(&mut event, 1, Wire::Fixed64);
    event.extend(wall_time.to_le_bytes());
    key(&mut event, 2, Wire::Varint);
    varint(&mut event, step.cast_unsigned());
    bytes(&mut event, 5, &summary);
    record(&event)
}

/// An event in its frame.
fn record(event: &[u8]) -> Vec<u8> {
    let length = (event.len() as u64).to_le_bytes();
    let checks = [masked(&length), masked(event)].map(u32::to_le_bytes);
    [&length[..], &checks[0], event, &checks[1]].concat()
}

/// The CRC-32C as TFRecord stores it: rotated and offset, since the CRC of bytes that hold their own CRC says little.
fn masked(content: &[u8]) -> u32 {
    CRC_32C.checksum(content).rotate_right(15).wrapping_add(0xa282_ead8)
}

/// What precedes the content of a field.
fn key(out: &mut Vec<u8>, field: u64, wire: Wire) {
    varint(out, field << 3 | wire as u64);
}

/// A field whose content has a length: a string or a message.
fn bytes(out: &mut Vec<u8>, field: u64, content: &[u8]) {
    key(out, field, Wire::Bytes);
    varint(out, content.len() as u64);
    out.extend(content);
}

/// A number in groups of seven bits, the lowest first; all but the last have the eighth bit set.
fn varint(out: &mut Vec<u8>, mut number: u64) {
    while number >= 0x80 {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hex(content: &[u8]) -> String {
        content.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// The check value of the catalogue of CRCs, and the CRCs of RFC 3720, B.4.
    #[test]
    fn crcs_are_those_of_the_standard() {
        let ascending: Vec<u8> = (0..32).collect();
        for (content, crc) in [
            (&b"123456789"[..], 0xe306_9283),
            (&[0; 32], 0x8a91_36aa),
            (&[0xff; 32], 0x62a8_ab43),
            (&ascending, 0x46dd_794e),
        ] {
            assert_eq!(CRC_32C.checksum(content), crc);
        }
        // By TensorBoard 2.21's `masked_crc32c`.
        assert_eq!(masked(b"123456789"), 0xc78a_b0e5);
    }

    /// The bytes are those that TensorBoard 2.21's own protocol buffers and framing make of the same events.
    #[test]
    fn records_are_those_of_tensorboard() {
        assert_eq!(hex(&version()), "0f000000000000006d532b091a0d627261696e2e4576656e743a32fc985129");
        let values = [("rollout/faults", -2.0), ("train/clipped", 0.1)];
        let expected = "3b000000000000001a23ac5c09000000000000f83f10ac022a2d0a150a0e726f6c6c6f75742f6661756c7473\
            15000000c00a140a0d747261696e2f636c697070656415cdcccc3dfc32f71f";
        assert_eq!(hex(&scalars(1.5, 300, values)), expected);
    }

    #[test]
    fn varints_have_seven_bits_a_byte() {
        for (number, expected) in [
            (0, "00"),
            (127, "7f"),
            (128, "8001"),
            (300, "ac02"),
            (1 << 35, "808080808001"),
            (u64::MAX, "ffffffffffffffffff01"),
        ] {
            let mut out = Vec::new();
            varint(&mut out, number);
            assert_eq!(hex(&out), expected, "{number}");
        }
    }
}
