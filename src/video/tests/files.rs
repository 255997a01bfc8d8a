//! Still pictures, GIF and animated PNG read back; what goes wrong is said, and leaves no file.

mod folder;
mod likeness;
mod scene;

use std::fs::File;
use std::io::{BufReader, Cursor};

use folder::Folder;
use likeness::{luma, psnr};
use robohive_video::{
    Frame, MAX_SIDE, Sheet, VideoError, VideoFormat, VideoWriter, encode_png, png_bytes, write_depth_png,
    write_png,
};
use scene::scene;

/// Names of the files in a folder, sorted.
fn names(folder: &Folder) -> Vec<String> {
    let entries = std::fs::read_dir(folder.join(".")).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Colour type, depth, size and bytes of a PNG.
fn read_png(bytes: &[u8]) -> (png::ColorType, png::BitDepth, (u32, u32), Vec<u8>) {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.color_type, info.bit_depth, (info.width, info.height), pixels)
}

/// Copies a part of `width` by `height` pixels into a picture of `stride` columns.
fn place(picture: &mut [u8], stride: usize, part: &[u8], [left, top, width, height]: [usize; 4]) {
    assert_eq!(part.len(), 3 * width * height);
    for (row, y) in part.chunks(3 * width).zip(top..) {
        let start = 3 * (y * stride + left);
        picture[start..start + row.len()].copy_from_slice(row);
    }
}

#[test]
fn png_is_lossless() {
    let folder = Folder::new("png");
    let pixels = scene(83, 41, 3);
    let frame = Frame::new(83, 41, &pixels).unwrap();
    let path = folder.join("scene.png");
    std::fs::write(&path, "an older file").unwrap();
    write_png(&path, &frame).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(read_png(&bytes), (png::ColorType::Rgb, png::BitDepth::Eight, (83, 41), pixels.clone()));
    assert_eq!(bytes, png_bytes(&frame));
    assert_eq!(names(&folder), ["scene.png"]);
}

#[test]
fn depth_is_in_millimetres_and_saturates() {
    let folder = Folder::new("depth");
    let path = folder.join("depth.png");
    let depth = [0.0, 0.0014, 0.0016, 1.0, 65.535, 65.6, f32::INFINITY, f32::NAN, -1.0, f32::NEG_INFINITY];
    write_depth_png(&path, 5, 2, &depth).unwrap();
    let (colour, bits, size, bytes) = read_png(&std::fs::read(&path).unwrap());
    assert_eq!((colour, bits, size), (png::ColorType::Grayscale, png::BitDepth::Sixteen, (5, 2)));
    let values: Vec<u16> = bytes.as_chunks::<2>().0.iter().map(|&pair| u16::from_be_bytes(pair)).collect();
    assert_eq!(values, [0, 1, 2, 1000, 65535, 65535, 65535, 0, 0, 0]);
    let error = write_depth_png(&path, 5, 3, &depth).unwrap_err();
    assert!(matches!(error, VideoError::Length { expected: 15, found: 10, .. }), "{error}");
}

#[test]
fn gif_keeps_time_and_size() {
    let folder = Folder::new("gif");
    let mut parts = 0;
    // 15 frames at 30 a second take half a second; at 125 a second every third or second one fits.
    for (rate, frames, written, hundredths) in [(30.0, 15, 15, 50), (125.0, 125, 50, 100), (0.5, 2, 2, 400)] {
        let path = folder.join("scene.gif");
        let mut video = VideoWriter::create(&path, (40, 30), rate).unwrap();
        for time in 0..frames {
            video.push(&Frame::new(40, 30, &scene(40, 30, time)).unwrap()).unwrap();
        }
        video.finish().unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut reader = options.read_info(BufReader::new(File::open(&path).unwrap())).unwrap();
        assert_eq!((reader.width(), reader.height(), reader.repeat()), (40, 30, gif::Repeat::Infinite));
        let (mut count, mut time) = (0, 0);
        let mut shown = vec![0; 40 * 30 * 3];
        while let Some(frame) = reader.read_next_frame().unwrap() {
            let part: Vec<u8> =
                frame.buffer.as_chunks::<4>().0.iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
            let size = (frame.left, frame.top, frame.width, frame.height);
            place(&mut shown, 40, &part, [size.0, size.1, size.2, size.3].map(usize::from));
            parts += usize::from(size != (0, 0, 40, 30));
            if written == frames {
                let difference = psnr(&luma(&shown), &luma(&scene(40, 30, count)));
                assert!(difference >= 32.0, "frame {count}: {difference:.1} dB");
            }
            assert!(frame.delay >= 2);
            count += 1;
            time += u32::from(frame.delay);
        }
        assert!(count.abs_diff(written) <= 1, "{rate}: {count} frames");
        assert!(time.abs_diff(hundredths) <= 2, "{rate}: {time} hundredths");
    }
    assert!(parts > 10, "only {parts} frames are stored in part");
}

