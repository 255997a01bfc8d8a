//! Encodes a moving test scene and prints frames per second, the size of the file and the peak memory of the process.
//!
//! `cargo run --release -p robohive-video --example encode -- OUT.mp4|.gif|.png [FRAMES] [WIDTHxHEIGHT]`

use std::path::Path;
use std::time::{Duration, Instant};

use robohive_video::{Frame, VideoWriter};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let path = arguments.first().ok_or("give the name of the video: OUT.mp4, OUT.gif or OUT.png")?;
    let frames: u32 = arguments.get(1).map_or(Ok(200), |text| text.parse())?;
    let (width, height) = match arguments.get(2).map(|text| text.split_once('x')) {
        None => (640, 480),
        Some(Some((width, height))) => (width.parse()?, height.parse()?),
        Some(None) => return Err("give the size as WIDTHxHEIGHT".into()),
    };
    let mut writer = VideoWriter::create(path, (width, height), 25.0)?;
    let mut rgb = vec![0; 3 * width as usize * height as usize];
    let mut spent = Duration::ZERO;
    for time in 0..frames {
        draw(time, width, &mut rgb);
        let frame = Frame::new(width, height, &rgb)?;
        let start = Instant::now();
        writer.push(&frame)?;
        spent += start.elapsed();
    }
    let start = Instant::now();
    writer.finish()?;
    spent += start.elapsed();
    println!(
        "{frames} frames of {width}x{height}: {:.0} frames/s, {} kB, peak memory {}",
        f64::from(frames) / spent.as_secs_f64(),
        std::fs::metadata(Path::new(path))?.len() / 1000,
        peak_memory().unwrap_or_else(|| "unknown on this system".into())
    );
    Ok(())
}

/// A checkered floor that scrolls under a shaded ball and a bar, with a little texture.
fn draw(time: u32, width: u32, rgb: &mut [u8]) {
    let t = time as f32 * 0.05;
    let (centre_x, centre_y) = (320.0 + 200.0 * t.sin(), 220.0 + 120.0 * (1.3 * t).cos());
    for (i, pixel) in rgb.as_chunks_mut::<3>().0.iter_mut().enumerate() {
        let (x, y) = ((i as u32 % width) as f32, (i as u32 / width) as f32);
        let (dx, dy) = ((x - centre_x) / 90.0, (y - centre_y) / 90.0);
        let inside = 1.0 - dx * dx - dy * dy;
        let floor = ((x + 40.0 * t) / 48.0).floor() as i32 + ((y + 25.0 * t) / 48.0).floor() as i32;
        *pixel = if inside > 0.0 {
            let light = 60.0 + 180.0 * (inside.sqrt() * 0.7 - dx * 0.3).max(0.0);
            [light as u8, (light * 0.55) as u8, (light * 0.3) as u8]
        } else if (x - 100.0 - 60.0 * t.cos()).abs() < 12.0 {
            [70, 110, 160]
        } else {
            let shade = if floor % 2 == 0 { 150.0 } else { 95.0 } + y * 0.1;
            [shade as u8, (shade * 1.02) as u8, (shade * 1.1) as u8]
        };
    }
}

/// The most memory that this process has had, as Linux reports it.
fn peak_memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().to_owned())
}
