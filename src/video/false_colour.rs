//! Depth and segmentation as colours.

use crate::error::VideoError;
use crate::frame::{Image, check_length};

/// Colours of depth from near to far, evenly spaced; between them colours are interpolated linearly. Brightness falls with
/// distance throughout, so that a grey print of the picture can be read too.
pub const DEPTH_COLOURS: [[u8; 3]; 5] =
    [[255, 244, 176], [247, 167, 71], [206, 74, 84], [106, 37, 122], [18, 12, 61]];

/// Colour of a pixel without a distance.
pub const NO_DEPTH: [u8; 3] = [0, 0, 0];

/// Colour of a pixel that belongs to nothing.
pub const NO_SEGMENT: [u8; 3] = [0, 0, 0];

/// Depth in the colours [`DEPTH_COLOURS`].
///
/// `depth` has `width * height` distances \[m\], rows from the top. `near` and `far` \[m\] have the first and the last
/// colour; what is nearer or farther, infinity included, has them too. NaN and negative distances are [`NO_DEPTH`].
pub fn depth_image(
    width: u32,
    height: u32,
    depth: &[f32],
    (near, far): (f32, f32),
) -> Result<Image, VideoError> {
    check_length("depth", width, height, depth.len())?;
    if !(near.is_finite() && far.is_finite() && near < far) {
        return Err(VideoError::DepthRange { near, far });
    }
    let (near, far) = (f64::from(near), f64::from(far));
    let colour = |&distance: &f32| match distance >= 0.0 {
        true => depth_colour((f64::from(distance) - near) / (far - near)),
        false => NO_DEPTH,
    };
    Ok(Image::collect(width, height, depth.iter().map(colour)))
}

/// Segmentation in the colours of [`segment_colour`]; `ids` has `width * height` elements, rows from the top.
pub fn segmentation_image(width: u32, height: u32, ids: &[i32]) -> Result<Image, VideoError> {
    check_length("segmentation", width, height, ids.len())?;
    Ok(Image::collect(width, height, ids.iter().map(|&id| segment_colour(id))))
}

/// The colour of an id, the same in every picture; negative ids are [`NO_SEGMENT`].
///
/// The hue advances by the golden section of the circle, which keeps the hues of any run of ids apart, and value and
/// saturation change every id in a cycle of three.
pub fn segment_colour(id: i32) -> [u8; 3] {
    if id < 0 {
        return NO_SEGMENT;
    }
    // 2^32 divided by the golden ratio, to the nearest odd number: hues repeat after 2^32 ids only.
    const STEP: u32 = 2_654_435_769;
    let hue = (id as u32).wrapping_mul(STEP);
    let (saturation, value) = [(200, 255), (255, 190), (120, 235)][id as usize % 3];
    hue_colour(hue, saturation, value)
}

/// Share of the farthest distance beyond which colours of depth do not reach: there is the far plane, where nothing is.
const BACKGROUND: f32 = 0.99;
/// Share of the other pixels that are nearer than the last colour: an infinite floor would take all colours.
const NEAR_SHARE: f64 = 0.9;

/// Distances of a picture \[m\] for the first and the last colour: from the nearest to where nine tenths of what is seen are
/// nearer, as an infinite floor would take all colours; the far plane, where nothing is, has no part in it.
pub fn depth_range(depth: &[f32]) -> (f32, f32) {
    let mut sorted = depth.to_vec();
    sorted.sort_by(f32::total_cmp);
    let (near, farthest) = (sorted.first().copied().unwrap_or(0.0), sorted.last().copied().unwrap_or(0.0));
    let seen = sorted.partition_point(|&distance| distance < BACKGROUND * farthest);
    let far = sorted.get((NEAR_SHARE * seen as f64) as usize).copied().unwrap_or(farthest);
    (near, far.max(near.next_up()))
}

/// Objects of each type that have numbers of their own.
const TYPE: i32 = 1 << 20;

/// One number for an object and its type, negative for none, to be coloured by [`segmentation_image`].
pub fn object_number([object, kind]: [i32; 2]) -> i32 {
    if object < 0 { -1 } else { kind.wrapping_mul(TYPE).wrapping_add(object).max(0) }
}

