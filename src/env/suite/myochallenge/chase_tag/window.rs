//! Heights of the ground around the agent, as it looks ahead.

use super::terrain::{SIDE, sample};
use physics::math::ops;

/// Samples along each side of the window.
const WIDTH: usize = 10;
/// Samples on the near side of the agent, along each side.
const BEHIND: f64 = 4.0;
/// Samples of the grid in a unit of length, and the unit \[m\].
const PER_UNIT: f64 = 10.0;
const UNIT: f64 = 2.0;

/// Heights \[m\], row by row, of a grid that turns with a heading \[rad\] about a position \[m\]; the farthest corner comes first.
pub fn heights(ground: &[f32], [x, y]: [f64; 2], heading: f64) -> impl Iterator<Item = f64> + '_ {
    let (sine, cosine) = (ops::sin(heading), ops::cos(heading));
    (0..WIDTH * WIDTH).map(move |k| {
        let cell = WIDTH * WIDTH - 1 - k;
        // Columns of the window are rows of the grid.
        let place = |index: usize| (index as f64 - BEHIND) / PER_UNIT;
        let [aside, ahead] = [cell % WIDTH, cell / WIDTH].map(place);
        let row = sample((sine * ahead + cosine * aside) * UNIT + y);
        let column = sample((cosine * ahead - sine * aside) * UNIT + x);
        let [row, column] = [row, column].map(|place| place.clamp(0, SIDE as i16 - 2) as usize);
        f64::from(ground[row * SIDE + column])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bump_ahead_is_seen_ahead() {
        let mut ground = vec![0.0; SIDE * SIDE];
        // One metre along x from the middle.
        ground[50 * SIDE + 58] = 1.0;
        let seen: Vec<f64> = heights(&ground, [0.01, 0.01], 0.0).collect();
        assert_eq!(seen.iter().sum::<f64>(), 1.0);
        let place = seen.iter().position(|&height| height == 1.0).unwrap();
        assert_eq!([place / WIDTH, place % WIDTH], [0, 5]);
        // Turned to the left, the agent has the bump a metre to its right, where the window ends at 0.8 m.
        let turned: Vec<f64> = heights(&ground, [0.01, 0.01], std::f64::consts::FRAC_PI_2).collect();
        assert_eq!(turned.iter().sum::<f64>(), 0.0);
    }
}
