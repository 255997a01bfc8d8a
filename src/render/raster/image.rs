//! From samples to the arrays of a picture: rows from the top, colours averaged, depth in metres, objects by number.

use super::colour::paint::{Canvas, Rgba};
use super::draws::Draws;
use super::visibility::Visibility;
use super::window::coverage::{Extent, Pattern};
use crate::scene::Item;
use crate::view::Frustum;

/// Samples of a window.
pub struct Image<'a> {
    /// What is seen at them.
    pub visibility: &'a Visibility,
    /// Size of the window \[pixel\].
    pub extent: Extent,
}

impl Image<'_> {
    /// The groups of each row, from the top.
    fn rows(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let per_row = self.visibility.per_row;
        (0..self.extent.height as usize).rev().map(move |y| y * per_row..(y + 1) * per_row)
    }

    /// Calls `write` with the number of each pixel's triangle and its depth, for windows with one sample a pixel.
    fn pixels(&self, mut write: impl FnMut(u32, f32)) {
        for row in self.rows() {
            let samples = self.visibility.groups[row]
                .iter()
                .flat_map(|group| group.triangle.to_array().into_iter().zip(group.depth.to_array()));
            samples.take(self.extent.width as usize).for_each(|(number, depth)| write(number, depth));
        }
    }
}

/// Means of the samples of every pixel.
pub fn write_rgb(image: &Image<'_>, canvas: &Canvas, out: &mut Vec<u8>) {
    let width = image.extent.width as usize;
    for row in image.rows() {
        let groups = &canvas.groups[row];
        if image.visibility.pattern == Pattern::FOUR {
            let start = out.len();
            out.resize(start + 3 * width, 0);
            for (samples, pixel) in groups.iter().zip(out[start..].as_chunks_mut::<3>().0) {
                *pixel = mean(samples);
            }
        } else {
            groups.iter().flatten().take(width).for_each(|sample| out.extend_from_slice(&sample[..3]));
        }
    }
}

/// The mean of four samples, rounded half up. Sums of red and blue, and of green, share a number.
#[inline]
fn mean(samples: &[Rgba; 4]) -> [u8; 3] {
    const LOW: u32 = 0x00ff_00ff;
    const HALF: u32 = 0x0002_0002;
    let samples = samples.map(u32::from_le_bytes);
    let even: u32 = samples.iter().map(|sample| sample & LOW).sum();
    let odd: u32 = samples.iter().map(|sample| sample >> 8 & LOW).sum();
    let ([red, _, blue, _], [green, ..]) =
        (((even + HALF) >> 2).to_le_bytes(), ((odd + HALF) >> 2).to_le_bytes());
    [red, green, blue]
}

/// Distances from the eye's plane \[m\]; the far plane's where there is nothing.
pub fn write_depth(image: &Image<'_>, frustum: &Frustum, out: &mut Vec<f32>) {
    let (near, far) = (frustum.near, frustum.far);
    let (top, reach) = ((near * far) as f32, (far - near) as f32);
    image.pixels(|_, z| {
        out.push(if frustum.orthographic { far as f32 - z * reach } else { top / (near as f32 + z * reach) });
    });
}

/// Number and type of the object seen in every pixel; -1 and -1 where there is nothing.
pub fn write_segmentation(image: &Image<'_>, draws: &Draws, items: &[Item], out: &mut Vec<[i32; 2]>) {
    // Neighbours mostly show the same surface: the range of its triangles is kept.
    let mut last = (0..0, [-1; 2]);
    image.pixels(|number, _| {
        if number == 0 {
            return out.push([-1; 2]);
        }
        if !last.0.contains(&number) {
            let (item, numbers) = draws.item_of(number);
            let object = items[item].object;
            last = (numbers, [object.id, object.kind]);
        }
        out.push(last.1);
    });
}
