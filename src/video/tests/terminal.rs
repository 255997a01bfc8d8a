//! What terminals are sent, read back.

mod scene;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use robohive_video::Frame;
use robohive_video::terminal::{Protocol, TerminalSize, preview};
use scene::scene;

/// A preview of the scene at a size.
fn shown(size: (u32, u32), protocol: Protocol, terminal: TerminalSize) -> String {
    let pixels = scene(size.0, size.1, 4);
    preview(&Frame::new(size.0, size.1, &pixels).unwrap(), protocol, terminal)
}

/// Width, height and pixels of a PNG of RGB.
fn picture(png: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width, info.height, pixels)
}

#[test]
fn half_blocks_fill_the_terminal_and_keep_the_aspect() {
    for (size, columns, rows, lines, width) in [
        ((640, 480), 80, 24, 24, 64),
        ((640, 480), 40, 24, 15, 40),
        ((10, 5), 80, 24, 3, 10),
        ((640, 480), 0, 0, 1, 1),
    ] {
        for protocol in [Protocol::HalfBlocks, Protocol::HalfBlocks256] {
            let text = shown(size, protocol, TerminalSize::of(columns, rows));
            assert_eq!(text.lines().count(), lines, "{size:?}");
            assert!(text.lines().all(|line| line.matches('▀').count() == width && line.ends_with("\x1b[0m")));
        }
    }
}

#[test]
fn kitty_is_sent_the_picture_in_pieces() {
    let terminal = TerminalSize { columns: 80, rows: 24, cell: (10, 20) };
    let text = shown((300, 200), Protocol::Kitty, terminal);
    let pieces: Vec<&str> = text.trim_end().split_terminator("\x1b\\").collect();
    assert!(pieces.len() > 1);
    let mut encoded = String::new();
    for (number, piece) in pieces.iter().enumerate() {
        let (keys, data) = piece.strip_prefix("\x1b_G").unwrap().split_once(';').unwrap();
        let more = u8::from(number + 1 < pieces.len());
        match number {
            0 => assert_eq!(keys, format!("a=T,f=100,q=2,c=30,r=10,m={more}")),
            _ => assert_eq!(keys, format!("m={more}")),
        }
        assert!(data.len() <= 4096);
        encoded += data;
    }
    let (width, height, pixels) = picture(&BASE64_STANDARD.decode(encoded).unwrap());
    assert_eq!((width, height, pixels), (300, 200, scene(300, 200, 4)));
}

#[test]
fn iterm2_is_sent_the_picture_scaled_down() {
    let text = shown((640, 480), Protocol::ITerm2, TerminalSize::of(20, 20));
    let (keys, data) = text.trim_end().split_once(':').unwrap();
    let png = BASE64_STANDARD.decode(data.strip_suffix('\x07').unwrap()).unwrap();
    let size = png.len();
    let expected = format!("\x1b]1337;File=inline=1;size={size};width=20;height=8;preserveAspectRatio=1");
    assert_eq!(keys, expected);
    let (width, height, _) = picture(&png);
    assert_eq!((width, height), (160, 120));
}

/// Palette in percent and pixels of a Sixel text.
fn decode_sixel(text: &str) -> (usize, usize, Vec<[u32; 3]>) {
    let body = text.strip_prefix("\x1bP0;1;0q\"1;1;").unwrap().strip_suffix("\x1b\\\n").unwrap();
    let mut rest = body.bytes().peekable();
    let numbers = |rest: &mut std::iter::Peekable<std::str::Bytes>| {
        let mut list = vec![0];
        while let Some(&byte) = rest.peek() {
            match byte {
                b'0'..=b'9' => {
                    *list.last_mut().unwrap() = list[list.len() - 1] * 10 + usize::from(byte - b'0')
                }
                b';' => list.push(0),
                _ => break,
            }
            rest.next();
        }
        list
    };
    let size = numbers(&mut rest);
    let (width, height) = (size[0], size[1]);
    let (mut palette, mut pixels) = (vec![[0; 3]; 256], vec![[u32::MAX; 3]; width * height]);
    let (mut colour, mut x, mut y, mut run) = (0, 0, 0, 1);
    while let Some(byte) = rest.next() {
        match byte {
            b'#' => {
                let list = numbers(&mut rest);
                colour = list[0];
                if let [_, 2, r, g, b] = list[..] {
                    palette[colour] = [r, g, b].map(|channel| channel as u32);
                }
            }
            b'!' => run = numbers(&mut rest)[0],
            b'$' => x = 0,
            b'-' => (x, y) = (0, y + 6),
            _ => {
                for _ in 0..std::mem::replace(&mut run, 1) {
                    for row in (0..6).filter(|row| (byte - b'?') >> row & 1 == 1) {
                        pixels[(y + row) * width + x] = palette[colour];
                    }
                    x += 1;
                }
            }
        }
    }
    (width, height, pixels)
}

#[test]
fn sixel_draws_every_pixel_in_its_colour() {
    let text = shown((120, 50), Protocol::Sixel, TerminalSize::of(80, 24));
    let (width, height, pixels) = decode_sixel(&text);
    assert_eq!((width, height), (120, 50));
    let expected = scene(120, 50, 4);
    for (number, (found, rgb)) in pixels.iter().zip(expected.as_chunks::<3>().0).enumerate() {
        for (percent, &channel) in found.iter().zip(rgb) {
            let value = percent * 255 / 100;
            assert!(value.abs_diff(u32::from(channel)) <= 24, "pixel {number}: {found:?} for {rgb:?}");
        }
    }
    let (width, height, _) = decode_sixel(&shown((640, 480), Protocol::Sixel, TerminalSize::of(40, 10)));
    assert_eq!((width, height), (213, 160));
}
