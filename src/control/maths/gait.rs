//! Gaits of legs that step in turn: where each foot is to be, relative to a body that moves at a commanded velocity.
//!
//! A foot on the ground moves backwards as the body moves over it; a foot in the air moves to where it has to be set down so that
//! the body keeps its velocity: half of what the body covers during stance ahead of the hip, and further by what the velocity
//! exceeds the command (Raibert, Legged Robots That Balance, 1986, equation 2.4).

use physics::math::{Vec3, ops};
use std::f64::consts::PI;

/// Timing of a gait, and what a step is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gait {
    /// Time from one step of a leg to its next \[s\].
    pub period: f64,
    /// Share of the period that a foot is on the ground.
    pub duty: f64,
    /// Height to which feet are lifted \[m\].
    pub lift: f64,
    /// How much further a foot is set down for each metre a second that the body is too fast \[s\].
    pub balance: f64,
}

/// A foot of a gait.
#[derive(Clone, Copy, Debug)]
struct Foot {
    /// Where it is when the body stands \[m\].
    home: Vec3,
    /// When it begins its step, as a share of the period.
    late: f64,
    /// Where it is to be now \[m\].
    place: Vec3,
    /// Where it left the ground \[m\].
    left: Vec3,
}

/// Feet that step in turn. Places are relative to the body, in the frame of its heading: forward, left, up.
///
/// ```
/// use robohive_control::maths::{Gait, Steps};
///
/// let gait = Gait { period: 0.4, duty: 0.5, lift: 0.05, balance: 0.1 };
/// let homes = [[0.2, 0.1, -0.3], [0.2, -0.1, -0.3], [-0.2, 0.1, -0.3], [-0.2, -0.1, -0.3]];
/// let mut steps = Steps::trot(gait, &homes);
/// let velocity = [0.5, 0.0, 0.0];
/// let places: Vec<_> = (0..40).map(|_| steps.advance(velocity, velocity, 0.01)[0]).collect();
/// let highest = places.iter().map(|place| place[2]).fold(-1.0, f64::max);
/// assert!((highest + 0.25).abs() < 1e-3, "feet are lifted by 5 cm");
/// let reach = |x: f64| places.iter().map(|place| (place[0] - x).abs()).fold(1.0, f64::min);
/// assert!(reach(0.25) < 0.01 && reach(0.15) < 0.01, "a stance of 0.2 s at 0.5 m/s covers 0.1 m");
/// ```
#[derive(Clone, Debug)]
pub struct Steps {
    gait: Gait,
    feet: Vec<Foot>,
    phase: f64,
    places: Vec<Vec3>,
}

impl Steps {
    /// Feet that all begin on the ground at their homes, those of one diagonal half a period after the others.
    pub fn trot(gait: Gait, homes: &[Vec3]) -> Self {
        let diagonal = |home: &Vec3| if home[0] * home[1] > 0.0 { 0.0 } else { 0.5 };
        let feet =
            homes.iter().map(|home| Foot { home: *home, late: diagonal(home), place: *home, left: *home });
        Steps { gait, feet: feet.collect(), phase: 0.0, places: homes.to_vec() }
    }

    /// Puts all feet on the ground at their homes.
    pub fn restart(&mut self) {
        self.phase = 0.0;
        for foot in &mut self.feet {
            (foot.place, foot.left) = (foot.home, foot.home);
        }
        self.places.iter_mut().zip(&self.feet).for_each(|(place, foot)| *place = foot.home);
    }

    /// Where the feet are to be now \[m\].
    pub fn places(&self) -> &[Vec3] {
        &self.places
    }

    /// Places of the feet \[m\] after `dt` seconds in which the body is to move at `wanted` and moves at `measured`: forward, to the
    /// left \[m/s\], turning counterclockwise \[rad/s\].
    pub fn advance(&mut self, wanted: [f64; 3], measured: [f64; 3], dt: f64) -> &[Vec3] {
        let Gait { period, duty, lift, balance } = self.gait;
        self.phase = (self.phase + dt / period).fract();
        let stance = duty * period;
        for (foot, place) in self.feet.iter_mut().zip(&mut self.places) {
            let phase = (self.phase + foot.late).fract();
            let [x, y, _] = foot.home;
            // Velocity of the body over this foot.
            let over = |v: [f64; 3]| [v[0] - v[2] * y, v[1] + v[2] * x];
            let (goal, real) = (over(wanted), over(measured));
            if phase < duty {
                let now = foot.place;
                foot.place = [
                    now[0] - (wanted[0] - wanted[2] * now[1]) * dt,
                    now[1] - (wanted[1] + wanted[2] * now[0]) * dt,
                    foot.home[2],
                ];
                foot.left = foot.place;
            } else {
                let part = ((phase - duty) / (1.0 - duty)).min(1.0);
                // Leaves and reaches the ground without a jump in velocity.
                let way = part - ops::sin(2.0 * PI * part) / (2.0 * PI);
                let end = |i: usize| foot.home[i] + goal[i] * stance / 2.0 + balance * (real[i] - goal[i]);
                let along = |i: usize| foot.left[i] + way * (end(i) - foot.left[i]);
                foot.place = [along(0), along(1), foot.home[2] + lift * ops::sin(PI * part)];
            }
            *place = foot.place;
        }
        &self.places
    }
}
