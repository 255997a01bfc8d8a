//! Scales frames to the size of an observation.

/// Scales colours from one `[height, width]` to another: each pixel is the mean of the pixels that it covers.
pub(super) fn fit_rgb(
    from: &[u8],
    [height, width]: [usize; 2],
    [rows, columns]: [usize; 2],
    to: &mut Vec<u8>,
) {
    if (height, width) == (rows, columns) {
        to.clear();
        to.extend_from_slice(from);
        return;
    }
    to.clear();
    for row in 0..rows {
        let ys = covered(row, rows, height);
        for column in 0..columns {
            let xs = covered(column, columns, width);
            let mut sums = [0u32; 3];
            for y in ys.clone() {
                for x in xs.clone() {
                    let pixel = 3 * (y * width + x);
                    for (sum, value) in sums.iter_mut().zip(&from[pixel..pixel + 3]) {
                        *sum += u32::from(*value);
                    }
                }
            }
            let count = (ys.len() * xs.len()) as u32;
            to.extend(sums.map(|sum| ((sum + count / 2) / count) as u8));
        }
    }
}

/// Scales depths from one `[height, width]` to another: each pixel is the one nearest to its centre, since a mean of
/// two depths is the depth of neither.
pub(super) fn fit_depth(
    from: &[f32],
    [height, width]: [usize; 2],
    [rows, columns]: [usize; 2],
    to: &mut Vec<f32>,
) {
    to.clear();
    for row in 0..rows {
        let line = &from[width * ((2 * row + 1) * height / (2 * rows))..][..width];
        to.extend((0..columns).map(|column| line[(2 * column + 1) * width / (2 * columns)]));
    }
}

/// The range of `there` input pixels that output pixel `place` of `count` covers.
fn covered(place: usize, count: usize, there: usize) -> std::ops::Range<usize> {
    let first = place * there / count;
    first..((place + 1) * there / count).max(first + 1)
}
