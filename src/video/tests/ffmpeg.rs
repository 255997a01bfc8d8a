//! What ffmpeg reads of the videos, where it is installed.

mod folder;
mod likeness;
mod scene;

use std::path::Path;
use std::process::Command;

use folder::Folder;
use likeness::{luma, psnr};
use robohive_video::{Frame, VideoWriter};
use scene::scene;

/// What a program prints, or none where it is not installed.
fn output(program: &str, arguments: &[&str]) -> Option<Vec<u8>> {
    let result = Command::new(program).args(arguments).output();
    let Ok(output) = result else {
        eprintln!("{program} is not installed, so that nothing is compared with it");
        return None;
    };
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{program} {arguments:?}: {errors}");
    Some(output.stdout)
}

fn write(path: &Path, (width, height): (u32, u32), frames: u32, rate: f64) {
    let mut video = VideoWriter::create(path, (width, height), rate).unwrap();
    for time in 0..frames {
        video.push(&Frame::new(width, height, &scene(width, height, time)).unwrap()).unwrap();
    }
    video.finish().unwrap();
}

/// Frames of a video as ffmpeg converts them, one after another.
fn decoded(path: &Path, format: &str) -> Option<Vec<u8>> {
    let path = path.to_str().unwrap();
    output("ffmpeg", &["-v", "error", "-i", path, "-vsync", "0", "-f", "rawvideo", "-pix_fmt", format, "-"])
}

#[test]
fn mp4_has_the_luma_of_the_frames() {
    let folder = Folder::new("ffmpeg-mp4");
    for (width, height) in [(320, 240), (99, 75)] {
        let path = folder.join("scene.mp4");
        write(&path, (width, height), 60, 25.0);
        let Some(planes) = decoded(&path, "yuv420p") else { return };
        let (even_width, even_height) =
            (width.next_multiple_of(2) as usize, height.next_multiple_of(2) as usize);
        let frames: Vec<_> = planes.chunks(even_width * even_height * 3 / 2).collect();
        assert_eq!(frames.len(), 60);
        for (frame, time) in frames.into_iter().zip(0..) {
            let rows = frame.chunks(even_width).take(height as usize);
            let visible: Vec<u8> = rows.flat_map(|row| &row[..width as usize]).copied().collect();
            let difference = psnr(&luma(&scene(width, height, time)), &visible);
            assert!(difference >= 40.0, "{width} x {height}, frame {time}: {difference:.1} dB");
        }
    }
}

#[test]
fn mp4_is_described_as_it_was_written() {
    let folder = Folder::new("ffprobe");
    let path = folder.join("scene.mp4");
    write(&path, (100, 50), 75, 25.0);
    let entries = "stream=codec_name,profile,width,height,pix_fmt,color_range,color_space,avg_frame_rate,nb_frames,duration";
    let arguments = ["-v", "error", "-show_entries", entries, "-of", "default=nw=1", path.to_str().unwrap()];
    let Some(found) = output("ffprobe", &arguments) else { return };
    let found = String::from_utf8(found).unwrap();
    let expected = [
        "codec_name=h264",
        "profile=High",
        "width=100",
        "height=50",
        "pix_fmt=yuv420p",
        "color_range=tv",
        "color_space=smpte170m",
        "avg_frame_rate=25/1",
        "nb_frames=75",
        "duration=3.000000",
    ];
    let lines: Vec<_> = found.lines().collect();
    for line in expected {
        assert!(lines.contains(&line), "{line} is not in {lines:?}");
    }
}

#[test]
fn colours_come_back() {
    let folder = Folder::new("ffmpeg-colours");
    let path = folder.join("colours.mp4");
    let colours = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255], [128, 128, 128], [250, 180, 40]];
    let mut video = VideoWriter::create(&path, (64, 48), 10.0).unwrap();
    for colour in colours {
        video.push(&Frame::new(64, 48, &colour.repeat(64 * 48)).unwrap()).unwrap();
    }
    video.finish().unwrap();
    let Some(pixels) = decoded(&path, "rgb24") else { return };
    for (frame, colour) in pixels.chunks(64 * 48 * 3).zip(colours) {
        let worst = frame.iter().zip(colour.iter().cycle()).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(worst <= 8, "{colour:?} comes back as {:?}", &frame[..3]);
    }
}

#[test]
fn animated_png_is_lossless() {
    let folder = Folder::new("ffmpeg-apng");
    let path = folder.join("scene.png");
    write(&path, (61, 47), 12, 30.0);
    let Some(pixels) = decoded(&path, "rgb24") else { return };
    let expected: Vec<u8> = (0..12).flat_map(|time| scene(61, 47, time)).collect();
    assert!(pixels == expected, "{} bytes, expected {}", pixels.len(), expected.len());
}

#[test]
fn gif_has_all_frames() {
    let folder = Folder::new("ffmpeg-gif");
    let path = folder.join("scene.gif");
    write(&path, (61, 47), 12, 25.0);
    let Some(pixels) = decoded(&path, "rgb24") else { return };
    assert_eq!(pixels.len(), 12 * 61 * 47 * 3);
    for (frame, time) in pixels.chunks(61 * 47 * 3).zip(0..) {
        let difference = psnr(&scene(61, 47, time), frame);
        assert!(difference >= 32.0, "frame {time}: {difference:.1} dB");
    }
}
