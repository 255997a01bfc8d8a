//! Computed textures: gradients, checkers, flat colours and the marks on them (MuJoCo XML reference,
//! `asset/texture/builtin` and `mark`).

use super::source::{Builtin, Mark, TextureSource};

const DOWN: usize = 3;
/// Faces a checker shows with its colours exchanged: front and back.
const FRONT: usize = 4;

fn byte_color(rgb: [f64; 3]) -> [u8; 3] {
    rgb.map(|x| (255.0 * x) as u8)
}

fn put(image: &mut [u8], pixel: usize, color: [u8; 3]) {
    image[3 * pixel..3 * pixel + 3].copy_from_slice(&color);
}

/// A single image of `width` by `height` pixels.
pub(super) fn paint_flat_image(source: &TextureSource, width: usize, height: usize, image: &mut [u8]) {
    match source.builtin {
        Builtin::None => {}
        Builtin::Gradient => {
            for row in 0..height {
                for column in 0..width {
                    let x = (2 * column) as f64 / (width as f64 - 1.0) - 1.0;
                    let y = 1.0 - (2 * row) as f64 / (height as f64 - 1.0);
                    let radius = 2.0 * (x * x + y * y).sqrt() - 1.0;
                    put(image, row * width + column, blend(source.rgb2, source.rgb1, radius));
                }
            }
        }
        Builtin::Checker => checker(image, byte_color(source.rgb1), byte_color(source.rgb2), width, height),
        Builtin::Flat => fill(image, byte_color(source.rgb1)),
    }
    mark(source, image, width, height);
    if source.mark == Mark::Random {
        random_dots(source, image);
    }
}

/// Six square faces of `width` pixels: right, left, up, down, front, back.
pub(super) fn paint_cube(source: &TextureSource, width: usize, image: &mut [u8]) {
    let (first, second) = (byte_color(source.rgb1), byte_color(source.rgb2));
    let size = 3 * width * width;
    match source.builtin {
        Builtin::None => {}
        Builtin::Gradient => cube_gradient(source, width, image),
        Builtin::Checker => {
            for (face, pixels) in image.chunks_exact_mut(size).enumerate() {
                let (a, b) = if face < FRONT { (first, second) } else { (second, first) };
                checker(pixels, a, b, width, width);
            }
        }
        Builtin::Flat => {
            for (face, pixels) in image.chunks_exact_mut(size).enumerate() {
                fill(pixels, if face == DOWN { second } else { first });
            }
        }
    }
    image.chunks_exact_mut(size).for_each(|face| mark(source, face, width, width));
    if source.mark == Mark::Random {
        random_dots(source, image);
    }
}

/// Colour by elevation above the horizon.
fn cube_gradient(source: &TextureSource, width: usize, image: &mut [u8]) {
    const QUARTER: f64 = 0.5 * std::f64::consts::PI;
    let face = width * width;
    for row in 0..width {
        for column in 0..width {
            let x = (2 * column) as f64 / (width as f64 - 1.0) - 1.0;
            let y = 1.0 - (2 * row) as f64 / (width as f64 - 1.0);
            let distance = (1.0 + x * x + y * y).sqrt();
            let side = physics::math::ops::asin(y / distance) / QUARTER;
            let up = 1.0 - physics::math::ops::acos(1.0 / distance) / QUARTER;
            let pixel = row * width + column;
            for horizontal in [0, 1, 4, 5] {
                put(image, horizontal * face + pixel, blend(source.rgb1, source.rgb2, side));
            }
            put(image, 2 * face + pixel, blend(source.rgb1, source.rgb2, up));
            put(image, DOWN * face + pixel, blend(source.rgb1, source.rgb2, -up));
        }
    }
}

/// `a` at position 1, `b` at -1, along a sigmoid.
fn blend(a: [f64; 3], b: [f64; 3], position: f64) -> [u8; 3] {
    let end = 1.0 / 2.0f64.sqrt();
    let alpha = 0.5 * (1.0 + position / (1.0 + position * position).sqrt() / end);
    let alpha = alpha.clamp(0.0, 1.0);
    std::array::from_fn(|k| (255.0 * (alpha * a[k] + (1.0 - alpha) * b[k])) as u8)
}

fn fill(image: &mut [u8], color: [u8; 3]) {
    image.chunks_exact_mut(3).for_each(|p| p.copy_from_slice(&color));
}

fn checker(image: &mut [u8], a: [u8; 3], b: [u8; 3], width: usize, height: usize) {
    for row in 0..height {
        for column in 0..width {
            let same = (row < height / 2) == (column < width / 2);
            put(image, row * width + column, if same { a } else { b });
        }
    }
}

fn mark(source: &TextureSource, image: &mut [u8], width: usize, height: usize) {
    let color = byte_color(source.markrgb);
    let (rows, columns) = match source.mark {
        Mark::None | Mark::Random => return,
        Mark::Edge => (vec![0, height - 1], vec![0, width - 1]),
        Mark::Cross => (vec![height / 2], vec![width / 2]),
    };
    for row in 0..height {
        columns.iter().for_each(|column| put(image, row * width + column, color));
    }
    for row in rows {
        (0..width).for_each(|column| put(image, row * width + column, color));
    }
}

/// Dots at pixels where a uniform number is below the probability.
fn random_dots(source: &TextureSource, image: &mut [u8]) {
    let color = byte_color(source.markrgb);
    let mut generator = MersenneTwister64::new(42);
    for pixel in image.chunks_exact_mut(3) {
        // 53 of 64 bits, as a uniform distribution over doubles takes them.
        let uniform = generator.next() as f64 / 18446744073709551616.0;
        if uniform < source.random {
            pixel.copy_from_slice(&color);
        }
    }
}

/// MT19937-64 (Nishimura 2000, "Tables of 64-bit Mersenne twisters").
struct MersenneTwister64 {
    state: [u64; Self::N],
    at: usize,
}

impl MersenneTwister64 {
    const N: usize = 312;
    const M: usize = 156;

    fn new(seed: u64) -> Self {
        let mut state = [seed; Self::N];
        for k in 1..Self::N {
            let previous = state[k - 1];
            state[k] =
                6364136223846793005u64.wrapping_mul(previous ^ (previous >> 62)).wrapping_add(k as u64);
        }
        Self { state, at: Self::N }
    }

    fn next(&mut self) -> u64 {
        if self.at == Self::N {
            self.refill();
        }
        let mut x = self.state[self.at];
        self.at += 1;
        x ^= (x >> 29) & 0x5555555555555555;
        x ^= (x << 17) & 0x71D67FFFEDA60000;
        x ^= (x << 37) & 0xFFF7EEE000000000;
        x ^ (x >> 43)
    }

    fn refill(&mut self) {
        const LOWER: u64 = 0x7FFFFFFF;
        for k in 0..Self::N {
            let x = (self.state[k] & !LOWER) | (self.state[(k + 1) % Self::N] & LOWER);
            let twist = if x & 1 == 1 { 0xB5026F5AA96619E9 } else { 0 };
            self.state[k] = self.state[(k + Self::M) % Self::N] ^ (x >> 1) ^ twist;
        }
        self.at = 0;
    }
}
