//! PNG files of every colour type, depth and interlacing, beside the decoder of the `png` crate.

use robohive_mjcf::image::{FileImage, TextureSource, TextureType, texture};

/// Every colour type with its samples a pixel and the depths it may have.
const LAYOUTS: [(u8, usize, &[u8]); 5] =
    [(0, 1, &[1, 2, 4, 8, 16]), (2, 3, &[8, 16]), (3, 1, &[1, 2, 4, 8]), (4, 2, &[8, 16]), (6, 4, &[8, 16])];
const ADAM7: [[usize; 4]; 7] =
    [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

/// Bytes that look random and are the same in every run.
struct Bytes(u32);

impl Iterator for Bytes {
    type Item = u8;

    fn next(&mut self) -> Option<u8> {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        Some((self.0 >> 24) as u8)
    }
}

fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [kind.as_slice(), data].concat();
    let step = |crc: u32, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
    let crc = !body.iter().fold(u32::MAX, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step));
    [&(data.len() as u32).to_be_bytes(), body.as_slice(), &crc.to_be_bytes()].concat()
}

/// A zlib stream of one block that is stored as it is.
fn stored(data: &[u8]) -> Vec<u8> {
    let length = data.len() as u16;
    let (a, b) = data.iter().fold((1u32, 0u32), |(a, b), &x| {
        let a = (a + u32::from(x)) % 65521;
        (a, (b + a) % 65521)
    });
    let mut out = vec![0x78, 0x01, 1];
    out.extend(length.to_le_bytes());
    out.extend((!length).to_le_bytes());
    out.extend(data);
    out.extend((b << 16 | a).to_be_bytes());
    out
}

struct Image {
    width: usize,
    height: usize,
    color: u8,
    depth: u8,
    interlaced: bool,
    palette: Vec<u8>,
    transparency: Option<Vec<u8>>,
    /// What the pixels compress to.
    compressed: Vec<u8>,
}

impl Image {
    /// Pixels, filters and palette are arbitrary.
    fn arbitrary(size: [usize; 2], (color, samples): (u8, usize), depth: u8, interlaced: bool) -> Self {
        let mut bytes = Bytes(u32::from(color) * 100 + u32::from(depth));
        let [width, height] = size;
        let mut data = Vec::new();
        for [x, y, dx, dy] in if interlaced { ADAM7.to_vec() } else { vec![[0, 0, 1, 1]] } {
            let columns = width.saturating_sub(x).div_ceil(dx);
            let rows = if columns == 0 { 0 } else { height.saturating_sub(y).div_ceil(dy) };
            for row in 0..rows {
                data.push((row % 5) as u8);
                data.extend(bytes.by_ref().take((columns * samples * usize::from(depth)).div_ceil(8)));
            }
        }
        let colors = if color == 3 { 1 << depth } else { 0 };
        let palette = bytes.by_ref().take(3 * colors).collect();
        let transparency = match color {
            // The depth bounds the values of samples.
            0 => Some(vec![0, 1]),
            2 => Some(vec![0, 7, 0, 8, 0, 9]),
            3 => Some(bytes.take(colors / 2).collect()),
            _ => None,
        };
        Image { width, height, color, depth, interlaced, palette, transparency, compressed: stored(&data) }
    }

    fn file(&self) -> Vec<u8> {
        let size = [self.width as u32, self.height as u32].map(u32::to_be_bytes);
        let rest = [self.depth, self.color, 0, 0, u8::from(self.interlaced)];
        let mut out = b"\x89PNG\r\n\x1a\n".to_vec();
        out.extend(chunk(b"IHDR", &[size.as_flattened(), &rest].concat()));
        if !self.palette.is_empty() {
            out.extend(chunk(b"PLTE", &self.palette));
        }
        out.extend(self.transparency.iter().flat_map(|data| chunk(b"tRNS", data)));
        // A chunk that decoders may skip, and pixels in two pieces.
        out.extend(chunk(b"tEXt", b"Comment\0arbitrary"));
        let (head, tail) = self.compressed.split_at(self.compressed.len() / 3);
        out.extend(chunk(b"IDAT", head));
        out.extend(chunk(b"IDAT", tail));
        out.extend(chunk(b"IEND", &[]));
        out
    }
}

