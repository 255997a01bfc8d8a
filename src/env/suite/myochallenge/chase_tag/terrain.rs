//! Ground of nine patches: flat, hilly, rough, or a relief.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::terrain::formulas::{crest, noise, normalize};
use random::RandomState;
use robot::Keeper;
use std::f64::consts::PI;
use std::sync::Arc;

/// Samples along each side of the ground.
pub const SIDE: usize = 100;
/// Length of a side \[m\].
pub const LENGTH: f64 = 12.0;
/// Patches along each side.
const PATCHES: usize = 3;
/// Samples along each side of a patch; the last row and column of the ground belong to none.
pub(super) const PATCH: usize = SIDE / PATCHES;
/// Hilly patches at most.
const HILLY_AT_MOST: usize = 2;
/// Share of episodes with a relief.
const RELIEF_SHARE: f64 = 0.2;
/// Half waves of the hills.
const WAVES: f64 = 10.0;
/// How far rough ground lies below the flat one \[m\].
const ROUGH_OFFSET: f64 = 0.02;

/// Heights of a patch \[m\], row by row.
type Patch = [f64; PATCH * PATCH];

/// What a patch can be, in the original's order.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Flat,
    Hilly,
    Rough,
}

const KINDS: [Kind; 3] = [Kind::Flat, Kind::Hilly, Kind::Rough];

/// Largest heights of the patches \[m\].
#[derive(Clone, Copy, Debug)]
pub struct Heights {
    /// Of hills.
    pub hills: [f64; 2],
    /// Of rough ground.
    pub rough: [f64; 2],
    /// Of the relief.
    pub relief: [f64; 2],
}

/// The ground of an environment, which every episode has its own.
#[derive(Clone)]
pub struct Terrain {
    heights: Heights,
    /// The relief, from 0 to 1.
    relief: Arc<[f64]>,
    /// Where in the original the place of the relief comes from: a generator of its own.
    placing: Option<RandomState>,
    patch: Box<Patch>,
}

impl Terrain {
    /// Ground with this relief, an image of as many samples as a patch. With `placing`, the relief's place comes from there,
    /// otherwise from the environment's draws.
    ///
    /// # Errors
    /// The image has another size.
    pub(super) fn new(heights: Heights, image: &[f64], placing: Option<RandomState>) -> Result<Self, String> {
        if image.len() != PATCH * PATCH {
            return Err(format!(
                "the relief has {} samples, and {PATCH} times {PATCH} are needed",
                image.len()
            ));
        }
        let mut relief = image.to_vec();
        normalize(&mut relief);
        Ok(Terrain { heights, relief: relief.into(), placing, patch: Box::new([0.0; PATCH * PATCH]) })
    }

    /// Restarts the draws of the relief's place.
    pub fn seed(&mut self, seed: u64) {
        if let Some(placing) = &mut self.placing {
            // numpy's legacy generator takes seeds of 32 bits.
            *placing = RandomState::new(seed as u32);
        }
    }

