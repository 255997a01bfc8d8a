//! Noise whose power falls with the square of the frequency, as series of fixed length (Timmer and Koenig, "On generating power
//! law noise", Astronomy and Astrophysics 300, 1995).

use crate::draws::Rng;
use crate::error::EnvError;
use physics::math::ops;
use robot::Keeper;
use std::f64::consts::{SQRT_2, TAU};
use std::sync::LazyLock;

/// Numbers of a series: the product of both factors.
pub const LENGTH: usize = 2000;
const FACTORS: [usize; 2] = [40, 50];
/// Frequencies of a real series.
const HALF: usize = LENGTH / 2;
/// Series drawn together.
pub const SERIES: usize = 2;
/// Standard deviation of the numbers, were the series endless.
const SCALE: f64 = 10.0;

/// Powers of the `LENGTH`-th root of unity.
static ROOTS: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let angle = |k: usize| TAU * k as f64 / LENGTH as f64;
    (0..LENGTH).map(|k| [ops::cos(angle(k)), ops::sin(angle(k))]).collect()
});

/// Amplitude of each frequency; the lowest one's is also the constant part's.
static AMPLITUDES: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let step = 1.0 / LENGTH as f64;
    (0..=HALF).map(|k| 1.0 / (k.max(1) as f64 * step)).collect()
});

/// Two series of noise, read number by number; when they end, others follow.
#[derive(Clone, Debug)]
pub struct Noise {
    series: Vec<[f64; SERIES]>,
    next: usize,
    /// Real and imaginary parts of all frequencies.
    spectrum: Vec<[f64; 2]>,
    /// Sums over one factor of the length.
    partial: Vec<[f64; 2]>,
    /// Draws for each series: real parts, then imaginary parts.
    draws: Vec<f64>,
}

impl Noise {
    /// Draws the first series.
    ///
    /// # Errors
    /// None in practice: all amplitudes are finite.
    pub fn new(rng: &mut Rng) -> Result<Self, EnvError> {
        let mut noise = Noise {
            series: vec![[0.0; SERIES]; LENGTH],
            next: 0,
            spectrum: vec![[0.0; 2]; LENGTH],
            partial: vec![[0.0; 2]; LENGTH],
            draws: vec![0.0; 2 * SERIES * (HALF + 1)],
        };
        noise.redraw(rng)?;
        Ok(noise)
    }

    /// Draws other series: the real parts of both spectra, then the imaginary parts.
    ///
    /// # Errors
    /// As [`Noise::new`].
    pub fn redraw(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        for row in self.draws.chunks_mut(HALF + 1) {
            for (draw, amplitude) in row.iter_mut().zip(AMPLITUDES.iter()) {
                *draw = rng.normal(0.0, *amplitude)?;
            }
        }
        for series in 0..SERIES {
            self.set_spectrum(series);
            self.transform(series);
        }
        self.next = 0;
        Ok(())
    }

    /// Writes or reads the series and the place in it.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        self.series.iter_mut().for_each(|row| keeper.numbers(row));
        keeper.count(&mut self.next);
        self.next = self.next.min(LENGTH);
    }

    /// The next number of each series.
    ///
    /// # Errors
    /// As [`Noise::new`].
    pub fn sample(&mut self, rng: &mut Rng) -> Result<[f64; SERIES], EnvError> {
        if self.next == LENGTH {
            self.redraw(rng)?;
        }
        self.next += 1;
        Ok(self.series[self.next - 1].map(|value| SCALE * value))
    }

    /// The spectrum of a real series: the lowest and the highest frequency have no imaginary part.
    fn set_spectrum(&mut self, series: usize) {
        let row = |index: usize| &self.draws[index * (HALF + 1)..(index + 1) * (HALF + 1)];
        let (real, imaginary) = (row(series), row(SERIES + series));
        for k in 1..HALF {
            self.spectrum[k] = [real[k], imaginary[k]];
            self.spectrum[LENGTH - k] = [real[k], -imaginary[k]];
        }
        self.spectrum[0] = [real[0] * SQRT_2, 0.0];
        self.spectrum[HALF] = [real[HALF] * SQRT_2, 0.0];
    }

    /// The inverse Fourier transform, by sums over one factor of the length and then the other (Cooley and Tukey, 1965), scaled
    /// to unit variance.
    fn transform(&mut self, series: usize) {
        let [outer, inner] = FACTORS;
        for k in 0..outer {
            for t in 0..inner {
                let mut sum = [0.0; 2];
                for j in 0..inner {
                    add_product(&mut sum, self.spectrum[k + outer * j], ROOTS[outer * (j * t % inner)]);
                }
                let mut turned = [0.0; 2];
                add_product(&mut turned, sum, ROOTS[k * t]);
                self.partial[k * inner + t] = turned;
            }
        }
        let norm = LENGTH as f64 * deviation();
        for s in 0..outer {
            for t in 0..inner {
                let mut sum = [0.0; 2];
                for k in 0..outer {
                    add_product(&mut sum, self.partial[k * inner + t], ROOTS[inner * (k * s % outer)]);
                }
                self.series[inner * s + t][series] = sum[0] / norm;
            }
        }
    }
}

/// Standard deviation of a series of these amplitudes; the highest frequency counts half.
fn deviation() -> f64 {
    let square = |k: usize| {
        let amplitude = if k == HALF { 0.5 * AMPLITUDES[k] } else { AMPLITUDES[k] };
        amplitude * amplitude
    };
    2.0 * ops::sqrt((1..=HALF).map(square).sum()) / LENGTH as f64
}

fn add_product(sum: &mut [f64; 2], [a, b]: [f64; 2], [c, d]: [f64; 2]) {
    sum[0] += a * c - b * d;
    sum[1] += a * d + b * c;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_are_sums_over_all_frequencies() {
        let noise = Noise::new(&mut Rng::pcg64(3_u64)).unwrap();
        let norm = LENGTH as f64 * deviation();
        for t in [0, 1, 49, 50, 777, 1999] {
            // What is left is the spectrum of the last series.
            let term = |k: usize| {
                let [re, im] = noise.spectrum[k];
                let angle = TAU * (k * t % LENGTH) as f64 / LENGTH as f64;
                re * ops::cos(angle) - im * ops::sin(angle)
            };
            let direct = (0..LENGTH).map(term).sum::<f64>() / norm;
            let ours = noise.series[t][SERIES - 1];
            assert!((ours - direct).abs() < 1e-12, "{t}: {ours}, not {direct}");
        }
    }

    #[test]
    fn series_are_slow_and_follow_one_another() {
        let mut rng = Rng::pcg64(5_u64);
        let mut noise = Noise::new(&mut rng).unwrap();
        let first: Vec<_> = (0..LENGTH).map(|_| noise.sample(&mut rng).unwrap()[0]).collect();
        let rms = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
        let steps = rms(&mut first.windows(2).map(|pair| pair[1] - pair[0]));
        assert!(10.0 * steps < rms(&mut first.iter().copied()), "numbers differ little from the ones before");
        assert_ne!(noise.sample(&mut rng).unwrap()[0], first[0], "other series follow");
    }
}
