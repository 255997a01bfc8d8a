//! Structural similarity of pictures (Wang, Bovik, Sheikh & Simoncelli 2004), with a Gaussian window.

/// Standard deviation of the window in pixels.
const SIGMA: f64 = 1.5;
/// Pixels of the window to each side of its middle.
const RADIUS: usize = 5;
/// Constants that keep the two quotients finite, for values from 0 to 255.
const C: [f64; 2] = [(0.01 * 255.0) * (0.01 * 255.0), (0.03 * 255.0) * (0.03 * 255.0)];

/// Mean structural similarity of two pictures of `width` columns and `channels` interleaved channels: over the channels and all
/// pixels whose window lies within the picture. NaN for pictures smaller than the window.
pub fn structural_similarity(a: &[u8], b: &[u8], width: usize, channels: usize) -> f64 {
    let sum: f64 = (0..channels)
        .map(|c| channel_similarity(&plane(a, channels, c), &plane(b, channels, c), width))
        .sum();
    sum / channels as f64
}

/// One channel of an interleaved picture.
fn plane(picture: &[u8], channels: usize, channel: usize) -> Vec<f64> {
    picture.iter().skip(channel).step_by(channels).map(|&value| f64::from(value)).collect()
}

fn channel_similarity(a: &[f64], b: &[f64], width: usize) -> f64 {
    let product = |x: &[f64], y: &[f64]| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| x * y).collect() };
    let window = window();
    let [mean_a, mean_b] = [a, b].map(|plane| filter(plane, width, &window));
    let [aa, bb, ab] =
        [product(a, a), product(b, b), product(a, b)].map(|plane| filter(&plane, width, &window));
    let height = a.len() / width;
    let (mut sum, mut count) = (0.0, 0.0);
    for row in RADIUS..height.saturating_sub(RADIUS) {
        for column in RADIUS..width.saturating_sub(RADIUS) {
            let k = row * width + column;
            let (ma, mb) = (mean_a[k], mean_b[k]);
            let (va, vb, covariance) = (aa[k] - ma * ma, bb[k] - mb * mb, ab[k] - ma * mb);
            let likeness = (2.0 * ma * mb + C[0]) * (2.0 * covariance + C[1]);
            sum += likeness / ((ma * ma + mb * mb + C[0]) * (va + vb + C[1]));
            count += 1.0;
        }
    }
    sum / count
}

/// Weights of the window along one axis.
fn window() -> [f64; 2 * RADIUS + 1] {
    let weights: [f64; 2 * RADIUS + 1] = std::array::from_fn(|k| {
        let x = k as f64 - RADIUS as f64;
        (-0.5 * x * x / (SIGMA * SIGMA)).exp()
    });
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// Weighted means about every pixel whose window lies within the plane; other pixels are 0.
fn filter(plane: &[f64], width: usize, window: &[f64]) -> Vec<f64> {
    let height = plane.len() / width;
    let mut across = vec![0.0; plane.len()];
    for (out, row) in across.chunks_mut(width).zip(plane.chunks(width)) {
        for (k, values) in row.windows(window.len()).enumerate() {
            out[k + RADIUS] = values.iter().zip(window).map(|(value, weight)| value * weight).sum();
        }
    }
    let mut out = vec![0.0; plane.len()];
    for row in RADIUS..height.saturating_sub(RADIUS) {
        let sums = &mut out[row * width..(row + 1) * width];
        for (k, weight) in window.iter().enumerate() {
            let from = (row + k - RADIUS) * width;
            for (sum, value) in sums.iter_mut().zip(&across[from..from + width]) {
                *sum += weight * value;
            }
        }
    }
    out
}
