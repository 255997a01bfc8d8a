//! DEC's Sixel: bands of six rows; in each band every colour draws its pixels as letters of six bits.
//!
//! Digital Equipment Corporation, VT330/VT340 Programmer Reference Manual, volume 2, chapter 14.

use std::fmt::Write;

use crate::frame::Frame;
use crate::palette::{Indexed, indexed};

/// Rows of a band.
const BAND: usize = 6;

/// The letter of no pixels; the others follow it.
const NOTHING: u8 = b'?';

/// The shortest run that is written as a count.
const RUN: usize = 4;

/// The text of a frame.
pub(super) fn text(frame: &Frame<'_>) -> String {
    let width = frame.width() as usize;
    let Indexed { palette, indices } = indexed(frame);
    // Pixels of aspect 1 that a picture does not draw stay as they are; then the size.
    let mut text = format!("\x1bP0;1;0q\"1;1;{};{}", frame.width(), frame.height());
    for (index, colour) in palette.iter().enumerate() {
        // Channels in percent.
        let [r, g, b] = colour.map(|channel| (u32::from(channel) * 100 + 127) / 255);
        write!(text, "#{index};2;{r};{g};{b}").expect("a text takes everything");
    }
    for band in indices.chunks(BAND * width) {
        draw(&mut text, band, width, palette.len());
        text.push('-');
    }
    text.push_str("\x1b\\\n");
    text
}

/// Draws one band of up to six rows.
fn draw(text: &mut String, band: &[u8], width: usize, colours: usize) {
    let mut letters = vec![Vec::new(); colours];
    for (row, pixels) in band.chunks(width).enumerate() {
        for (column, &colour) in pixels.iter().enumerate() {
            let line = &mut letters[colour as usize];
            line.resize(line.len().max(column + 1), 0);
            line[column] |= 1_u8 << row;
        }
    }
    for (colour, line) in letters.iter().enumerate().filter(|(_, line)| !line.is_empty()) {
        write!(text, "#{colour}").expect("a text takes everything");
        for run in line.chunk_by(|a, b| a == b) {
            let letter = char::from(NOTHING + run[0]);
            match run.len() {
                RUN.. => write!(text, "!{}{letter}", run.len()).expect("a text takes everything"),
                count => text.extend(std::iter::repeat_n(letter, count)),
            }
        }
        // Back to the start of the band.
        text.push('$');
    }
}
