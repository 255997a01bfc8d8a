//! MP4 files: their boxes say where the samples lie, and the samples decode to the frames that were pushed.

mod folder;
mod likeness;
mod scene;

use folder::Folder;
use likeness::{luma, psnr};
use robohive_video::{Frame, VideoWriter};
use rusty_h264_decoder::Decoder;
use scene::scene;

/// Boxes that hold boxes, with the bytes before these.
const PARENTS: [(&[u8; 4], usize); 7] =
    [(b"moov", 0), (b"trak", 0), (b"mdia", 0), (b"minf", 0), (b"stbl", 0), (b"stsd", 8), (b"avc1", 78)];

/// Name, start of the contents, and contents of all boxes, parents before children.
fn boxes(bytes: &[u8], start: usize, found: &mut Vec<([u8; 4], usize, Vec<u8>)>) {
    let mut at = 0;
    while at < bytes.len() {
        let short = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let name: [u8; 4] = bytes[at + 4..at + 8].try_into().unwrap();
        let (header, length) = match short {
            1 => (16, u64::from_be_bytes(bytes[at + 8..at + 16].try_into().unwrap()) as usize),
            _ => (8, short),
        };
        assert!(length >= header && at + length <= bytes.len(), "{name:?} has {length} bytes at {at}");
        let contents = &bytes[at + header..at + length];
        found.push((name, start + at + header, contents.to_vec()));
        if let Some((_, before)) = PARENTS.iter().find(|(parent, _)| **parent == name) {
            boxes(&contents[*before..], start + at + header + before, found);
        }
        at += length;
    }
}

/// A parsed file.
struct Parsed {
    file: Vec<u8>,
    boxes: Vec<([u8; 4], usize, Vec<u8>)>,
}

impl Parsed {
    fn read(path: &std::path::Path) -> Self {
        let file = std::fs::read(path).unwrap();
        let mut found = Vec::new();
        boxes(&file, 0, &mut found);
        Parsed { file, boxes: found }
    }

    /// Contents of the only box of a name.
    fn contents(&self, name: &[u8; 4]) -> &[u8] {
        let mut named = self.boxes.iter().filter(|(found, ..)| found == name);
        let (_, _, contents) = named.next().unwrap_or_else(|| panic!("no box {name:?}"));
        assert!(named.next().is_none());
        contents
    }

    /// Numbers of 32 bits in a box from some byte on.
    fn numbers(&self, name: &[u8; 4], from: usize) -> Vec<u32> {
        let numbers = self.contents(name)[from..].as_chunks::<4>().0;
        numbers.iter().map(|&number| u32::from_be_bytes(number)).collect()
    }

    /// The samples, found as a player finds them: through groups, their positions, and sizes.
    fn samples(&self) -> Vec<&[u8]> {
        let sizes = &self.numbers(b"stsz", 8)[1..];
        let positions: Vec<u64> =
            self.contents(b"co64")[8..].as_chunks::<8>().0.iter().map(|&p| u64::from_be_bytes(p)).collect();
        let runs = self.numbers(b"stsc", 8);
        let runs = runs.as_chunks::<3>().0;
        let mut samples = Vec::new();
        for (group, &position) in positions.iter().enumerate() {
            let run = runs.iter().rev().find(|run| run[0] as usize <= group + 1).unwrap();
            let mut at = position as usize;
            for _ in 0..run[1] {
                let size = sizes[samples.len()] as usize;
                samples.push(&self.file[at..at + size]);
                at += size;
            }
        }
        assert_eq!(samples.len(), sizes.len());
        samples
    }

    /// The samples and their parameter sets as a byte stream with start codes.
    fn stream(&self) -> Vec<u8> {
        let avc = self.contents(b"avcC");
        let length = |at: usize| usize::from(u16::from_be_bytes([avc[at], avc[at + 1]]));
        let sequence = &avc[8..8 + length(6)];
        let picture_at = 8 + sequence.len() + 3;
        let picture = &avc[picture_at..picture_at + length(picture_at - 2)];
        let start = [0, 0, 0, 1];
        let mut stream = [&start, sequence, &start, picture].concat();
        for sample in self.samples() {
            let mut rest = sample;
            while let Some((length, after)) = rest.split_first_chunk::<4>() {
                let (unit, after) = after.split_at(u32::from_be_bytes(*length) as usize);
                stream.extend(start.iter().chain(unit));
                rest = after;
            }
        }
        stream
    }
}

