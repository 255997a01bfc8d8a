//! Two-dimensional textures, repeated in both directions.

use super::halving::Halving;
use super::lerp::{lerp, lerp_f32, unpack};
use super::level_image::LevelImage;
use super::lod;
use super::source::Image;
use super::srgb::linear;

/// The mip chain of an image. Behind every row and below the last one the first pixels follow once more, so that two
/// neighbours are always adjacent.
#[derive(Clone, Debug)]
pub(super) struct FlatMap {
    levels: Vec<Level>,
    texels: Vec<u32>,
    srgb: bool,
}

/// One level of a mip chain.
#[derive(Clone, Copy, Debug)]
struct Level {
    width: u32,
    height: u32,
    /// First of its texels.
    start: u32,
}

impl Level {
    /// How many texels it takes, with those that follow once more.
    fn texels(&self) -> usize {
        (self.width as usize + 1) * (self.height as usize + 1)
    }

    /// Computes its texels from the next finer level.
    fn fill(&self, texels: &mut [u32], finer: Level, source: &[u32], srgb: bool) {
        let [width, height] = [self.width as usize, self.height as usize];
        let from = [finer.width as usize, finer.height as usize];
        let (stride, source_stride) = (width + 1, from[0] + 1);
        let half = Halving::new(from, [width, height], srgb);
        for y in 0..height {
            let line = &mut texels[y * stride..(y + 1) * stride];
            half.row(y, |y| &source[y * source_stride..y * source_stride + from[0]], &mut line[..width]);
            line[width] = line[0];
        }
        texels.copy_within(..stride, height * stride);
    }
}

/// The levels of an image, down to a single pixel.
fn chain(width: usize, height: usize) -> Vec<Level> {
    let mut levels = vec![Level { width: width as u32, height: height as u32, start: 0 }];
    while let &[.., level] = &levels[..]
        && level.width * level.height > 1
    {
        let start = level.start + level.texels() as u32;
        levels.push(Level { width: (level.width / 2).max(1), height: (level.height / 2).max(1), start });
    }
    levels
}

/// Four neighbouring texels, and the weights of the right and the lower ones in 1/256.
#[derive(Clone, Copy)]
struct Taps {
    texels: [u32; 4],
    weights: [u32; 2],
}

impl FlatMap {
    pub fn new(image: &Image, srgb: bool) -> Self {
        let levels = chain(image.width, image.height);
        let mut texels = vec![0; levels.iter().map(Level::texels).sum()];
        for (row, line) in texels[..levels[0].texels()].chunks_exact_mut(image.width + 1).enumerate() {
            image.write_row(row % image.height, &mut line[..image.width]);
            line[image.width] = line[0];
        }
        for pair in levels.windows(2) {
            let (finer, coarser) = texels.split_at_mut(pair[1].start as usize);
            pair[1].fill(coarser, pair[0], &finer[pair[0].start as usize..], srgb);
        }
        FlatMap { levels, texels, srgb }
    }

    pub fn is_srgb(&self) -> bool {
        self.srgb
    }

    pub fn images(&self) -> impl Iterator<Item = LevelImage<'_>> {
        self.levels.iter().enumerate().map(|(level, &Level { width, height, start })| LevelImage {
            level,
            face: 0,
            width: width as usize,
            height: height as usize,
            stride: width as usize + 1,
            pixels: &self.texels[start as usize..],
        })
    }

    pub fn bytes(&self) -> usize {
        std::mem::size_of_val(&self.texels[..])
    }

    #[inline]
    pub fn lod(&self, dx: [f32; 2], dy: [f32; 2]) -> f32 {
        let size = [self.levels[0].width as f32, self.levels[0].height as f32];
        lod::of_footprint([dx[0] * size[0], dx[1] * size[1]], [dy[0] * size[0], dy[1] * size[1]])
    }

    #[inline]
    pub fn sample(&self, s: f32, t: f32, lod: f32) -> [f32; 4] {
        let (level, weight) = lod::split(lod, self.levels.len() - 1);
        let [s, t] = [fraction(s), fraction(t)];
        if self.srgb {
            let fine = self.bilinear_srgb(level, s, t);
            if weight == 0.0 {
                return fine;
            }
            return lerp_f32(fine, self.bilinear_srgb(level + 1, s, t), weight);
        }
        let fine = self.bilinear(level, s, t);
        let weight = (weight * 256.0) as u32;
        if weight == 0 {
            return unpack(fine);
        }
        unpack(lerp(fine, self.bilinear(level + 1, s, t), weight))
    }

    #[inline]
    fn bilinear(&self, level: usize, s: f32, t: f32) -> u32 {
        let Taps { texels: [a, b, c, d], weights: [x, y] } = self.taps(level, s, t);
        lerp(lerp(a, b, x), lerp(c, d, x), y)
    }

    fn bilinear_srgb(&self, level: usize, s: f32, t: f32) -> [f32; 4] {
        let Level { width, height, .. } = self.levels[level];
        let taps = self.taps(level, s, t);
        let [a, b, c, d] = taps.texels.map(linear);
        // The weights before they were rounded to 1/256; the texels are those that the rounded ones belong to.
        let exact = |place: f32, weight: u32| {
            let weight = weight as f32 * (1.0 / 256.0);
            let difference = place - 0.5 - weight;
            weight + (difference - round(difference))
        };
        let x = exact(s * width as f32, taps.weights[0]);
        let y = exact(t * height as f32, taps.weights[1]);
        lerp_f32(lerp_f32(a, b, x), lerp_f32(c, d, x), y)
    }

    /// What a bilinear filter reads at coordinates from 0 to 1.
    #[inline]
    fn taps(&self, level: usize, s: f32, t: f32) -> Taps {
        let Level { width, height, start } = self.levels[level];
        let (x, weight_x) = tap(s, width);
        let (y, weight_y) = tap(t, height);
        let stride = width as usize + 1;
        let corner = start as usize + y as usize * stride + x as usize;
        let texels = &self.texels[corner..corner + stride + 2];
        Taps {
            texels: [texels[0], texels[1], texels[stride], texels[stride + 1]],
            weights: [weight_x, weight_y],
        }
    }
}

/// 1.5 * 2^23: adding it to a number rounds that to an integer, ties to even.
const ROUND: f32 = 12_582_912.0;

#[inline]
fn round(x: f32) -> f32 {
    (x + ROUND) - ROUND
}

/// `x - floor(x)`.
#[inline]
fn fraction(x: f32) -> f32 {
    let rest = x - round(x);
    if rest < 0.0 { rest + 1.0 } else { rest }
}

/// The texel whose centre is at or before a coordinate from 0 to 1, and the weight of the next in 1/256.
#[inline]
fn tap(coordinate: f32, length: u32) -> (u32, u32) {
    // The comparison also replaces a coordinate that is not a number.
    let coordinate = if (0.0..=1.0).contains(&coordinate) { coordinate } else { 0.0 };
    let place = (coordinate * length as f32 * 256.0 + ROUND).to_bits() - ROUND.to_bits();
    let place = if place < 128 { place + length * 256 - 128 } else { place - 128 };
    (place >> 8, place & 255)
}
