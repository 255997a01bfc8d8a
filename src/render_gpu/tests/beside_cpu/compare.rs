//! How far two pictures are from each other.

use render::Picture;

/// Pixels about a pixel that must show the same object for it to count as interior.
const MARGIN: usize = 2;

/// Likeness of two pictures.
#[derive(Debug)]
pub struct Measures {
    /// Peak signal-to-noise ratio of the colours \[dB\].
    pub psnr: f64,
    /// Interior pixels that show different objects.
    pub other_inside: usize,
    /// Pixels that show different objects.
    pub other: usize,
    /// Share of pixels with a colour that differs by more than [`VISIBLE`].
    pub visible: f64,
    /// 99th percentile of the relative difference of depths, where both show the same.
    pub depth: f64,
}

impl Measures {
    /// Compares a picture with the expected one.
    pub fn of(expected: &Picture, found: &Picture) -> Self {
        let (a, b) = (expected, found);
        assert_eq!(
            [a.rgb.len(), a.depth.len(), a.segmentation.len()],
            [b.rgb.len(), b.depth.len(), b.segmentation.len()]
        );
        let other: Vec<usize> =
            (0..a.segmentation.len()).filter(|&k| a.segmentation[k] != b.segmentation[k]).collect();
        let same = (0..a.depth.len()).filter(|&k| a.segmentation[k] == b.segmentation[k]);
        let mut errors: Vec<f64> =
            same.map(|k| f64::from((a.depth[k] - b.depth[k]).abs()) / f64::from(a.depth[k])).collect();
        errors.sort_by(f64::total_cmp);
        Measures {
            visible: visible(&a.rgb, &b.rgb),
            psnr: psnr(&a.rgb, &b.rgb),
            other_inside: other.iter().filter(|&&k| is_interior(a, k)).count(),
            other: other.len(),
            depth: errors.get(errors.len() * 99 / 100).copied().unwrap_or(0.0),
        }
    }

    /// Holds the pictures to what two implementations of OpenGL reach beside each other.
    pub fn check(&self, what: &str) {
        let holds = self.psnr >= 45.0 && self.other_inside == 0 && self.depth <= 1e-4;
        assert!(holds, "{what}: {self:?}");
    }

    /// The same for small pictures, where one pixel at the edge of a shadow costs many decibels: one pixel in 500 may differ.
    pub fn check_small(&self, what: &str) {
        let holds = self.visible <= 0.002 && self.other_inside == 0 && self.depth <= 1e-4;
        assert!(holds, "{what}: {self:?}");
    }
}

/// Difference of colours that rounding does not explain.
const VISIBLE: u8 = 8;

fn visible(a: &[u8], b: &[u8]) -> f64 {
    let pairs = a.chunks_exact(3).zip(b.chunks_exact(3));
    let differs = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > VISIBLE);
    pairs.filter(differs).count() as f64 / (a.len() / 3).max(1) as f64
}

fn psnr(a: &[u8], b: &[u8]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum();
    if sum == 0.0 { f64::INFINITY } else { 10.0 * (255.0 * 255.0 * a.len() as f64 / sum).log10() }
}

fn is_interior(picture: &Picture, index: usize) -> bool {
    let (x, y) = (index % picture.width, index / picture.width);
    let clear = |at: usize, size: usize| (MARGIN..size.saturating_sub(MARGIN)).contains(&at);
    clear(x, picture.width)
        && clear(y, picture.height)
        && (y - MARGIN..=y + MARGIN).all(|y| {
            let first = y * picture.width + x - MARGIN;
            let row = &picture.segmentation[first..=first + 2 * MARGIN];
            row.iter().all(|id| *id == picture.segmentation[index])
        })
}
