//! The five kinds of ground. Each writes heights \[m\] row by row; how far a place is beyond the flat patch, [`Terrain::beyond`] says.

use super::formulas::{hill, noise, normalize, ramp};
use super::settings::{Grid, Terrain};
use crate::draws::Rng;
use random::RandomError;
use std::f64::consts::TAU;

/// Distance between independent heights of rough ground \[m\].
const GRAIN: f64 = 0.12;
/// Over which ground goes over into the flat patch \[m\].
const BLEND: f64 = 0.5;
/// Waves of hilly ground, and the range of their lengths \[m\].
const WAVES: usize = 3;
const WAVE: [f64; 2] = [1.5, 4.0];
/// Steps up to a landing, and the ranges of the depth of a step and of a landing \[m\].
const STEPS: u32 = 5;
const TREAD: [f64; 2] = [0.25, 0.4];
const LANDING: [f64; 2] = [0.6, 1.2];
/// Obstacles in a square metre, the range of their half sizes \[m\], and the lowest as a share of the highest.
const DENSITY: f64 = 0.6;
const HALF: [f64; 2] = [0.05, 0.25];
const LOWEST: f64 = 0.3;
/// Ranges of the ground between two gaps and of a gap \[m\].
const GROUND: [f64; 2] = [0.6, 1.2];
const GAP: [f64; 2] = [0.15, 0.4];

/// Uneven ground: noise at points [`GRAIN`] apart, bilinear between them.
pub(super) fn rough(
    terrain: &Terrain,
    grid: &Grid,
    heights: &mut [f64],
    rng: &mut Rng,
) -> Result<(), RandomError> {
    // As many points as it takes, but no more than the grid has.
    let points = |half: f64, count: usize| ((2.0 * half / GRAIN).ceil() as usize + 1).min(count).max(2);
    let [across, along] = [points(grid.half[0], grid.columns), points(grid.half[1], grid.rows)];
    let mut values = vec![0.0; across * along];
    noise(&mut values, 1.0, rng)?;
    for (height, place) in heights.iter_mut().zip(grid.places()) {
        let share = |axis: usize, count: usize| {
            let at = (place[axis] / grid.half[axis] + 1.0) / 2.0 * (count - 1) as f64;
            let low = (at as usize).min(count - 2);
            (low, at - low as f64)
        };
        let ((column, u), (row, v)) = (share(0, across), share(1, along));
        let value = |row: usize, column: usize| values[row * across + column];
        let [near, far] =
            [row, row + 1].map(|row| (1.0 - u) * value(row, column) + u * value(row, column + 1));
        *height = blended(terrain, place, (1.0 - v) * near + v * far);
    }
    Ok(())
}

/// Hills: waves of several lengths in several directions.
pub(super) fn hilly(
    terrain: &Terrain,
    grid: &Grid,
    heights: &mut [f64],
    rng: &mut Rng,
) -> Result<(), RandomError> {
    let mut waves = [[0.0; 3]; WAVES];
    for wave in &mut waves {
        let (sine, cosine) = physics::math::ops::sincos(rng.uniform(0.0, TAU)?);
        let number = TAU / rng.uniform(WAVE[0], WAVE[1])?;
        *wave = [number * cosine, number * sine, rng.uniform(0.0, TAU)?];
    }
    for (height, [x, y]) in heights.iter_mut().zip(grid.places()) {
        *height = waves.iter().map(|[along_x, along_y, phase]| hill(along_x * x + along_y * y + phase)).sum();
    }
    normalize(heights);
    for (height, place) in heights.iter_mut().zip(grid.places()) {
        *height = blended(terrain, place, *height);
    }
    Ok(())
}

/// A share of the height, which becomes one half towards the flat patch.
fn blended(terrain: &Terrain, place: [f64; 2], share: f64) -> f64 {
    terrain.height * (0.5 + ramp(terrain.beyond(place) / BLEND) * (share - 0.5))
}

/// Stairs along x, away from the flat patch on both sides: up to a landing, down again, and so on.
pub(super) fn stairs(
    terrain: &Terrain,
    grid: &Grid,
    heights: &mut [f64],
    rng: &mut Rng,
) -> Result<(), RandomError> {
    let [tread, landing] = [rng.uniform(TREAD[0], TREAD[1])?, rng.uniform(LANDING[0], LANDING[1])?];
    let flight = f64::from(STEPS - 1) * tread;
    for (height, [x, _]) in heights.iter_mut().zip(grid.places()) {
        let beyond = x.abs() - terrain.flat;
        let at = beyond.rem_euclid(2.0 * (flight + landing));
        // On the way down the same, seen from the other end.
        let up = at.min(2.0 * flight + landing - at);
        let step = (up / tread).floor().clamp(-1.0, f64::from(STEPS - 1)) + 1.0;
        *height = if beyond <= 0.0 { 0.0 } else { terrain.height * step / f64::from(STEPS) };
    }
    Ok(())
}

/// Boxes that lie about.
pub(super) fn obstacles(
    terrain: &Terrain,
    grid: &Grid,
    heights: &mut [f64],
    rng: &mut Rng,
) -> Result<(), RandomError> {
    let count = (DENSITY * 4.0 * grid.half[0] * grid.half[1]).min(heights.len() as f64) as usize;
    for _ in 0..count {
        let mut range = [[0; 2]; 2];
        for (axis, range) in range.iter_mut().enumerate() {
            let middle = rng.uniform(-grid.half[axis], grid.half[axis])?;
            let half = rng.uniform(HALF[0], HALF[1])?;
            *range = grid.cells(axis, [middle - half, middle + half]);
        }
        let top = terrain.height * rng.uniform(LOWEST, 1.0)?;
        for row in range[1][0]..range[1][1] {
            for height in &mut heights[row * grid.columns..][range[0][0]..range[0][1]] {
                *height = height.max(top);
            }
        }
    }
    for (height, place) in heights.iter_mut().zip(grid.places()) {
        if terrain.beyond(place) <= 0.0 {
            *height = 0.0;
        }
    }
    Ok(())
}

/// Gaps across x on both sides of the flat patch.
pub(super) fn gaps(
    terrain: &Terrain,
    grid: &Grid,
    heights: &mut [f64],
    rng: &mut Rng,
) -> Result<(), RandomError> {
    heights.fill(terrain.height);
    for side in [-1.0, 1.0] {
        let mut at = terrain.flat;
        // No more gaps than the grid can show.
        for _ in 0..grid.columns {
            let start = at + rng.uniform(GROUND[0], GROUND[1])?;
            at = start + rng.uniform(GAP[0], GAP[1])?;
            let [from, to] = if side < 0.0 { [-at, -start] } else { [start, at] };
            let [first, end] = grid.cells(0, [from, to]);
            for row in heights.chunks_mut(grid.columns) {
                row[first..end].fill(0.0);
            }
            if at > grid.half[0] {
                break;
            }
        }
    }
    Ok(())
}
