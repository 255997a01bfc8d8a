//! NatNet messages: a header of two numbers of 16 bits (what, bytes that follow), then the content.

use super::Body;

/// Where frames are sent to, unless a client asks for unicast.
pub const MULTICAST: [u8; 4] = [239, 255, 42, 99];
/// Port of commands.
pub const COMMAND_PORT: u16 = 1510;
/// Port of frames.
pub const DATA_PORT: u16 = 1511;
/// Longest message.
pub const MAX: usize = 65_507;

/// What a message is, as the first number of its header.
pub mod message {
    #![allow(missing_docs)]
    pub const CONNECT: u16 = 0;
    pub const SERVER_INFO: u16 = 1;
    pub const REQUEST: u16 = 2;
    pub const RESPONSE: u16 = 3;
    pub const REQUEST_MODEL: u16 = 4;
    pub const MODEL: u16 = 5;
    pub const REQUEST_FRAME: u16 = 6;
    pub const FRAME: u16 = 7;
    pub const TEXT: u16 = 8;
    pub const DISCONNECT: u16 = 9;
    pub const KEEP_ALIVE: u16 = 10;
    pub const UNRECOGNISED: u16 = 100;
}

/// Bitstreams that are known: they differ in what a frame contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bitstream {
    /// NatNet 3.0.
    V3,
    /// NatNet 4.1: sections say their size, and there are assets.
    V41,
}

impl Bitstream {
    /// As a version of four numbers.
    pub fn version(self) -> [u8; 4] {
        match self {
            Bitstream::V3 => [3, 0, 0, 0],
            Bitstream::V41 => [4, 1, 0, 0],
        }
    }

    /// The bitstream of a version; `None` for those that are not known.
    pub fn of(version: [u8; 4]) -> Option<Bitstream> {
        match version {
            [3, 0, ..] => Some(Bitstream::V3),
            [4, 1, ..] => Some(Bitstream::V41),
            _ => None,
        }
    }
}

/// A frame, as far as rigid bodies go.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Its number.
    pub number: i32,
    /// Seconds on the tracker's clock.
    pub timestamp: f64,
    /// Rigid bodies; a body that is not seen is listed with `tracked` unset, or left out.
    pub bodies: Vec<Body>,
}

/// What a server says of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ServerInfo {
    /// The bitstream that it sends.
    pub version: [u8; 4],
    /// Ticks a second of its clock.
    pub clock: u64,
    /// Where frames are sent.
    pub data_port: u16,
    /// The group that they are sent to; `None` when they are sent to the client alone.
    pub group: Option<[u8; 4]>,
}

/// Bytes of a name.
const NAME: usize = 256;

/// A message: its header and its content.
pub fn message(what: u16, content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(4 + content.len());
    bytes.extend(what.to_le_bytes());
    bytes.extend((content.len() as u16).to_le_bytes());
    bytes.extend(content);
    bytes
}

/// What a message is, and its content; `None` if it is shorter than it says.
pub fn open(bytes: &[u8]) -> Option<(u16, &[u8])> {
    let mut reader = Reader(bytes);
    let (what, length) = (reader.u16()?, reader.u16()?);
    Some((what, reader.0.get(..usize::from(length))?))
}

/// The content of a connect message that asks for a bitstream.
pub fn connect(wanted: Bitstream) -> Vec<u8> {
    let mut content = vec![0; 270];
    content[..8].copy_from_slice(b"robohive");
    content[260..264].copy_from_slice(&Bitstream::V41.version());
    content[265..269].copy_from_slice(&wanted.version());
    content
}

/// The bitstream that a connect message asks for; `None` when it leaves the choice to the server.
pub fn wanted(content: &[u8]) -> Option<Bitstream> {
    let version: [u8; 4] = content.get(265..269)?.try_into().ok()?;
    Bitstream::of(version)
}

impl ServerInfo {
    /// As the content of a message.
    pub fn encode(&self) -> Vec<u8> {
        let mut content = vec![0; NAME];
        content[..6].copy_from_slice(b"Motive");
        content.extend([3, 1, 0, 0]);
        content.extend(self.version);
        content.extend(self.clock.to_le_bytes());
        content.extend(self.data_port.to_le_bytes());
        content.push(u8::from(self.group.is_some()));
        content.extend(self.group.unwrap_or_default());
        content
    }