fn write(path: &std::path::Path, (width, height): (u32, u32), frames: u32, rate: f64) {
    let mut video = VideoWriter::create(path, (width, height), rate).unwrap();
    for time in 0..frames {
        video.push(&Frame::new(width, height, &scene(width, height, time)).unwrap()).unwrap();
    }
    assert_eq!(video.frames(), u64::from(frames));
    video.finish().unwrap();
}

#[test]
fn tables_describe_the_samples() {
    let folder = Folder::new("tables");
    for frames in [1, 31, 32, 33, 100] {
        let path = folder.join(&format!("{frames}.mp4"));
        write(&path, (96, 64), frames, 12.5);
        let parsed = Parsed::read(&path);
        let top: Vec<_> = parsed.file[4..8].to_vec();
        assert_eq!(top, b"ftyp");
        // One duration for all: a thousandth of a frame is the unit.
        assert_eq!(parsed.numbers(b"stts", 4), [1, frames, 1000]);
        let header = parsed.contents(b"mdhd");
        assert_eq!(header[20..24], 12_500_u32.to_be_bytes());
        assert_eq!(header[24..32], (u64::from(frames) * 1000).to_be_bytes());
        assert_eq!(parsed.contents(b"tkhd")[88..], [0, 96, 0, 0, 0, 64, 0, 0]);
        // Key frames every two seconds.
        let keys: Vec<u32> = (1..=frames).step_by(25).collect();
        assert_eq!(parsed.numbers(b"stss", 8), keys);
        // The samples fill the box of the media without gaps, and begin at its start.
        let media = parsed.contents(b"mdat");
        assert_eq!(parsed.samples().concat(), media);
        for (number, sample) in (1..).zip(parsed.samples()) {
            let key = sample[4] & 31 == 5;
            assert_eq!(key, keys.contains(&number), "sample {number}");
        }
    }
}

/// Visible luma of each frame that the file decodes to.
fn decoded(path: &std::path::Path, (width, height): (u32, u32)) -> Vec<Vec<u8>> {
    let frames = Decoder::new().decode_stream(&Parsed::read(path).stream()).unwrap();
    let even = (width.next_multiple_of(2) as usize, height.next_multiple_of(2) as usize);
    let visible = |frame: rusty_h264_common::YuvFrame| {
        assert_eq!((frame.width, frame.height), even);
        let rows = frame.y.chunks(frame.width).take(height as usize);
        rows.flat_map(|row| &row[..width as usize]).copied().collect()
    };
    frames.into_iter().map(visible).collect()
}

#[test]
fn samples_decode_to_the_frames() {
    let folder = Folder::new("decode");
    for (width, height) in [(160, 120), (97, 63), (33, 50)] {
        let path = folder.join("scene.mp4");
        write(&path, (width, height), 60, 25.0);
        let frames = decoded(&path, (width, height));
        assert_eq!(frames.len(), 60, "{width} x {height}");
        for (frame, time) in frames.iter().zip(0..) {
            let difference = psnr(&luma(&scene(width, height, time)), frame);
            assert!(difference >= 40.0, "{width} x {height}, frame {time}: {difference:.1} dB");
        }
    }
}

#[test]
fn pictures_smaller_than_a_block_are_padded() {
    let folder = Folder::new("small");
    for size in [(1, 1), (2, 1), (1, 40), (5, 3)] {
        let path = folder.join("scene.mp4");
        write(&path, size, 10, 25.0);
        let frames = decoded(&path, size);
        assert_eq!(frames.len(), 10);
        for (frame, time) in frames.iter().zip(0..) {
            let expected = luma(&scene(size.0, size.1, time));
            let worst = frame.iter().zip(expected).map(|(a, b)| a.abs_diff(b)).max().unwrap();
            assert!(worst <= 16, "{size:?}, frame {time}: {worst}");
        }
    }
}