    /// Writes or reads the draws of the relief's place.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        if let Some(placing) = &mut self.placing {
            keeper.random_state(placing);
        }
    }

    /// Draws the heights \[m\] of a ground.
    ///
    /// # Errors
    /// Heights that cannot be drawn from.
    pub fn draw(&mut self, ground: &mut [f32], rng: &mut Rng) -> Result<(), EnvError> {
        let mut hilly = 0;
        for place in 0..PATCHES * PATCHES {
            let mut kind = *rng.choose(&KINDS)?;
            while kind == Kind::Hilly && hilly >= HILLY_AT_MOST {
                kind = *rng.choose(&KINDS)?;
            }
            hilly += usize::from(kind == Kind::Hilly);
            match kind {
                Kind::Flat => self.patch.fill(0.0),
                Kind::Hilly => self.draw_hills(rng)?,
                Kind::Rough => self.draw_rough(rng)?,
            }
            write(ground, [place / PATCHES, place % PATCHES], &self.patch);
        }
        if rng.random() < RELIEF_SHARE {
            let mut place = [0; 2];
            match &mut self.placing {
                Some(random) => random.fill_randint(0..PATCHES as i64, &mut place)?,
                None => rng.fill_integers(0..PATCHES as i64, &mut place)?,
            }
            self.draw_relief(rng)?;
            write(ground, place.map(|k| k as usize), &self.patch);
        }
        Ok(())
    }

    fn draw_rough(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        noise(&mut self.patch[..], 1.0, rng)?;
        let height = rng.uniform(self.heights.rough[0], self.heights.rough[1])?;
        self.patch.iter_mut().for_each(|sample| *sample = *sample * height - ROUGH_OFFSET);
        Ok(())
    }

    fn draw_hills(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        let height = rng.uniform(self.heights.hills[0], self.heights.hills[1])?;
        let last = PATCH * PATCH - 1;
        let step = WAVES * PI / last as f64;
        for (k, sample) in self.patch.iter_mut().rev().enumerate() {
            let phase = if k == last { WAVES * PI } else { k as f64 * step };
            *sample = crest(phase) - 1.0;
        }
        normalize(&mut self.patch[..]);
        self.patch.iter_mut().for_each(|sample| *sample *= height);
        if rng.random() < 0.5 {
            let straight = *self.patch;
            for (k, sample) in self.patch.iter_mut().enumerate() {
                let [row, column] = [k / PATCH, k % PATCH];
                *sample = straight[column * PATCH + PATCH - 1 - row];
            }
        }
        Ok(())
    }

    fn draw_relief(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        let height = rng.uniform(self.heights.relief[0], self.heights.relief[1])?;
        for (row, image) in self.patch.chunks_mut(PATCH).zip(self.relief.chunks(PATCH).rev()) {
            row.iter_mut().zip(image).for_each(|(sample, image)| *sample = image * height);
        }
        Ok(())
    }
}

/// Makes the patch flat that a position \[m\] lies in.
pub fn flatten(ground: &mut [f32], [x, y]: [f64; 2]) {
    let patch = [y, x].map(|along| (sample(along) / PATCH as i16).clamp(0, PATCHES as i16 - 1) as usize);
    write(ground, patch, &[0.0; PATCH * PATCH]);
}

/// The sample at a position along one side \[m\]; the middle of the ground is at 0.
pub fn sample(along: f64) -> i16 {
    (along / (LENGTH / SIDE as f64) + SIDE as f64 / 2.0) as i16
}

fn write(ground: &mut [f32], [row, column]: [usize; 2], patch: &Patch) {
    for (k, samples) in patch.chunks(PATCH).enumerate() {
        let start = (row * PATCH + k) * SIDE + column * PATCH;
        ground[start..start + PATCH].iter_mut().zip(samples).for_each(|(to, &height)| *to = height as f32);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHTS: Heights = Heights { hills: [0.2, 0.2], rough: [0.1, 0.1], relief: [0.3, 0.3] };

    fn terrain() -> Terrain {
        let image: Vec<f64> = (0..PATCH * PATCH).map(|k| k as f64).collect();
        Terrain::new(HEIGHTS, &image, None).unwrap()
    }

    #[test]
    fn patches_have_the_heights_that_are_asked_for() {
        let (mut terrain, mut rng) = (terrain(), Rng::pcg64(2_u64));
        let range = |patch: &Patch| {
            let low = patch.iter().copied().fold(f64::INFINITY, f64::min);
            (low, patch.iter().copied().fold(f64::NEG_INFINITY, f64::max))
        };
        terrain.draw_hills(&mut rng).unwrap();
        let hills = range(&terrain.patch);
        terrain.draw_rough(&mut rng).unwrap();
        let rough = range(&terrain.patch);
        terrain.draw_relief(&mut rng).unwrap();
        assert_eq!(hills, (0.0, 0.2));
        assert!((rough.0 + 0.02).abs() < 1e-15 && (rough.1 - 0.08).abs() < 1e-15, "{rough:?}");
        assert_eq!(
            (terrain.patch[PATCH - 1 + (PATCH - 1) * PATCH] < 0.01, terrain.patch[PATCH - 1]),
            (true, 0.3)
        );
    }

    #[test]
    fn the_ground_under_the_agent_is_flat() {
        let mut ground = vec![1.0; SIDE * SIDE];
        flatten(&mut ground, [-5.0, 5.0]);
        assert_eq!(
            [ground[70 * SIDE], ground[98 * SIDE + 32], ground[65 * SIDE], ground[70 * SIDE + 33]],
            [0., 0., 1., 1.]
        );
    }

    #[test]
    fn a_relief_of_another_size_is_refused() {
        assert!(Terrain::new(HEIGHTS, &[0.0; 4], None).err().unwrap().contains("33 times 33"));
    }
}
