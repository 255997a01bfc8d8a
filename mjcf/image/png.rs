//! PNG files (W3C, "Portable Network Graphics", third edition) to 8-bit pixels with a chosen number of channels.
//!
//! All colour types, depths and both interlace methods are read; of the optional chunks only `tRNS` and `sRGB`.

use fdeflate::{DecompressionError, Decompressor};

use super::scanline::{Layout, unfilter};
use super::source::MAX_BYTES;
use crate::asset::AssetError;

/// Decoded pixels, row by row from the top.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Pixels {
    pub width: usize,
    pub height: usize,
    /// `width * height * channels` bytes.
    pub data: Vec<u8>,
    /// The file declares the sRGB colour space.
    pub srgb: bool,
}

const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";

/// The rows and columns of the image that each pass of the Adam7 interlacing holds: first column, first row, step
/// between columns, step between rows.
const ADAM7: [[usize; 4]; 7] =
    [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];
/// The single pass of an image that is not interlaced.
const WHOLE: [[usize; 4]; 1] = [[0, 0, 1, 1]];

/// What the chunks of a file say; the pixels are still compressed.
struct Content {
    width: usize,
    height: usize,
    layout: Layout,
    interlaced: bool,
    srgb: bool,
    compressed: Vec<u8>,
}

/// Decodes with 1 (grey, the red channel of coloured files), 3 or 4 channels. 16-bit samples keep
/// their high byte.
///
/// # Errors
/// The bytes are not a PNG file, are damaged, end early, or ask for more than 1 GiB.
pub(super) fn decode(bytes: &[u8], path: &str, channels: usize) -> Result<Pixels, AssetError> {
    let named =
        |error: AssetError| AssetError { message: format!("PNG file '{path}': {}", error.message), ..error };
    pixels(bytes, channels).map_err(named)
}

fn pixels(bytes: &[u8], channels: usize) -> Result<Pixels, AssetError> {
    let content = read_chunks(bytes)?;
    let Content { width, height, ref layout, interlaced, srgb, .. } = content;
    let passes: &[[usize; 4]] = if interlaced { &ADAM7 } else { &WHOLE };
    let sizes: Vec<[usize; 2]> = passes.iter().map(|&pass| pass_size(pass, width, height)).collect();
    let filtered = sizes.iter().try_fold(0usize, |sum, &[columns, rows]| {
        layout.row_bytes(columns)?.checked_add(1)?.checked_mul(rows)?.checked_add(sum)
    });
    let decoded = width.checked_mul(height).and_then(|count| count.checked_mul(channels));
    let (Some(filtered), Some(decoded)) =
        (filtered.filter(|&n| n <= MAX_BYTES), decoded.filter(|&n| n <= MAX_BYTES))
    else {
        return Err(AssetError::malformed(format!("{width}x{height} pixels are too many")));
    };
    // Deflate expands at most about a thousandfold; a header that claims more is false.
    if filtered / 2048 > bytes.len() {
        let message = format!("it announces {width}x{height} pixels in {} bytes", bytes.len());
        return Err(AssetError::truncated(message));
    }
    let mut stream = Stream::new(&content.compressed);
    let mut data = vec![0; decoded];
    for (&[x0, y0, dx, dy], &[columns, rows]) in passes.iter().zip(&sizes) {
        let length = layout.row_bytes(columns).unwrap_or(0);
        let (mut above, mut line) = (vec![0; length], vec![0; length]);
        for row in 0..rows {
            let mut filter = [0];
            stream.read(&mut filter)?;
            stream.read(&mut line)?;
            unfilter(filter[0], layout.pixel_bytes(), &above, &mut line).ok_or_else(|| {
                AssetError::malformed(format!("row {} has unknown filter {}", row + 1, filter[0]))
            })?;
            let start = ((y0 + row * dy) * width + x0) * channels;
            layout.expand(&line, columns, &mut data[start..], channels, dx * channels);
            std::mem::swap(&mut above, &mut line);
        }
    }
    stream.end()?;
    Ok(Pixels { width, height, data, srgb })
}