    /// From the content of a message.
    pub fn decode(content: &[u8]) -> Option<ServerInfo> {
        let mut reader = Reader(content.get(NAME + 4..)?);
        let version = reader.bytes()?;
        let clock = u64::from_le_bytes(reader.bytes()?);
        let data_port = reader.u16()?;
        let [multicast] = reader.bytes()?;
        let group = reader.bytes()?;
        Some(ServerInfo { version, clock, data_port, group: (multicast != 0).then_some(group) })
    }
}

impl Frame {
    /// As the content of a message: its rigid bodies, and all other sections empty.
    pub fn encode(&self, bitstream: Bitstream) -> Vec<u8> {
        let sized = bitstream >= Bitstream::V41;
        let mut out = Vec::new();
        out.extend(self.number.to_le_bytes());
        let section = |out: &mut Vec<u8>, count: usize, content: &[u8]| {
            out.extend((count as i32).to_le_bytes());
            if sized {
                out.extend((content.len() as i32).to_le_bytes());
            }
            out.extend(content);
        };
        let mut bodies = Vec::new();
        for body in &self.bodies {
            let [w, x, y, z] = body.orientation;
            bodies.extend(body.id.to_le_bytes());
            for value in body.position.into_iter().chain([x, y, z, w, body.error]) {
                bodies.extend((value as f32).to_le_bytes());
            }
            bodies.extend(u16::from(body.tracked).to_le_bytes());
        }
        // Marker sets, other markers, rigid bodies, skeletons; in 4.1 assets; labelled markers, force plates, devices.
        let empty_after = if sized { 5 } else { 4 };
        section(&mut out, 0, &[]);
        section(&mut out, 0, &[]);
        section(&mut out, self.bodies.len(), &bodies);
        (0..empty_after).for_each(|_| section(&mut out, 0, &[]));
        let ticks = (self.timestamp * 1e7) as u64;
        out.extend([0; 8]);
        out.extend(self.timestamp.to_le_bytes());
        (0..3).for_each(|_| out.extend(ticks.to_le_bytes()));
        if sized {
            out.extend([0; 8]);
        }
        out.extend([0; 2]);
        out.extend([0; 4]);
        out
    }

    /// From the content of a message; `None` if it ends too early or counts what cannot be there.
    pub fn decode(content: &[u8], bitstream: Bitstream) -> Option<Frame> {
        let sized = bitstream >= Bitstream::V41;
        let mut reader = Reader(content);
        let number = reader.i32()?;
        skip_marker_sets(&mut reader, sized)?;
        skip_section(&mut reader, sized, 12)?;
        let count = reader.count(38, sized)?;
        let bodies = (0..count).map(|_| body(&mut reader)).collect::<Option<_>>()?;
        skip_skeletons(&mut reader, sized)?;
        if sized {
            // Assets say their size, so that what is in them need not be known.
            let (_, size) = (reader.i32()?, reader.i32()?);
            reader.skip(usize::try_from(size).ok()?)?;
        }
        skip_section(&mut reader, sized, 26)?;
        skip_channels(&mut reader, sized)?;
        skip_channels(&mut reader, sized)?;
        reader.skip(8)?;
        let timestamp = f64::from_le_bytes(reader.bytes()?);
        Some(Frame { number, timestamp, bodies })
    }
}

fn body(reader: &mut Reader<'_>) -> Option<Body> {
    let id = reader.i32()?;
    let position = [reader.f32()?, reader.f32()?, reader.f32()?];
    let [x, y, z, w] = [reader.f32()?, reader.f32()?, reader.f32()?, reader.f32()?];
    let error = reader.f32()?;
    let tracked = reader.u16()? & 1 != 0;
    Some(Body { id, position, orientation: [w, x, y, z], error, tracked })
}

/// Passes over a section whose elements have one size.
fn skip_section(reader: &mut Reader<'_>, sized: bool, size: usize) -> Option<()> {
    let count = reader.count(size, sized)?;
    reader.skip(count * size)
}

