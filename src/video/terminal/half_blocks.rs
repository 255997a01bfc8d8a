//! Two pixels in each cell: the upper half block in the colour of the upper one, on the colour of the lower one.

use std::fmt::Write;

use crate::frame::Frame;

/// Six steps of each channel in the cube of indexed colours, from index 16.
const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// First index and number of the greys after the cube, 8, 18, ..., 238.
const GREYS: (u8, u8) = (232, 24);

/// The text of a frame; `direct` has 24-bit colours, else indexed ones. A colour is named where it changes.
pub(super) fn text(frame: &Frame<'_>, direct: bool) -> String {
    let mut text = String::new();
    for y in (0..frame.height()).step_by(2) {
        let above = frame.row(y).as_chunks::<3>().0;
        let below = (y + 1 < frame.height()).then(|| frame.row(y + 1).as_chunks::<3>().0);
        let mut last = (None, None);
        for x in 0..above.len() {
            let colours = (Some(above[x]), below.map(|row| row[x]));
            if colours.0 != last.0 {
                colour(&mut text, 38, above[x], direct);
            }
            if let Some(lower) = colours.1.filter(|_| colours.1 != last.1) {
                colour(&mut text, 48, lower, direct);
            }
            last = colours;
            text.push('▀');
        }
        text.push_str("\x1b[0m\n");
    }
    text
}

/// Selects a colour; 38 is the text, 48 what is behind it (ECMA-48, ITU-T T.416).
fn colour(text: &mut String, target: u8, rgb: [u8; 3], direct: bool) {
    let [r, g, b] = rgb;
    match direct {
        true => write!(text, "\x1b[{target};2;{r};{g};{b}m"),
        false => write!(text, "\x1b[{target};5;{}m", nearest(rgb)),
    }
    .expect("a text takes everything");
}

/// The nearest of the indexed colours 16 to 255; the first 16 differ from terminal to terminal.
fn nearest(rgb: [u8; 3]) -> u8 {
    let step = |channel: u8| (0..6).min_by_key(|&i| CUBE[i].abs_diff(channel)).unwrap_or(0);
    let steps = rgb.map(step);
    let cube = steps.map(|step| CUBE[step]);
    let mean = rgb.iter().map(|&channel| u32::from(channel)).sum::<u32>() / 3;
    let grey_step = ((mean.saturating_sub(3)) / 10).min(u32::from(GREYS.1) - 1) as u8;
    let grey = [8 + 10 * grey_step; 3];
    match distance(rgb, grey) < distance(rgb, cube) {
        true => GREYS.0 + grey_step,
        false => (16 + 36 * steps[0] + 6 * steps[1] + steps[2]) as u8,
    }
}

fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    a.iter().zip(b).map(|(&a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_has_two_pixels_and_colours_are_named_once() {
        let pixels = [[1, 2, 3], [1, 2, 3], [4, 5, 6], [7, 8, 9], [10, 11, 12], [10, 11, 12]];
        let frame = Frame::new(2, 3, pixels.as_flattened()).unwrap();
        let expected =
            "\x1b[38;2;1;2;3m\x1b[48;2;4;5;6m▀\x1b[48;2;7;8;9m▀\x1b[0m\n\x1b[38;2;10;11;12m▀▀\x1b[0m\n";
        assert_eq!(text(&frame, true), expected);
        assert!(text(&frame, false).starts_with("\x1b[38;5;16m"));
    }

    #[test]
    fn indexed_colours_are_the_nearest() {
        assert_eq!(nearest([0, 0, 0]), 16);
        assert_eq!(nearest([255, 255, 255]), 231);
        assert_eq!(nearest([255, 0, 0]), 196);
        assert_eq!(nearest([8, 8, 8]), 232);
        assert_eq!(nearest([238, 238, 238]), 255);
        assert_eq!(nearest([95, 135, 175]), 67);
    }
}
