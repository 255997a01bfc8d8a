//! The description of a video: what plays, how large, when, and where each sample lies.

use super::samples::{GROUP, Samples, Shape};
use super::tree::{Contents, parent};
use crate::h264::ParameterSets;

/// One in 16.16 fixed point.
const ONE: u32 = 1 << 16;

/// Rows of the matrix that leaves a picture as it is; its last column has 2.30 fixed point.
const IDENTITY: [u32; 9] = [ONE, 0, 0, 0, ONE, 0, 0, 0, 1 << 30];

/// Number of the only track.
const TRACK: u32 = 1;

/// "und" (not determined) as three letters of 5 bits.
const NO_LANGUAGE: u16 = 0x55C4;

/// Which rules the file keeps.
pub(super) fn file_type() -> Vec<u8> {
    Contents::new().bytes(b"isom").u32(0x200).bytes(b"isomiso2avc1mp41").named(b"ftyp")
}

/// Everything but the samples.
pub(super) fn movie(shape: &Shape, samples: &Samples, sets: &ParameterSets) -> Vec<u8> {
    let media =
        parent(b"mdia", &[media_header(shape, samples), handler(), media_information(shape, samples, sets)]);
    let track = parent(b"trak", &[track_header(shape, samples), media]);
    parent(b"moov", &[movie_header(shape, samples), track])
}

/// Units of time that the video lasts.
fn duration(shape: &Shape, samples: &Samples) -> u64 {
    samples.sizes.len() as u64 * u64::from(shape.units_per_sample)
}

fn movie_header(shape: &Shape, samples: &Samples) -> Vec<u8> {
    let times =
        Contents::versioned(1, 0).u64(0).u64(0).u32(shape.units_per_second).u64(duration(shape, samples));
    // Speed 1, volume 1, and the number of the track that would come next.
    let played = times.u32(ONE).u16(0x100).bytes(&[0; 10]);
    matrix(played).bytes(&[0; 24]).u32(TRACK + 1).named(b"mvhd")
}

fn track_header(shape: &Shape, samples: &Samples) -> Vec<u8> {
    // Enabled, part of the video and of its preview.
    let times = Contents::versioned(1, 7).u64(0).u64(0).u32(TRACK).u32(0).u64(duration(shape, samples));
    let layered = times.bytes(&[0; 8]).u16(0).u16(0).u16(0).u16(0);
    matrix(layered).u32(shape.width << 16).u32(shape.height << 16).named(b"tkhd")
}

fn matrix(contents: Contents) -> Contents {
    IDENTITY.into_iter().fold(contents, Contents::u32)
}

fn media_header(shape: &Shape, samples: &Samples) -> Vec<u8> {
    let times = Contents::versioned(1, 0).u64(0).u64(0).u32(shape.units_per_second);
    times.u64(duration(shape, samples)).u16(NO_LANGUAGE).u16(0).named(b"mdhd")
}

fn handler() -> Vec<u8> {
    Contents::versioned(0, 0).u32(0).bytes(b"vide").bytes(&[0; 12]).bytes(b"Video\0").named(b"hdlr")
}

fn media_information(shape: &Shape, samples: &Samples, sets: &ParameterSets) -> Vec<u8> {
    let video = Contents::versioned(0, 1).bytes(&[0; 8]).named(b"vmhd");
    // Flag 1: the samples are in this file.
    let here = Contents::versioned(0, 1).named(b"url ");
    let references = Contents::versioned(0, 0).u32(1).bytes(&here).named(b"dref");
    let data = parent(b"dinf", &[references]);
    parent(b"minf", &[video, data, sample_table(shape, samples, sets)])
}

fn sample_table(shape: &Shape, samples: &Samples, sets: &ParameterSets) -> Vec<u8> {
    let count = samples.sizes.len() as u32;
    let kinds = Contents::versioned(0, 0).u32(1).bytes(&sample_entry(shape, sets)).named(b"stsd");
    let times = Contents::versioned(0, 0).u32(1).u32(count).u32(shape.units_per_sample).named(b"stts");
    let keys = Contents::versioned(0, 0).table(&samples.keys).named(b"stss");
    let sizes = Contents::versioned(0, 0).u32(0).table(&samples.sizes).named(b"stsz");
    let groups = samples.groups();
    let positions =
        groups.iter().fold(Contents::versioned(0, 0).u32(groups.len() as u32), |contents, &position| {
            contents.u64(position)
        });
    parent(b"stbl", &[kinds, times, keys, group_lengths(count), sizes, positions.named(b"co64")])
}

/// Samples in each group: runs of equal groups, each as number of its first group, samples a group, kind of sample.
fn group_lengths(count: u32) -> Vec<u8> {
    let (full, rest) = (count / GROUP as u32, count % GROUP as u32);
    let mut runs = Vec::new();
    if full > 0 {
        runs.push([1, GROUP as u32, 1]);
    }
    if rest > 0 {
        runs.push([full + 1, rest, 1]);
    }
    let start = Contents::versioned(0, 0).u32(runs.len() as u32);
    runs.into_iter().flatten().fold(start, Contents::u32).named(b"stsc")
}

fn sample_entry(shape: &Shape, sets: &ParameterSets) -> Vec<u8> {
    let entry = Contents::new().bytes(&[0; 6]).u16(1).bytes(&[0; 16]);
    let sized = entry.u16(shape.width as u16).u16(shape.height as u16);
    // 72 dots an inch, one frame a sample, no name of a compressor, 24 bits, no colour table.
    let described = sized.u32(72 << 16).u32(72 << 16).u32(0).u16(1).bytes(&[0; 32]).u16(24).u16(0xFFFF);
    described.bytes(&decoder_configuration(sets)).bytes(&colours()).named(b"avc1")
}

/// Profile, level, lengths of 4 bytes, the parameter sets, and what the High profile adds.
fn decoder_configuration(sets: &ParameterSets) -> Vec<u8> {
    let start = Contents::new().u8(1).bytes(&sets.sequence[1..4]).u8(0xFC | 3);
    let sequence = start.u8(0xE0 | 1).u16(sets.sequence.len() as u16).bytes(&sets.sequence);
    let picture = sequence.u8(1).u16(sets.picture.len() as u16).bytes(&sets.picture);
    // 4:2:0, 8 bits of luma and of chroma, no extensions of the sequence parameter set.
    picture.u8(0xFC | 1).u8(0xF8).u8(0xF8).u8(0).named(b"avcC")
}

/// Primaries of sRGB (1), its transfer curve (13), the matrix of BT.601 (6), limited range.
fn colours() -> Vec<u8> {
    Contents::new().bytes(b"nclx").u16(1).u16(13).u16(6).u8(0).named(b"colr")
}
