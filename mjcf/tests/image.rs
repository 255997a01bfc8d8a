//! Textures and height fields: layouts, flips, normalisation, and files that lie.

use robohive_mjcf::asset::AssetErrorKind;
use robohive_mjcf::image::{
    Builtin, ColorSpace, FileImage, HfieldSource, Mark, TextureSource, TextureType, hfield, texture,
};

/// PNG with `width` pixels per row of 8-bit samples; `color` is the PNG colour type.
fn png_file(width: u32, rows: &[&[u8]], color: png::ColorType, srgb: bool) -> FileImage {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, rows.len() as u32);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    if srgb {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&rows.concat()).unwrap();
    writer.finish().unwrap();
    FileImage { bytes, path: "image.png".into() }
}

#[test]
fn image_keeps_pixels_and_flips_them() {
    let file = png_file(2, &[&[1, 2, 3, 4, 5, 6], &[7, 8, 9, 10, 11, 12]], png::ColorType::Rgb, true);
    let plain = TextureSource { kind: TextureType::Texture2d, file: Some(file), ..TextureSource::default() };
    let straight = texture(&plain).unwrap();
    assert_eq!((straight.width, straight.height, straight.nchannel), (2, 2, 3));
    assert_eq!(straight.colorspace, ColorSpace::Srgb);
    assert_eq!(straight.data, (1..=12).collect::<Vec<u8>>());
    let turned = texture(&TextureSource { hflip: true, vflip: true, ..plain.clone() }).unwrap();
    assert_eq!(turned.data, [10, 11, 12, 7, 8, 9, 4, 5, 6, 1, 2, 3]);
    let grey = texture(&TextureSource { nchannel: 1, ..plain.clone() }).unwrap();
    assert_eq!(grey.data, [1, 4, 7, 10]);
    let alpha = texture(&TextureSource { nchannel: 4, ..plain }).unwrap();
    assert_eq!(alpha.data[..8], [1, 2, 3, 255, 4, 5, 6, 255]);
}

#[test]
fn grid_is_cut_into_cube_faces() {
    let rows: [&[u8]; 2] = [&[1; 6], &[2; 6]];
    let file = png_file(2, &rows, png::ColorType::Rgb, false);
    let source = TextureSource {
        file: Some(file),
        gridsize: [2, 2],
        gridlayout: "R.DU".into(),
        rgb1: [1.0, 0.5, 0.0],
        ..TextureSource::default()
    };
    let cube = texture(&source).unwrap();
    assert_eq!((cube.width, cube.height, cube.colorspace), (1, 6, ColorSpace::Linear));
    let blank = [255, 127, 0];
    let faces: Vec<&[u8]> = cube.data.chunks(3).collect();
    assert_eq!(faces, [&[1; 3], &blank, &[2; 3], &[2; 3], &blank, &blank]);
    let wrong = TextureSource { gridsize: [1, 2], ..source };
    assert_eq!(texture(&wrong).unwrap_err().kind, AssetErrorKind::Inconsistent);
}

#[test]
fn checker_has_four_squares_and_marks() {
    let source = TextureSource {
        kind: TextureType::Texture2d,
        builtin: Builtin::Checker,
        mark: Mark::Cross,
        rgb1: [1.0, 0.0, 0.0],
        rgb2: [0.0, 1.0, 0.0],
        markrgb: [0.0, 0.0, 1.0],
        width: 4,
        height: 4,
        ..TextureSource::default()
    };
    let letters: String = texture(&source)
        .unwrap()
        .data
        .chunks(3)
        .map(|p| ['R', 'G', 'B'][p.iter().position(|&x| x == 255).unwrap()])
        .collect();
    assert_eq!(letters, "RRBGRRBGBBBBGGBR");
}

#[test]
fn random_marks_have_the_given_density() {
    let source = TextureSource {
        builtin: Builtin::Flat,
        mark: Mark::Random,
        rgb1: [0.0; 3],
        rgb2: [0.0; 3],
        markrgb: [1.0; 3],
        random: 0.25,
        width: 64,
        ..TextureSource::default()
    };
    let data = texture(&source).unwrap().data;
    let share = data.iter().filter(|&&x| x == 255).count() as f64 / data.len() as f64;
    assert!((share - 0.25).abs() < 0.01, "{share}");
}

#[test]
fn height_fields_are_scaled_to_unit_range() {
    let file = png_file(2, &[&[10, 20], &[30, 60]], png::ColorType::Grayscale, false);
    let source =
        HfieldSource { file: Some((file.bytes, file.path)), size: [1.0; 4], ..HfieldSource::default() };
    let field = hfield(source).unwrap();
    assert_eq!((field.nrow, field.ncol), (2, 2));
    // Images are stored top down, fields bottom up.
    assert_eq!(field.data, [0.4, 1.0, 0.0, 0.2]);
    let flat =
        HfieldSource { nrow: 1, ncol: 2, elevation: vec![3.0; 2], size: [1.0; 4], ..HfieldSource::default() };
    assert_eq!(hfield(flat).unwrap().data, [0.0, 0.0]);
}