fn read(bytes: &[u8], nchannel: usize) -> Result<Vec<u8>, String> {
    let file = Some(FileImage { bytes: bytes.to_vec(), path: "image.png".into() });
    let source = TextureSource { kind: TextureType::Texture2d, file, nchannel, ..TextureSource::default() };
    texture(&source).map(|texture| texture.data).map_err(|error| error.message)
}

/// A file decoded by the `png` crate: red, green, blue and opacity of each pixel.
fn expected(bytes: &[u8]) -> Vec<[u8; 4]> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
    let mut reader = decoder.read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut data).unwrap();
    data.truncate(frame.buffer_size());
    data.chunks_exact(frame.color_type.samples())
        .map(|p| match *p {
            [grey] => [grey, grey, grey, 255],
            [grey, opacity] => [grey, grey, grey, opacity],
            [r, g, b] => [r, g, b, 255],
            _ => [p[0], p[1], p[2], p[3]],
        })
        .collect()
}

#[test]
fn every_layout_is_decoded_as_by_another_decoder() {
    for (color, samples, depths) in LAYOUTS {
        for &depth in depths {
            for (size, interlaced) in
                [([13, 11], false), ([1, 1], true), ([3, 2], true), ([13, 11], true), ([8, 16], true)]
            {
                let image = Image::arbitrary(size, (color, samples), depth, interlaced);
                for transparent in [true, false] {
                    let image = Image {
                        transparency: image.transparency.clone().filter(|_| transparent),
                        palette: image.palette.clone(),
                        compressed: image.compressed.clone(),
                        ..image
                    };
                    let file = image.file();
                    let expected = expected(&file);
                    for channels in [1, 3, 4] {
                        let wanted: Vec<u8> = expected.iter().flat_map(|p| p[..channels].to_vec()).collect();
                        let what = format!("type {color} depth {depth} {size:?} interlaced {interlaced}");
                        assert_eq!(read(&file, channels).unwrap(), wanted, "{what}, {channels} channels");
                    }
                }
            }
        }
    }
}

#[test]
fn compressed_pixels_are_inflated() {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 64, 48);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let pixels: Vec<u8> =
        (0..64 * 48).flat_map(|k| [(k % 64) as u8, (k / 64) as u8, (k % 7) as u8]).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    assert!(file.len() < pixels.len() / 4);
    assert_eq!(read(&file, 3).unwrap(), pixels);
}

#[test]
fn damage_is_named() {
    let image = Image::arbitrary([5, 4], (2, 3), 8, false);
    let whole = image.file();
    for at in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[at] ^= 0x20;
        // Only what decoders need not know may be damaged without an error: its kind, then skipped.
        let skipped = whole.windows(4).position(|w| w == b"tEXt").is_some_and(|t| (t..t + 4).contains(&at));
        assert!(read(&damaged, 3).is_err() || skipped, "byte {at}");
    }
    let error = |image: &Image| read(&image.file(), 3).unwrap_err();
    let long = Image { height: 3, ..Image::arbitrary([5, 4], (2, 3), 8, false) };
    assert!(error(&long).contains("more pixels than its header announces"), "{}", error(&long));
    let short = Image { height: 5, ..long };
    assert!(error(&short).contains("fewer pixels than its header announces"), "{}", error(&short));
    let depth = Image { depth: 4, ..short };
    assert!(error(&depth).contains("colour type 2 with 4 bits a sample does not exist"), "{}", error(&depth));
    let bare =
        Image { palette: Vec::new(), transparency: None, ..Image::arbitrary([5, 4], (3, 1), 8, false) };
    assert!(error(&bare).contains("the palette (chunk PLTE) is missing"), "{}", error(&bare));
    let critical = [whole[..33].to_vec(), chunk(b"ABCD", &[]), whole[33..].to_vec()].concat();
    assert!(read(&critical, 3).unwrap_err().contains("the chunk 'ABCD' is not known"));
    assert!(read(b"GIF89a", 3).unwrap_err().contains("signature of a PNG file"));
}
