//! Labels: text over a finished picture, in front of everything.
//!
//! A label begins where its item is, as MuJoCo's does. The letters come from the public-domain font8x8, not from MuJoCo.

use super::colour::paint::eight_bits;
use super::window::projection::Projection;
use crate::picture::Picture;
use crate::scene::Scene;
use crate::view::View;
use font8x8::{BASIC_FONTS, LATIN_FONTS, UnicodeFonts};

/// Pixels along a side of a letter.
const LETTER: i32 = 8;
/// Rows of a picture for each pixel of a letter's pixel, so that text stays legible on large pictures.
const ROWS: usize = 240;
/// What stands for letters that the font lacks.
const UNKNOWN: char = '?';

/// Writes the labels of a scene over the colours of its picture: white with a black edge, one after the other. Items outside of
/// the frustum have none. Nothing changes where the picture has no colours or the frustum is empty.
pub fn draw(scene: &Scene, picture: &mut Picture) {
    let (width, height) = (picture.width, picture.height);
    let labelled = scene.items.iter().filter(|item| !item.label.is_empty());
    let Ok(projection) = Projection::of(&scene.view, width, height) else { return };
    if picture.rgb.len() != 3 * width * height {
        return;
    }
    let mut page = Page { rgb: &mut picture.rgb, width: width as i32, height: height as i32 };
    let scale = (height / ROWS).max(1) as i32;
    for item in labelled {
        let p = item.pos.map(f64::from);
        let [x, y, z, w] = projection.0.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
        let inside = |at: f64, end: f64| (0.0..=end * w).contains(&at);
        if !(w > 0.0 && inside(x, width as f64) && inside(y, height as f64) && inside(z, 1.0)) {
            continue;
        }
        let View { eye, forward, .. } = scene.view;
        let away = (0..3).map(|k| forward[k] * (p[k] - eye[k])).sum::<f64>() as f32;
        let colour =
            |own: [f32; 3]| scene.fog.map_or(own, |fog| fog.over(fog.clearness(away), own)).map(eight_bits);
        let place = [(x / w).floor() as i32, height as i32 - (y / w).floor() as i32 - scale * LETTER];
        page.write(&item.label, place, scale, [colour([0.0; 3]), colour([1.0; 3])]);
    }
}

/// Colours that are written on, rows from the top.
struct Page<'a> {
    rgb: &'a mut [u8],
    width: i32,
    height: i32,
}

impl Page<'_> {
    /// Writes text whose upper left corner is `place`, with an edge of one pixel.
    fn write(&mut self, text: &str, place: [i32; 2], scale: i32, [edge, colour]: [[u8; 3]; 2]) {
        // Letters that begin beyond the right side are not seen.
        let room = (self.width - place[0]) / (scale * LETTER) + 1;
        let letters = || text.chars().take(room.max(0) as usize).zip(0..);
        for (letter, number) in letters() {
            self.letter(letter, [place[0] + number * scale * LETTER, place[1]], scale, (1, edge));
        }
        for (letter, number) in letters() {
            self.letter(letter, [place[0] + number * scale * LETTER, place[1]], scale, (0, colour));
        }
    }

    /// Fills the pixels of a letter and those within `reach` of them.
    fn letter(&mut self, letter: char, [left, top]: [i32; 2], scale: i32, (reach, colour): (i32, [u8; 3])) {
        for (bits, row) in letter_rows(letter).into_iter().zip(0..) {
            for column in (0..LETTER).filter(|column| bits >> column & 1 == 1) {
                let (x, y) = (left + scale * column, top + scale * row);
                for y in (y - reach..y + scale + reach).filter(|y| (0..self.height).contains(y)) {
                    for x in (x - reach..x + scale + reach).filter(|x| (0..self.width).contains(x)) {
                        let at = 3 * (y * self.width + x) as usize;
                        self.rgb[at..at + 3].copy_from_slice(&colour);
                    }
                }
            }
        }
    }
}

/// The eight rows of a letter from the top; the lowest bit is the leftmost of eight pixels.
pub fn letter_rows(letter: char) -> [u8; 8] {
    let known = |letter| BASIC_FONTS.get(letter).or_else(|| LATIN_FONTS.get(letter));
    known(letter).or_else(|| known(UNKNOWN)).unwrap_or_default()
}
