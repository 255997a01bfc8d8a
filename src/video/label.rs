//! Captions in a bitmap font of 8 x 8 pixels.

use font8x8::UnicodeFonts;

use crate::frame::Image;

/// Pixels of a side of a letter.
pub(crate) const LETTER: u32 = 8;

/// What stands for a letter that the font does not have.
const UNKNOWN: char = '?';

/// Draws a line of text whose upper left corner is (left, top). What does not fit into `width` pixels is cut, and two dots
/// say so.
pub(crate) fn draw(image: &mut Image, text: &str, (left, top): (u32, u32), width: u32, colour: [u8; 3]) {
    let room = (width / LETTER) as usize;
    let letters: Vec<char> = match text.chars().count() <= room {
        true => text.chars().collect(),
        false => text.chars().take(room.saturating_sub(2)).chain("..".chars()).take(room).collect(),
    };
    for (letter, number) in letters.into_iter().zip(0..) {
        for (bits, y) in bitmap(letter).into_iter().zip(0..) {
            for x in (0..LETTER).filter(|x| bits >> x & 1 == 1) {
                image.set(left + number * LETTER + x, top + y, colour);
            }
        }
    }
}

/// The rows of a letter from the top; the lowest bit is the leftmost pixel.
fn bitmap(letter: char) -> [u8; 8] {
    let known = |letter| font8x8::BASIC_FONTS.get(letter).or_else(|| font8x8::LATIN_FONTS.get(letter));
    known(letter).or_else(|| known(UNKNOWN)).unwrap_or_default()
}