/// Passes over named sets of markers.
fn skip_marker_sets(reader: &mut Reader<'_>, sized: bool) -> Option<()> {
    let count = reader.count(5, sized)?;
    for _ in 0..count {
        let end = reader.0.iter().position(|byte| *byte == 0)?;
        reader.skip(end + 1)?;
        let markers = usize::try_from(reader.i32()?).ok()?;
        reader.skip(markers.checked_mul(12)?)?;
    }
    Some(())
}

/// Passes over skeletons: each an id and its bodies.
fn skip_skeletons(reader: &mut Reader<'_>, sized: bool) -> Option<()> {
    let count = reader.count(8, sized)?;
    for _ in 0..count {
        reader.skip(4)?;
        let bodies = usize::try_from(reader.i32()?).ok()?;
        reader.skip(bodies.checked_mul(38)?)?;
    }
    Some(())
}

/// Passes over force plates or devices: each an id and channels of samples.
fn skip_channels(reader: &mut Reader<'_>, sized: bool) -> Option<()> {
    let count = reader.count(8, sized)?;
    for _ in 0..count {
        reader.skip(4)?;
        for _ in 0..reader.i32()? {
            let samples = usize::try_from(reader.i32()?).ok()?;
            reader.skip(samples.checked_mul(4)?)?;
        }
    }
    Some(())
}

/// Bytes that are read from the front.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*first)
    }

    fn skip(&mut self, count: usize) -> Option<()> {
        self.0 = self.0.get(count..)?;
        Some(())
    }

    fn u16(&mut self) -> Option<u16> {
        self.bytes().map(u16::from_le_bytes)
    }

    fn i32(&mut self) -> Option<i32> {
        self.bytes().map(i32::from_le_bytes)
    }

    fn f32(&mut self) -> Option<f64> {
        self.bytes().map(|bytes| f64::from(f32::from_le_bytes(bytes)))
    }

    /// How many elements a section has, no more than there can be bytes for; its stated size is skipped.
    fn count(&mut self, least: usize, sized: bool) -> Option<usize> {
        let count = usize::try_from(self.i32()?).ok()?;
        if sized {
            self.skip(4)?;
        }
        (count.checked_mul(least)? <= self.0.len()).then_some(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> Frame {
        let body = |id, tracked| Body {
            id,
            position: [0.5, 1.5, -2.0],
            orientation: [1.0, 0.0, 0.0, 0.0],
            error: 0.25,
            tracked,
        };
        Frame { number: 77, timestamp: 1.5, bodies: vec![body(1, true), body(9, false)] }
    }

    #[test]
    fn frames_come_back_in_both_bitstreams_and_no_cut_one_does() {
        for bitstream in [Bitstream::V3, Bitstream::V41] {
            let content = frame().encode(bitstream);
            assert_eq!(Frame::decode(&content, bitstream), Some(frame()));
            // The timestamp is the last that is read; 24 ticks, 2 flags and 4 zeros follow, 8 more in 4.1.
            let needed = content.len() - if bitstream == Bitstream::V3 { 30 } else { 38 };
            for cut in 0..content.len() {
                assert_eq!(Frame::decode(&content[..cut], bitstream).is_some(), cut >= needed, "{cut}");
            }
        }
    }

    #[test]
    fn counts_that_cannot_be_are_refused() {
        let mut content = frame().encode(Bitstream::V3);
        // Three counts of four bytes after the number.
        content[12..16].copy_from_slice(&i32::MAX.to_le_bytes());
        assert_eq!(Frame::decode(&content, Bitstream::V3), None);
        content[12..16].copy_from_slice(&(-1_i32).to_le_bytes());
        assert_eq!(Frame::decode(&content, Bitstream::V3), None);
    }

    #[test]
    fn server_and_client_understand_each_other() {
        let info = ServerInfo {
            version: [4, 1, 0, 0],
            clock: 10_000_000,
            data_port: DATA_PORT,
            group: Some(MULTICAST),
        };
        assert_eq!(info.encode().len(), 279);
        let bytes = message(message::SERVER_INFO, &info.encode());
        let (what, content) = open(&bytes).unwrap();
        assert_eq!((what, ServerInfo::decode(content)), (message::SERVER_INFO, Some(info)));
        assert_eq!(wanted(&connect(Bitstream::V3)), Some(Bitstream::V3));
        assert_eq!(wanted(&[]), None);
        assert_eq!(open(&bytes[..200]), None);
    }
}
