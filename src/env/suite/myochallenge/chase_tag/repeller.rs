//! Running away from the agent and from walls, as if all of them repelled.

use super::noise::Noise;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use physics::math::ops;
use std::f64::consts::TAU;

/// What is farther away does not repel \[m\].
const INFLUENCE: f64 = 3.5;
/// Strength of the repulsion.
const STRENGTH: f64 = 20.0;
/// Distance of the walls from the middle \[m\], and points on each.
const WALL: f64 = 8.7;
const POINTS: usize = 25;
/// Below this distance, along x or along y, repulsion gives no direction \[m\].
const BALANCED: f64 = 0.1;
/// Heading of a body that moves along x \[rad\], rounded as in the original.
const QUARTER: f64 = 1.57;

/// Forward speed \[m/s\] and turn \[rad/s\] of a body at a position \[m\] and heading \[rad\].
///
/// # Errors
/// None in practice: all ranges are finite.
pub fn escape(
    [x, y, heading]: [f64; 3],
    agent: [f64; 2],
    [slowest, fastest]: [f64; 2],
    noise: &mut Noise,
    rng: &mut Rng,
) -> Result<[f64; 2], EnvError> {
    let (mut count, mut force, mut center) = (0.0, 0.0, [0.0; 2]);
    for obstacle in std::iter::once(agent).chain(walls()) {
        let distance = norm(&[obstacle[0] - x, obstacle[1] - y]);
        if distance < INFLUENCE {
            count += 1.0;
            let excess = 1.0 / distance.max(1e-5) - 1.0 / INFLUENCE;
            force += 0.5 * STRENGTH * excess * excess;
            center = [center[0] + obstacle[0], center[1] + obstacle[1]];
        }
    }
    if count == 0.0 {
        let [speed, direction] = noise.sample(rng)?;
        return Ok([speed.clamp(slowest, fastest), turn_towards(heading, direction)]);
    }
    let mut away = [x - center[0] / count, y - center[1] / count];
    for along in &mut away {
        if along.abs() <= BALANCED {
            let sign = if *along == 0.0 { 0.0 } else { along.signum() };
            *along = -sign * rng.uniform(0.3, 0.9)?;
        }
    }
    let direction = ops::atan2(away[1], away[0]) + QUARTER;
    Ok([(force / count).clamp(slowest, fastest), turn_towards(heading, direction)])
}

/// Points on the four walls.
fn walls() -> impl Iterator<Item = [f64; 2]> {
    let along =
        |k: usize| if k + 1 == POINTS { WALL } else { k as f64 * (2.0 * WALL / (POINTS - 1) as f64) - WALL };
    let sides = [[WALL, 0.0], [-WALL, 0.0], [0.0, WALL], [0.0, -WALL]];
    sides.into_iter().flat_map(move |[x, y]| {
        (0..POINTS).map(move |k| if x == 0.0 { [along(k), y] } else { [x, along(k)] })
    })
}

/// A turn of 1 rad/s, against the clock where the wanted direction is the larger angle from 0 to 2π.
fn turn_towards(heading: f64, direction: f64) -> f64 {
    if once_around(heading) < once_around(direction) { 1.0 } else { -1.0 }
}

/// The same angle from 0 to 2π.
fn once_around(angle: f64) -> f64 {
    if (0.0..=TAU).contains(&angle) { angle } else { angle.rem_euclid(TAU) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_runs_from_an_agent_nearby() {
        let mut rng = Rng::pcg64(1_u64);
        let mut noise = Noise::new(&mut rng).unwrap();
        let mut escape = |agent| escape([0.0; 3], agent, [0.3, 1.0], &mut noise, &mut rng).unwrap();
        let force = 10.0 * (1.0 / 3.25_f64.sqrt() - 1.0 / 3.5).powi(2);
        assert!((escape([1.5, 1.0])[0] - force).abs() < 1e-15);
        assert_eq!(escape([0.2, 0.5])[0], 1.0, "the closer the agent, the faster");
        assert_eq!(escape([3.0, 1.0])[0], 0.3, "never slower than the slowest");
    }

    #[test]
    fn walls_have_four_sides() {
        let points: Vec<_> = walls().collect();
        assert_eq!(points.len(), 4 * POINTS);
        assert!(points.iter().all(|point| point[0].abs() == WALL || point[1].abs() == WALL));
        assert_eq!((points[0], points[24], points[50]), ([WALL, -WALL], [WALL, WALL], [-WALL, WALL]));
    }

    #[test]
    fn angles_go_once_around() {
        assert!(
            (once_around(-0.5) - (TAU - 0.5)).abs() < 1e-15 && (once_around(7.0) - (7.0 - TAU)).abs() < 1e-15
        );
        assert_eq!((once_around(0.0), once_around(TAU)), (0.0, TAU));
    }
}