/// Columns and rows of a pass over an image.
fn pass_size([x0, y0, dx, dy]: [usize; 4], width: usize, height: usize) -> [usize; 2] {
    let [columns, rows] = [width.saturating_sub(x0).div_ceil(dx), height.saturating_sub(y0).div_ceil(dy)];
    if columns == 0 || rows == 0 { [0, 0] } else { [columns, rows] }
}

/// A zlib stream, inflated piece by piece.
struct Stream<'a> {
    decoder: Decompressor,
    compressed: &'a [u8],
    /// What was inflated last, behind what the next piece may repeat.
    window: Vec<u8>,
    /// Where in the window what was not read yet begins, and where it ends.
    unread: [usize; 2],
}

/// Bytes that deflate may repeat from.
const HISTORY: usize = 32 << 10;
/// Bytes that are inflated at once: they stay in the cache until they are read.
const PIECE: usize = 64 << 10;

impl<'a> Stream<'a> {
    fn new(compressed: &'a [u8]) -> Self {
        let window = vec![0; HISTORY + PIECE];
        Stream { decoder: Decompressor::new(), compressed, window, unread: [0, 0] }
    }

    /// Fills `out` with the next bytes.
    fn read(&mut self, mut out: &mut [u8]) -> Result<(), AssetError> {
        while !out.is_empty() {
            if self.unread[0] == self.unread[1] && !self.inflate()? {
                return Err(AssetError::truncated("it holds fewer pixels than its header announces"));
            }
            let [start, end] = self.unread;
            let count = out.len().min(end - start);
            let (head, rest) = out.split_at_mut(count);
            head.copy_from_slice(&self.window[start..start + count]);
            self.unread[0] += count;
            out = rest;
        }
        Ok(())
    }

    /// Inflates more once all is read; `false` at the end of the stream.
    fn inflate(&mut self) -> Result<bool, AssetError> {
        let mut end = self.unread[1];
        if end == self.window.len() {
            self.window.copy_within(end - HISTORY.., 0);
            end = HISTORY;
        }
        self.unread = [end, end];
        while !self.decoder.is_done() && self.unread[1] == end {
            let read = self.decoder.read(self.compressed, &mut self.window, end, true);
            let (consumed, produced) = read.map_err(|error| match error {
                DecompressionError::InsufficientInput => {
                    AssetError::truncated("the compressed pixels end early")
                }
                _ => AssetError::malformed("the compressed pixels are damaged"),
            })?;
            self.compressed = &self.compressed[consumed..];
            self.unread[1] += produced;
            if consumed == 0 && produced == 0 && !self.decoder.is_done() {
                return Err(AssetError::truncated("the compressed pixels end early"));
            }
        }
        Ok(self.unread[1] > end)
    }

    /// Checks that nothing is left, and the checksum behind it.
    fn end(&mut self) -> Result<(), AssetError> {
        if self.unread[0] < self.unread[1] || self.inflate()? {
            return Err(AssetError::malformed("it holds more pixels than its header announces"));
        }
        Ok(())
    }
}

/// Reads the chunks up to the end of the pixels.
fn read_chunks(bytes: &[u8]) -> Result<Content, AssetError> {
    if bytes.is_empty() {
        return Err(AssetError::truncated("the file is empty"));
    }
    let Some(mut rest) = bytes.strip_prefix(SIGNATURE) else {
        return Err(AssetError::malformed("it does not begin with the signature of a PNG file"));
    };
    let (kind, data) = next_chunk(&mut rest)?;
    if &kind != b"IHDR" {
        return Err(AssetError::malformed("the header (chunk IHDR) is missing"));
    }
    let mut content = read_header(data)?;
    loop {
        let (kind, data) = next_chunk(&mut rest)?;
        match &kind {
            b"PLTE" => content.layout.set_palette(data)?,
            b"tRNS" => content.layout.set_transparency(data)?,
            b"sRGB" => content.srgb = true,
            b"IDAT" => content.compressed.extend_from_slice(data),
            b"IEND" => break,
            // Upper case: a decoder that does not know the chunk cannot show the image.
            [first, ..] if first.is_ascii_uppercase() => {
                let kind = String::from_utf8_lossy(&kind).into_owned();
                return Err(AssetError::unsupported(format!("the chunk '{kind}' is not known")));
            }
            _ => {}
        }
        // What follows the pixels cannot change them.
        if rest.is_empty() && !content.compressed.is_empty() {
            break;
        }
    }
    content.layout.complete()?;
    Ok(content)
}