#[test]
fn lying_images_are_errors() {
    let whole = png_file(2, &[&[1; 6], &[2; 6]], png::ColorType::Rgb, false);
    let with = |bytes: Vec<u8>, path: &str| {
        let file = Some(FileImage { bytes, path: path.into() });
        texture(&TextureSource { kind: TextureType::Texture2d, file, ..TextureSource::default() })
            .unwrap_err()
            .kind
    };
    for length in 0..whole.bytes.len() - 12 {
        let kind = with(whole.bytes[..length].to_vec(), "x.png");
        assert!(matches!(kind, AssetErrorKind::Malformed | AssetErrorKind::Truncated));
    }
    assert_eq!(with(whole.bytes, "x.jpg"), AssetErrorKind::Unsupported);
    let field: Vec<u8> = [i32::MAX, i32::MAX].iter().flat_map(|x| x.to_le_bytes()).collect();
    let source =
        HfieldSource { file: Some((field, "x.bin".into())), size: [1.0; 4], ..HfieldSource::default() };
    assert_eq!(hfield(source).unwrap_err().kind, AssetErrorKind::Truncated);
}

/// The decoder of the `png` crate would index beyond the end of such a palette.
#[test]
fn palette_that_ends_inside_a_colour_is_refused() {
    let crc = |bytes: &[u8]| {
        let step = |crc: u32, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
        !bytes.iter().fold(u32::MAX, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
    };
    let chunk = |kind: &[u8; 4], data: &[u8]| {
        let body = [kind.as_slice(), data].concat();
        [&(data.len() as u32).to_be_bytes(), body.as_slice(), &crc(&body).to_be_bytes()].concat()
    };
    // One pixel, index 0, in a stored block of deflate.
    let stored = [0x78, 0x01, 1, 2, 0, 0xfd, 0xff, 0, 0, 0, 2, 0, 1];
    let image = |palette: &[u8]| FileImage {
        bytes: [
            b"\x89PNG\r\n\x1a\n".to_vec(),
            chunk(b"IHDR", &[0, 0, 0, 1, 0, 0, 0, 1, 8, 3, 0, 0, 0]),
            chunk(b"PLTE", palette),
            chunk(b"IDAT", &stored),
            chunk(b"IEND", &[]),
        ]
        .concat(),
        path: "p.png".into(),
    };
    let read = |palette: &[u8]| {
        let file = Some(image(palette));
        texture(&TextureSource { kind: TextureType::Texture2d, file, ..TextureSource::default() })
    };
    assert_eq!(read(&[1, 2, 3]).unwrap().data, [1, 2, 3]);
    let error = read(&[1, 2, 3, 4]).unwrap_err();
    assert_eq!(error.kind, AssetErrorKind::Malformed);
    assert!(error.message.contains("the palette ends inside a colour"), "{error}");
}

/// A KTX file of version 1.1: one level of `length` bytes.
fn ktx(width: u32, height: u32, length: u32) -> Vec<u8> {
    let mut file = b"\xabKTX 11\xbb\r\n\x1a\n".to_vec();
    let header = [0x0403_0201, 0x1401, 1, 0x1908, 0x8058, 0x1908, width, height, 0, 0, 1, 1, 0, length];
    file.extend(header.iter().flat_map(|x: &u32| x.to_le_bytes()));
    file.extend(vec![7; 16]);
    file
}

/// A KTX file of version 2.0 with one level of 16 bytes at `start`.
fn ktx2(width: u32, start: u64) -> Vec<u8> {
    let mut file = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let header = [37_u32, 1, width, 2, 0, 0, 1, 1, 0, 0, 0, 0, 0];
    file.extend(header.iter().flat_map(|x| x.to_le_bytes()));
    file.extend([0_u64, 0, start, 16, 16].iter().flat_map(|x| x.to_le_bytes()));
    file.extend([7; 16]);
    file
}

#[test]
fn containers_hold_what_their_headers_say() {
    let read = |bytes: Vec<u8>| {
        let file = Some(FileImage { bytes, path: "sky.ktx".into() });
        texture(&TextureSource { kind: TextureType::Texture2d, file, ..Default::default() })
    };
    assert!(read(ktx(2, 2, 16)).is_ok() && read(ktx2(2, 104)).is_ok());
    for whole in [ktx(2, 2, 16), ktx2(2, 104)] {
        for end in 0..whole.len() {
            let error = read(whole[..end].to_vec()).unwrap_err().message;
            assert!(error.contains("cut short") || end < 12, "{end}: {error}");
        }
    }
    for (bytes, reason) in [
        (ktx(2, 2, 160), "has 84 bytes, and by its header at least 228"),
        (ktx(2, 2, u32::MAX), "cut short"),
        (ktx(0, 2, 16), "is 0 x 2 x 0 pixels"),
        (ktx(2, u32::MAX, 16), "no flat picture"),
        (ktx(2, 2, 0), "a level without pixels"),
        (ktx2(0, 104), "is 0 x 2 x 0 pixels"),
        (ktx2(2, 105), "has 120 bytes, and by its header at least 121"),
        (ktx2(2, u64::MAX), "cut short"),
        (b"no container at all".to_vec(), "does not begin as KTX files"),
    ] {
        let error = read(bytes).unwrap_err().message;
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn container_is_kept_byte_for_byte() {
    let bytes = ktx(2, 2, 16);
    let file = FileImage { bytes: bytes.clone(), path: "sky.KTX".into() };
    let source = TextureSource { kind: TextureType::Texture2d, file: Some(file), ..Default::default() };
    let kept = texture(&source).unwrap();
    assert_eq!((kept.width, kept.height, kept.nchannel), (bytes.len(), 1, 1));
    assert_eq!(kept.data, bytes);
    let flipped = TextureSource { hflip: true, ..source.clone() };
    assert_eq!(texture(&flipped).unwrap_err().kind, AssetErrorKind::Inconsistent);
    let cube = TextureSource { kind: TextureType::Cube, ..source };
    assert_eq!(texture(&cube).unwrap_err().kind, AssetErrorKind::Unsupported);
}
