//! How far a picture is from a recorded one.

use super::similarity::structural_similarity;
use std::collections::BTreeMap;

/// Decibels of equal pictures.
pub const EQUAL: f64 = 99.0;
/// Pixels about a pixel that must show the same object for it to count as interior.
const MARGIN: usize = 2;
/// Pixels that an object must have in the recorded picture for its overlap to be measured.
const LEAST_AREA: usize = 50;
/// Number and type of what is seen where there is nothing.
pub const BACKGROUND: [i32; 2] = [-1, -1];

/// Depth and segmentation of one view, row 0 at the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Number of columns.
    pub width: usize,
    /// Distance from the camera's plane \[m\].
    pub depth: Vec<f32>,
    /// Number and type of the object seen.
    pub ids: Vec<[i32; 2]>,
}

/// Likeness of colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colours {
    /// Peak signal-to-noise ratio over all bytes \[dB\], [`EQUAL`] at most.
    pub psnr: f64,
    /// The same over interior pixels.
    pub psnr_interior: f64,
    /// Structural similarity.
    pub ssim: f64,
}

/// Likeness of segmentation and depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shapes {
    /// Share of pixels that show the same object.
    pub ids: f64,
    /// The same over interior pixels.
    pub ids_interior: f64,
    /// Mean over objects of the recorded picture: pixels that show it in both, over pixels that show it in either.
    pub iou: f64,
    /// Median of the relative error of depth where both show the same object.
    pub depth_median: f64,
    /// Its 99th percentile.
    pub depth_p99: f64,
}

/// Compares colours, three bytes a pixel, with recorded ones; `interior` tells which pixels are.
pub fn compare_colours(recorded: &[u8], ours: &[u8], width: usize, interior: &[bool]) -> Colours {
    let whole = signal_to_noise(recorded.iter().zip(ours));
    let pixels =
        recorded.chunks_exact(3).zip(ours.chunks_exact(3)).zip(interior).filter(|(_, inside)| **inside);
    Colours {
        psnr: whole,
        psnr_interior: signal_to_noise(pixels.flat_map(|((a, b), _)| a.iter().zip(b))),
        ssim: structural_similarity(recorded, ours, width, 3),
    }
}

/// Peak signal-to-noise ratio of pairs of bytes \[dB\].
fn signal_to_noise<'a>(pairs: impl Iterator<Item = (&'a u8, &'a u8)>) -> f64 {
    let (mut sum, mut count) = (0_u64, 0_u64);
    for (a, b) in pairs {
        let difference = u64::from(a.abs_diff(*b));
        sum += difference * difference;
        count += 1;
    }
    if sum == 0 { EQUAL } else { (10.0 * (255.0 * 255.0 * count as f64 / sum as f64).log10()).min(EQUAL) }
}

/// Compares depth and segmentation with recorded ones.
pub fn compare_shapes(recorded: &Geometry, ours: &Geometry, interior: &[bool]) -> Shapes {
    let same: Vec<bool> = recorded.ids.iter().zip(&ours.ids).map(|(a, b)| a == b).collect();
    let inside: Vec<bool> =
        same.iter().zip(interior).filter(|(_, inside)| **inside).map(|(same, _)| *same).collect();
    let mut errors: Vec<f64> = (0..same.len())
        .filter(|&k| same[k] && recorded.ids[k] != BACKGROUND)
        .map(|k| {
            let [a, b] = [recorded, ours].map(|side| f64::from(side.depth[k]));
            (a - b).abs() / a.max(1e-9)
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    Shapes {
        ids: share(&same),
        ids_interior: share(&inside),
        iou: overlap(&recorded.ids, &ours.ids),
        depth_median: quantile(&errors, 0.5),
        depth_p99: quantile(&errors, 0.99),
    }
}

/// Pixels about which, in a square of `MARGIN` to each side, all show the same object.
pub fn interior(ids: &[[i32; 2]], width: usize) -> Vec<bool> {
    let height = ids.len() / width;
    let inside = |k: usize| {
        let (row, column) = (k / width, k % width);
        let clear = |place: usize, size: usize| (MARGIN..size.saturating_sub(MARGIN)).contains(&place);
        clear(row, height)
            && clear(column, width)
            && (row - MARGIN..=row + MARGIN).all(|row| {
                let from = row * width + column - MARGIN;
                ids[from..=from + 2 * MARGIN].iter().all(|id| *id == ids[k])
            })
    };
    (0..ids.len()).map(inside).collect()
}

/// Share of true values; 1 of none.
fn share(values: &[bool]) -> f64 {
    let count = values.iter().filter(|value| **value).count();
    if values.is_empty() { 1.0 } else { count as f64 / values.len() as f64 }
}

/// Mean overlap of the objects that the recorded picture shows; 1 of none.
fn overlap(recorded: &[[i32; 2]], ours: &[[i32; 2]]) -> f64 {
    // Of each object: pixels that show it in the recorded picture, in both, in either.
    let mut counts: BTreeMap<[i32; 2], [usize; 3]> = BTreeMap::new();
    for (a, b) in recorded.iter().zip(ours) {
        let same = usize::from(a == b);
        let [area, both, either] = counts.entry(*a).or_default();
        (*area, *both, *either) = (*area + 1, *both + same, *either + 1);
        if a != b {
            counts.entry(*b).or_default()[2] += 1;
        }
    }
    let quotients: Vec<f64> = counts
        .iter()
        .filter(|(object, [area, ..])| **object != BACKGROUND && *area >= LEAST_AREA)
        .map(|(_, [_, both, either])| *both as f64 / *either as f64)
        .collect();
    if quotients.is_empty() { 1.0 } else { quotients.iter().sum::<f64>() / quotients.len() as f64 }
}

/// The quantile of sorted values, interpolated between neighbours; 0 of none.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * sorted.len().saturating_sub(1) as f64;
    let (low, part) = (place.floor() as usize, place.fract());
    let Some(&first) = sorted.get(low) else { return 0.0 };
    let next = sorted.get(low + 1).copied().unwrap_or(first);
    first + part * (next - first)
}

/// Median of unsorted values; 0 of none.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    quantile(&sorted, 0.5)
}