#[test]
fn animated_png_reads_back_frame_by_frame() {
    let folder = Folder::new("apng");
    let path = folder.join("scene.PNG");
    let mut video = VideoWriter::create(&path, (50, 20), 62.5).unwrap();
    for time in 0..7 {
        video.push(&Frame::new(50, 20, &scene(50, 20, time)).unwrap()).unwrap();
    }
    video.finish().unwrap();
    let mut reader = png::Decoder::new(BufReader::new(File::open(&path).unwrap())).read_info().unwrap();
    let animation = *reader.info().animation_control().unwrap();
    assert_eq!((animation.num_frames, animation.num_plays), (7, 0));
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let mut shown = vec![0; 50 * 20 * 3];
    for time in 0..7 {
        let read = reader.next_frame(&mut pixels).unwrap();
        let control = *reader.info().frame_control().unwrap();
        assert_eq!(f64::from(control.delay_den) / f64::from(control.delay_num), 62.5);
        let rectangle = [control.x_offset, control.y_offset, control.width, control.height];
        place(&mut shown, 50, &pixels[..read.buffer_size()], rectangle.map(|side| side as usize));
        assert_eq!(shown, scene(50, 20, time), "frame {time}");
    }
}

#[test]
fn frames_are_checked() {
    let error = |width, height, length| Frame::new(width, height, &vec![0; length]).unwrap_err();
    assert!(matches!(error(0, 5, 0), VideoError::Size { width: 0, height: 5 }));
    assert!(matches!(error(5, 0, 0), VideoError::Size { .. }));
    assert!(matches!(error(MAX_SIDE + 1, 1, 3), VideoError::Size { .. }));
    assert!(matches!(error(u32::MAX, u32::MAX, 3), VideoError::Size { .. }));
    let length = error(4, 4, 47);
    assert!(matches!(length, VideoError::Length { expected: 48, found: 47, .. }));
    assert_eq!(
        length.to_string(),
        "The RGB buffer has 47 elements, but a picture of 4 x 4 pixels has 48; pass a buffer and the size that it was \
         drawn with."
    );
}

#[test]
fn videos_are_checked() {
    let folder = Folder::new("checks");
    let create = |name: &str, size, rate| VideoWriter::create(folder.join(name), size, rate).unwrap_err();
    assert!(matches!(create("video.avi", (8, 8), 25.0), VideoError::UnknownFormat { .. }));
    assert!(matches!(create("video", (8, 8), 25.0), VideoError::UnknownFormat { .. }));
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY, 1001.0] {
        assert!(matches!(create("video.mp4", (8, 8), rate), VideoError::FrameRate { .. }));
    }
    assert!(matches!(create("video.gif", (0, 8), 25.0), VideoError::Size { .. }));
    let large = create("video.mp4", (8192, 8192), 25.0).to_string();
    assert!(
        large.contains("video.mp4") && large.contains("8192 x 8192") && large.contains("36864"),
        "{large}"
    );
    let missing = create("no/video.mp4", (8, 8), 25.0).to_string();
    assert!(missing.contains("no/video.mp4") && missing.contains("create the folder"), "{missing}");
    std::fs::create_dir(folder.join("folder.mp4")).unwrap();
    assert!(matches!(create("folder.mp4", (8, 8), 25.0), VideoError::NotAFile { .. }));
    assert_eq!(names(&folder), ["folder.mp4"]);
    assert_eq!(VideoFormat::of("a/B.GIF".as_ref()), Some(VideoFormat::Gif));
}

