//! Closed lines in the plane.

use physics::math::ops::{pow, sincos};
use std::f64::consts::TAU;

/// A closed line in the plane, counter-clockwise, without a second copy of its first point \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct Profile(Vec<[f64; 2]>);

impl Profile {
    /// The line through `points`, turned counter-clockwise where they go the other way.
    pub fn polygon(points: &[[f64; 2]]) -> Self {
        let mut points = points.to_vec();
        if area(&points) < 0.0 {
            points.reverse();
        }
        Profile(points)
    }

    /// A circle of `count` points.
    pub fn circle(radius: f64, count: usize) -> Self {
        Self::superellipse([radius, radius], 2.0, count)
    }

    /// An ellipse of `count` points, by its half axes.
    pub fn ellipse(half: [f64; 2], count: usize) -> Self {
        Self::superellipse(half, 2.0, count)
    }

    /// The line `|x/a|ᵉ + |y/b|ᵉ = 1` for half axes `a` and `b` and the exponent `e`: 2 an ellipse, 4 a rectangle with
    /// generous corners.
    pub fn superellipse([a, b]: [f64; 2], exponent: f64, count: usize) -> Self {
        let power = |x: f64| x.signum() * pow(x.abs(), 2.0 / exponent);
        Profile(angles(count).map(|(sine, cosine)| [a * power(cosine), b * power(sine)]).collect())
    }

    /// A rectangle by its half sizes, each corner an arc of `radius` in `steps` pieces.
    pub fn rounded_rectangle(half: [f64; 2], radius: f64, steps: usize) -> Self {
        let radius = radius.min(half[0]).min(half[1]);
        let [a, b] = half.map(|half| half - radius);
        let corners = [[a, b], [-a, b], [-a, -b], [a, -b]];
        let arc = |(quarter, centre): (usize, [f64; 2])| {
            (0..=steps).map(move |step| {
                let turn = (quarter * steps + step) as f64 / (4 * steps) as f64;
                let (sine, cosine) = sincos(TAU * turn);
                [centre[0] + radius * cosine, centre[1] + radius * sine]
            })
        };
        Profile(corners.into_iter().enumerate().flat_map(arc).collect())
    }

    /// The convex outline of two circles and their common tangents, the first at the origin, the second at `[length, 0]`: a link
    /// between two shafts.
    pub fn link(radii: [f64; 2], length: f64, count: usize) -> Self {
        let tilt = (radii[0] - radii[1]) / length;
        let tangent = physics::math::ops::acos(tilt.clamp(-1.0, 1.0));
        let arc = |centre: f64, radius: f64, from: f64, to: f64| {
            (0..=count).map(move |step| {
                let (sine, cosine) = sincos(from + (to - from) * step as f64 / count as f64);
                [centre + radius * cosine, radius * sine]
            })
        };
        let far = arc(length, radii[1], -tangent, tangent);
        Profile(far.chain(arc(0.0, radii[0], tangent, TAU - tangent)).collect())
    }

    /// The same line elsewhere.
    pub fn moved(&self, [x, y]: [f64; 2]) -> Self {
        Profile(self.0.iter().map(|point| [point[0] + x, point[1] + y]).collect())
    }

    /// The same line turned about the origin, counter-clockwise \[rad\].
    pub fn turned(&self, angle: f64) -> Self {
        let (sine, cosine) = sincos(angle);
        Profile(self.0.iter().map(|[x, y]| [cosine * x - sine * y, sine * x + cosine * y]).collect())
    }

    /// The line at the distance `inset` inside of this one, with as many points. An inset beyond what the narrowest place
    /// allows crosses itself.
    pub fn inset(&self, inset: f64) -> Self {
        let count = self.0.len();
        let normal = |from: [f64; 2], to: [f64; 2]| {
            let [x, y] = [to[0] - from[0], to[1] - from[1]];
            let length = (x * x + y * y).sqrt().max(1e-12);
            [-y / length, x / length]
        };
        let moved = (0..count).map(|i| {
            let [before, here, after] = [self.0[(i + count - 1) % count], self.0[i], self.0[(i + 1) % count]];
            let (a, b) = (normal(before, here), normal(here, after));
            let share = (1.0 + a[0] * b[0] + a[1] * b[1]).max(0.3);
            [here[0] + inset * (a[0] + b[0]) / share, here[1] + inset * (a[1] + b[1]) / share]
        });
        Profile(moved.collect())
    }

    /// The points, in order.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// The area inside \[m²\].
    pub fn area(&self) -> f64 {
        area(&self.0)
    }
}

/// The area inside \[m²\], negative for a line that runs clockwise.
fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

/// Sine and cosine of `count` angles of a full turn, from zero.
pub(crate) fn angles(count: usize) -> impl Iterator<Item = (f64, f64)> {
    (0..count).map(move |i| sincos(TAU * i as f64 / count as f64))
}
