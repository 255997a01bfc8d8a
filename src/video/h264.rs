//! H.264 (ITU-T H.264) frames into MP4 samples.
//!
//! The encoder is rusty_h264, built without `std`: so its many experiments, which variables of the environment would switch,
//! stay off.

use rusty_h264_common::{Profile, YuvPlanes};
use rusty_h264_encoder::{EncodeError, Encoder, EncoderConfig};

use crate::frame::Frame;
use crate::yuv::Planes;

/// Quantiser of all frames: the luma of smooth and textured scenes is then 45 to 50 dB from the picture drawn.
const QUANTISER: u8 = 22;

/// Seconds between key frames, from which a player can start.
const KEY_FRAME_SECONDS: f64 = 2.0;

/// Most frames between key frames.
const KEY_FRAME_LIMIT: f64 = 250.0;

/// Type numbers of NAL units (H.264, table 7-1).
const KEY_SLICE: u8 = 5;
const SEQUENCE: u8 = 7;
const PICTURE: u8 = 8;

/// Levels in tenths, with the most 16 x 16 blocks of a picture and a second (H.264, table A-1).
const LEVELS: [(u8, u32, u32); 8] = [
    (30, 1_620, 40_500),
    (31, 3_600, 108_000),
    (32, 5_120, 216_000),
    (40, 8_192, 245_760),
    (42, 8_704, 522_240),
    (50, 22_080, 589_824),
    (51, 36_864, 983_040),
    (52, 36_864, 2_073_600),
];

/// What [`fits`] allows.
pub(crate) const LIMIT: &str = "at most 36864 blocks of 16 x 16 pixels and 8688 pixels a side";

/// Whether H.264 has a level for pictures of this size.
pub(crate) fn fits(width: u32, height: u32) -> bool {
    level(width, height, 0.0).is_some()
}

/// The lowest level for pictures of a size, none if there is no such level. Rates beyond the highest level have that one:
/// they cost time, and no decoder's memory.
fn level(width: u32, height: u32, frames_per_second: f64) -> Option<u8> {
    let (columns, rows) = (width.div_ceil(16), height.div_ceil(16));
    // A side of n blocks needs a level for n * n / 8 of them (clause A.3.1).
    let longest = u64::from(columns.max(rows));
    let holds = |&&(_, picture, _): &&(u8, u32, u32)| {
        u64::from(columns) * u64::from(rows) <= u64::from(picture)
            && longest * longest <= 8 * u64::from(picture)
    };
    let rate = f64::from(columns) * f64::from(rows) * frames_per_second;
    let mut levels = LEVELS.iter().filter(holds);
    levels
        .clone()
        .find(|(.., second)| rate <= f64::from(*second))
        .or_else(|| levels.next_back())
        .map(|found| found.0)
}

/// One encoded frame.
#[derive(Debug)]
pub(crate) struct Sample {
    /// Slices, each after its length in 4 bytes (ISO/IEC 14496-15).
    pub(crate) bytes: Vec<u8>,
    /// Whether decoding can start here.
    pub(crate) key: bool,
}

/// What a decoder needs before the first sample: one sequence and one picture parameter set.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct ParameterSets {
    pub(crate) sequence: Vec<u8>,
    pub(crate) picture: Vec<u8>,
}

/// Encodes frames of one size, one sample for each at once.
#[derive(Debug)]
pub(crate) struct FrameEncoder {
    encoder: Encoder,
    planes: Planes,
    sets: ParameterSets,
}

impl FrameEncoder {
    /// High profile with CABAC, one reference, no frames held back.
    pub(crate) fn new(width: u32, height: u32, frames_per_second: f64) -> Result<Self, EncodeError> {
        let planes = Planes::new(width, height);
        let (even_width, even_height) = planes.size();
        // The constructor that reads no environment variable. It holds no frames back: lookahead, B frames, the
        // propagation tree and the detection of cuts are off.
        let mut config = EncoderConfig::baseline(even_width, even_height);
        config.profile = Profile::High;
        config.cabac = true;
        config.transform_8x8 = true;
        config.qp = QUANTISER;
        // Sizes that no level holds are refused before.
        config.level_idc = level(width, height, frames_per_second).unwrap_or(config.level_idc);
        config.framerate = frames_per_second as f32;
        config.gop_size = (KEY_FRAME_SECONDS * frames_per_second).clamp(1.0, KEY_FRAME_LIMIT).round() as u32;
        config.min_keyint = config.gop_size;
        Ok(FrameEncoder { encoder: Encoder::new(config)?, planes, sets: ParameterSets::default() })
    }