#[test]
fn only_finished_videos_have_their_name() {
    let folder = Folder::new("names");
    let pixels = scene(32, 32, 0);
    let frame = Frame::new(32, 32, &pixels).unwrap();
    for name in ["video.mp4", "video.gif", "video.png"] {
        let path = folder.join(name);
        std::fs::write(&path, "older").unwrap();
        let mut first = VideoWriter::create(&path, (32, 32), 25.0).unwrap();
        let mut second = VideoWriter::create(&path, (32, 32), 25.0).unwrap();
        first.push(&frame).unwrap();
        second.push(&frame).unwrap();
        let (zero, one) = (format!(".{name}.0.unfinished"), format!(".{name}.1.unfinished"));
        assert_eq!(names(&folder), [zero.as_str(), one.as_str(), name]);
        drop(first);
        assert_eq!(std::fs::read(&path).unwrap(), b"older");
        // A frame of another size is refused; the video goes on.
        let small = scene(16, 32, 0);
        let error = second.push(&Frame::new(16, 32, &small).unwrap()).unwrap_err();
        assert!(matches!(
            error,
            VideoError::SizeChanged { index: 1, expected: (32, 32), found: (16, 32), .. }
        ));
        second.push(&frame).unwrap();
        second.finish().unwrap();
        assert!(std::fs::metadata(&path).unwrap().len() > 100);
        assert_eq!(names(&folder), [name]);
        let empty = VideoWriter::create(&path, (32, 32), 25.0).unwrap().finish();
        assert!(matches!(empty, Err(VideoError::NoFrames { .. })));
        assert_eq!(names(&folder), [name]);
        std::fs::remove_file(&path).unwrap();
    }
}

#[test]
fn a_full_writer_is_an_error() {
    let pixels = scene(64, 64, 0);
    let frame = Frame::new(64, 64, &pixels).unwrap();
    let error = encode_png(&mut [0_u8; 100][..], &frame).unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::WriteZero);
    let full = VideoError::Io { path: "out/video.mp4".into(), error: std::io::ErrorKind::StorageFull.into() };
    let text = full.to_string();
    assert!(
        text.starts_with("out/video.mp4 cannot be written") && text.contains("free some space"),
        "{text}"
    );
}

#[test]
fn a_sheet_places_pictures_and_captions() {
    let mut sheet = Sheet::new(2, (40, 30)).unwrap();
    assert!(sheet.is_empty());
    for colour in [[200, 0, 0], [0, 200, 0], [0, 0, 200]] {
        let pixels = colour.repeat(80 * 30);
        sheet.add(&Frame::new(80, 30, &pixels).unwrap(), "Arm é✗ with a long caption").unwrap();
    }
    assert_eq!(sheet.len(), 3);
    let image = sheet.image().unwrap();
    let frame = image.frame();
    // Gaps of 8, cells of 40 x 30, captions of 8 after 4.
    assert_eq!((frame.width(), frame.height()), (8 + 2 * 48, 8 + 2 * 50));
    let pixel = |x: usize, y: u32| &frame.row(y)[3 * x..3 * x + 3];
    // Pictures of 40 x 15 in the middle of their cells.
    assert_eq!(pixel(8, 8 + 15), [200, 0, 0]);
    assert_eq!(pixel(56, 8 + 15), [0, 200, 0]);
    assert_eq!(pixel(8, 58 + 15), [0, 0, 200]);
    assert_eq!(pixel(8, 8 + 3), [225, 225, 225]);
    assert_eq!(pixel(56, 58 + 15), [250, 250, 250]);
    let ink = |left: usize, top: u32| {
        (top..top + 8)
            .flat_map(|y| (left..left + 40).map(move |x| (x, y)))
            .filter(|&(x, y)| pixel(x, y) == [30; 3])
            .count()
    };
    assert!(ink(8, 42) > 30 && ink(8, 42) == ink(56, 42) && ink(56, 92) == 0, "{}", ink(8, 42));
    assert!(matches!(Sheet::new(0, (40, 30)), Err(VideoError::SheetSize { .. })));
    assert!(matches!(Sheet::new(3, (16000, 30)), Err(VideoError::SheetSize { .. })));
    let mut long = Sheet::new(1, (8, 8000)).unwrap();
    long.add(&frame, "").unwrap();
    long.add(&frame, "").unwrap();
    assert!(matches!(long.add(&frame, ""), Err(VideoError::SheetSize { pictures: 3, .. })));
}
