//! Protocols that carry a whole PNG: Kitty's and iTerm2's.
//!
//! <https://sw.kovidgoyal.net/kitty/graphics-protocol>, <https://iterm2.com/documentation-images.html>

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use crate::frame::Frame;
use crate::png_file::png_bytes;

/// Most bytes of text that Kitty takes at once, a multiple of 4.
const PIECE: usize = 4096;

/// The text for Kitty: transmit and show (`a=T`) a PNG (`f=100`) over `columns` by `rows` cells, without an answer (`q=2`).
pub(super) fn kitty(frame: &Frame<'_>, (columns, rows): (u32, u32)) -> String {
    let encoded = BASE64_STANDARD.encode(png_bytes(frame));
    let last = encoded.len().div_ceil(PIECE) - 1;
    let mut text = String::with_capacity(encoded.len() + encoded.len() / 64 + 64);
    for (number, start) in (0..encoded.len()).step_by(PIECE).enumerate() {
        let more = u8::from(number < last);
        let piece = &encoded[start..encoded.len().min(start + PIECE)];
        match number {
            0 => text += &format!("\x1b_Ga=T,f=100,q=2,c={columns},r={rows},m={more};{piece}\x1b\\"),
            _ => text += &format!("\x1b_Gm={more};{piece}\x1b\\"),
        }
    }
    text.push('\n');
    text
}

/// The text for iTerm2.
pub(super) fn iterm2(frame: &Frame<'_>, (columns, rows): (u32, u32)) -> String {
    let png = png_bytes(frame);
    format!(
        "\x1b]1337;File=inline=1;size={};width={columns};height={rows};preserveAspectRatio=1:{}\x07\n",
        png.len(),
        BASE64_STANDARD.encode(&png)
    )
}