    /// Encodes a frame of the size given to [`new`](Self::new).
    pub(crate) fn encode(&mut self, frame: &Frame<'_>) -> Result<Sample, String> {
        self.planes.fill(frame);
        let (width, height) = self.planes.size();
        let view = YuvPlanes::tight(width, height, &self.planes.y, &self.planes.u, &self.planes.v)
            .ok_or("the planes do not have the size of the video")?;
        let stream = self.encoder.encode_planes(&view).map_err(|error| error.to_string())?;
        self.sample(&stream)
    }

    /// The parameter sets of the samples so far.
    pub(crate) fn parameter_sets(&self) -> &ParameterSets {
        &self.sets
    }

    /// Takes the parameter sets out of a byte stream and puts lengths before the other units.
    fn sample(&mut self, stream: &[u8]) -> Result<Sample, String> {
        let (mut bytes, mut key) = (Vec::with_capacity(stream.len()), false);
        for unit in units(stream) {
            match unit[0] & 31 {
                SEQUENCE => keep(&mut self.sets.sequence, unit)?,
                PICTURE => keep(&mut self.sets.picture, unit)?,
                kind => {
                    key |= kind == KEY_SLICE;
                    bytes.extend((unit.len() as u32).to_be_bytes());
                    bytes.extend(unit);
                }
            }
        }
        match bytes.is_empty() {
            true => Err("it gave no data for this frame".into()),
            false => Ok(Sample { bytes, key }),
        }
    }
}

/// Keeps the first parameter set of a kind; the header of the video has room for one.
fn keep(kept: &mut Vec<u8>, unit: &[u8]) -> Result<(), String> {
    if kept.is_empty() {
        *kept = unit.to_vec();
    }
    match kept == unit {
        true => Ok(()),
        false => Err("it changed the parameter sets within the video".into()),
    }
}

/// The units of a byte stream (H.264, annex B), without start codes and the zeros around them.
fn units(stream: &[u8]) -> impl Iterator<Item = &[u8]> {
    let starts: Vec<usize> =
        stream.windows(3).enumerate().filter(|(_, code)| code == &[0, 0, 1]).map(|(at, _)| at).collect();
    let ends: Vec<usize> = starts.iter().skip(1).copied().chain([stream.len()]).collect();
    starts.into_iter().zip(ends).filter_map(move |(start, end)| {
        let unit = &stream[start + 3..end];
        // Zeros before the next start code belong to it; a unit itself never ends with one.
        let length = unit.iter().rposition(|&byte| byte != 0)? + 1;
        Some(&unit[..length])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_stream_is_cut_at_start_codes_of_three_and_four_bytes() {
        let stream = [0, 0, 0, 1, 0x67, 1, 2, 0, 0, 1, 0x68, 3, 0, 0, 0, 1, 0x65, 0, 4];
        let found: Vec<_> = units(&stream).collect();
        assert_eq!(found, [&[0x67, 1, 2][..], &[0x68, 3], &[0x65, 0, 4]]);
        assert_eq!(units(&[]).count(), 0);
        assert_eq!(units(&[0, 0, 1, 0, 0]).count(), 0);
    }

    #[test]
    fn every_frame_gives_a_sample_and_key_frames_come_every_two_seconds() {
        let mut encoder = FrameEncoder::new(33, 17, 4.0).unwrap();
        let keys: Vec<bool> = (0..17)
            .map(|i| {
                let pixels: Vec<u8> = (0..33 * 17 * 3).map(|p| (p * 7 + i * 5) as u8).collect();
                encoder.encode(&Frame::new(33, 17, &pixels).unwrap()).unwrap().key
            })
            .collect();
        let expected: Vec<bool> = (0..17).map(|i| i % 8 == 0).collect();
        assert_eq!(keys, expected);
        let sets = encoder.parameter_sets();
        assert_eq!((sets.sequence[0] & 31, sets.picture[0] & 31), (SEQUENCE, PICTURE));
    }

    #[test]
    fn sizes_beyond_the_highest_level_are_refused() {
        assert!(fits(1, 1) && fits(4096, 2304) && fits(8688, 16));
        assert!(!fits(4096, 2305) && !fits(8689, 16) && !fits(16, 16384));
    }

    #[test]
    fn the_level_holds_size_and_rate() {
        assert_eq!(level(224, 224, 25.0), Some(30));
        assert_eq!(level(640, 480, 25.0), Some(30));
        assert_eq!(level(640, 480, 100.0), Some(32));
        assert_eq!(level(1920, 1080, 30.0), Some(40));
        assert_eq!(level(2720, 16, 25.0), Some(32));
        assert_eq!(level(1920, 1080, 1000.0), Some(52));
    }
}