/// Size, layout and interlacing.
fn read_header(data: &[u8]) -> Result<Content, AssetError> {
    let &[w0, w1, w2, w3, h0, h1, h2, h3, depth, color, compression, filter, interlace] = data else {
        return Err(AssetError::malformed("the header does not have 13 bytes"));
    };
    let [width, height] = [[w0, w1, w2, w3], [h0, h1, h2, h3]].map(|n| u32::from_be_bytes(n) as usize);
    if width == 0 || height == 0 || compression != 0 || filter != 0 || interlace > 1 {
        return Err(AssetError::malformed("the header has a value that PNG does not define"));
    }
    let layout = Layout::new(color, depth).ok_or_else(|| {
        AssetError::malformed(format!("colour type {color} with {depth} bits a sample does not exist"))
    })?;
    Ok(Content { width, height, layout, interlaced: interlace == 1, srgb: false, compressed: Vec::new() })
}

/// Kind and content of the next chunk, whose checksum fits.
fn next_chunk<'a>(rest: &mut &'a [u8]) -> Result<([u8; 4], &'a [u8]), AssetError> {
    let early = || AssetError::truncated("the file ends early");
    let (length, after) = rest.split_first_chunk::<4>().ok_or_else(early)?;
    let length = u32::from_be_bytes(*length) as usize;
    let checked = length.checked_add(4).and_then(|n| after.split_at_checked(n)).ok_or_else(early)?;
    let (sum, after) = checked.1.split_first_chunk::<4>().ok_or_else(early)?;
    let (kind, data) = checked.0.split_first_chunk::<4>().ok_or_else(early)?;
    if crc(checked.0) != u32::from_be_bytes(*sum) {
        let kind = kind.escape_ascii();
        return Err(AssetError::malformed(format!("the chunk '{kind}' is damaged (checksum)")));
    }
    *rest = after;
    Ok((*kind, data))
}

/// Remainders of the polynomial division of CRC-32 (PNG, annex D): row `k` holds the remainders of a byte with `k` zero bytes
/// behind it, so that eight bytes are divided at once.
const REMAINDERS: [[u32; 256]; 8] = {
    let mut table = [[0; 256]; 8];
    let mut byte = 0;
    while byte < 256 {
        let mut rest = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            rest = (rest >> 1) ^ (0xedb8_8320 & (rest & 1).wrapping_neg());
            bit += 1;
        }
        table[0][byte] = rest;
        byte += 1;
    }
    let mut row = 1;
    while row < 8 {
        let mut byte = 0;
        while byte < 256 {
            let before = table[row - 1][byte];
            table[row][byte] = (before >> 8) ^ table[0][(before & 0xff) as usize];
            byte += 1;
        }
        row += 1;
    }
    table
};

/// CRC-32 of `bytes`.
fn crc(bytes: &[u8]) -> u32 {
    let (words, rest) = bytes.as_chunks::<8>();
    let mut sum = u32::MAX;
    for word in words {
        let mixed = u64::from_le_bytes(*word) ^ u64::from(sum);
        let mixed = mixed.to_le_bytes();
        sum = (0..8).fold(0, |sum, k| sum ^ REMAINDERS[7 - k][usize::from(mixed[k])]);
    }
    for &byte in rest {
        sum = (sum >> 8) ^ REMAINDERS[0][((sum ^ u32::from(byte)) & 0xff) as usize];
    }
    !sum
}