/// The colour at a fraction of the way from near to far, clamped to 0..=1.
fn depth_colour(fraction: f64) -> [u8; 3] {
    let intervals = (DEPTH_COLOURS.len() - 1) as f64;
    let position = fraction.clamp(0.0, 1.0) * intervals;
    let first = (position as usize).min(DEPTH_COLOURS.len() - 2);
    let weight = position - first as f64;
    std::array::from_fn(|i| {
        let (a, b) = (f64::from(DEPTH_COLOURS[first][i]), f64::from(DEPTH_COLOURS[first + 1][i]));
        (a + (b - a) * weight).round() as u8
    })
}

/// A colour of the hexagonal cone; `hue` counts 2^-32 turns from red over green, `saturation` and `value` are 0..=255.
fn hue_colour(hue: u32, saturation: u32, value: u32) -> [u8; 3] {
    let position = u64::from(hue) * 6;
    let within = ((position & 0xFFFF_FFFF) >> 24) as u32;
    let shade = |part: u32| (value * (255 * 255 - saturation * part) / (255 * 255)) as u8;
    let (high, low) = (value as u8, shade(255));
    let (falling, rising) = (shade(within), shade(255 - within));
    match position >> 32 {
        0 => [high, rising, low],
        1 => [falling, high, low],
        2 => [low, high, rising],
        3 => [low, falling, high],
        4 => [rising, low, high],
        _ => [high, low, falling],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_near_each_other_differ_visibly() {
        let difference = |a: i32, b: i32| -> i32 {
            let (a, b) = (segment_colour(a), segment_colour(b));
            (0..3).map(|i| (i32::from(a[i]) - i32::from(b[i])).abs()).sum()
        };
        for id in -1..20_000 {
            for other in id + 1..=id + 4 {
                assert!(
                    difference(id, other) > 90,
                    "{id} {:?} {other} {:?}",
                    segment_colour(id),
                    segment_colour(other)
                );
            }
        }
        let first: std::collections::BTreeSet<_> = (0..500).map(segment_colour).collect();
        assert!(first.len() > 490, "{} colours of 500 ids", first.len());
    }

    #[test]
    fn brightness_falls_with_depth() {
        let brightness =
            |[r, g, b]: [u8; 3]| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
        let values: Vec<_> = (0..=100).map(|i| brightness(depth_colour(f64::from(i) / 100.0))).collect();
        assert!(values.windows(2).all(|pair| pair[1] < pair[0]), "{values:?}");
    }

    #[test]
    fn depth_outside_of_the_range_is_defined() {
        let depth = [0.0, 1.0, 2.0, f32::INFINITY, f32::NAN, -1.0];
        let image = depth_image(6, 1, &depth, (1.0, 2.0)).unwrap();
        let last = DEPTH_COLOURS[4];
        let expected = [DEPTH_COLOURS[0], DEPTH_COLOURS[0], last, last, NO_DEPTH, NO_DEPTH];
        assert_eq!(image.frame().rgb(), expected.as_flattened());
        assert!(matches!(depth_image(6, 1, &depth, (2.0, 2.0)), Err(VideoError::DepthRange { .. })));
        assert!(matches!(depth_image(6, 1, &depth, (f32::NAN, 2.0)), Err(VideoError::DepthRange { .. })));
        assert!(matches!(depth_image(5, 1, &depth, (1.0, 2.0)), Err(VideoError::Length { .. })));
    }

    #[test]
    fn a_picture_of_one_distance_has_a_range() {
        for depth in [vec![2.0_f32], vec![2.0; 10]] {
            let (near, far) = depth_range(&depth);
            assert!(near == 2.0 && far > near);
        }
        let mut depth: Vec<f32> = (10..20).map(|distance| distance as f32).collect();
        depth.extend([1000.0; 100]);
        assert_eq!(depth_range(&depth), (10.0, 19.0), "the sky has no part in it");
    }

    #[test]
    fn objects_of_different_types_differ() {
        assert_eq!(object_number([-1, -1]), -1);
        assert_ne!(object_number([4, 5]), object_number([4, 6]));
        assert_eq!(object_number([5, 5]) - object_number([4, 5]), 1);
    }
}
