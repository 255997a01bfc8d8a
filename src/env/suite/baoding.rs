//! Two balls that circle each other in the palm: the path of their targets, and what all tasks of that kind observe and
//! reward.

use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::spec::Spec;
use crate::task::View;
use physics::elements::SiteId;
use physics::math::{Vec3, ops, sub};
use std::f64::consts::TAU;

/// Positions and degrees of freedom of the two balls. They stand behind the hand's.
pub const BALLS: [usize; 2] = [14, 12];

/// Rows that are observed of hand, balls and targets.
pub const KEYS: [&str; 9] = [
    "hand_pos",
    "object1_pos",
    "object1_velp",
    "object2_pos",
    "object2_velp",
    "target1_pos",
    "target2_pos",
    "target1_err",
    "target2_err",
];

/// The ellipse that both targets move on.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// Half axes \[m\].
    pub radii: [f64; 2],
    /// Middle \[m\].
    pub center: [f64; 2],
    /// Time of a turn \[s\].
    pub period: f64,
    /// 1 counterclockwise, -1 clockwise, 0 at rest.
    pub direction: f64,
    /// Jumps of the targets in a turn; `None` where they move steadily.
    pub jumps: Option<u32>,
}

impl Orbit {
    /// How far \[rad\] targets have moved after `steps` control periods `dt` \[s\].
    pub fn angle(&self, steps: usize, dt: f64) -> f64 {
        match self.jumps {
            None => self.direction * TAU * (steps as f64 * dt / self.period),
            Some(jumps) => {
                let between = (self.period / (f64::from(jumps) * dt)).ceil();
                self.direction * (steps as f64 / between).floor() * TAU / f64::from(jumps)
            }
        }
    }

    /// The place at an angle \[m\].
    pub fn at(&self, angle: f64) -> [f64; 2] {
        let (sine, cosine) = ops::sincos(angle);
        [self.radii[0] * cosine + self.center[0], self.radii[1] * sine + self.center[1]]
    }
}

/// Reads the setting `n_shifts_per_period`: jumps in a turn, or -1 for targets that move steadily.
///
/// # Errors
/// Any other number.
pub fn jumps(spec: &Spec, setting: Option<i64>) -> Result<Option<u32>, EnvError> {
    match setting {
        None | Some(-1) => Ok(None),
        Some(jumps) => match u32::try_from(jumps) {
            Ok(jumps) if jumps > 0 => Ok(Some(jumps)),
            _ => Err(spec.wrong(
                "n_shifts_per_period is the number of jumps in a turn, or -1 for targets that move steadily",
            )),
        },
    }
}

/// The balls and their targets.
#[derive(Clone, Debug)]
pub struct Pairs {
    /// Centres of the balls.
    pub balls: [SiteId; 2],
    /// Where they are to be.
    pub targets: [SiteId; 2],
}

impl Pairs {
    /// Finds them by the names that all models use.
    ///
    /// # Errors
    /// The model lacks one of them.
    pub fn find(scene: &Scene) -> Result<Self, EnvError> {
        if scene.model.nq <= BALLS[0] || scene.model.nv <= BALLS[1] {
            return Err(EnvError::missing("hand with free joints", "ball1 and ball2", std::iter::empty()));
        }
        Ok(Pairs {
            balls: [scene.site("ball1_site")?, scene.site("ball2_site")?],
            targets: [scene.site("target1_site")?, scene.site("target2_site")?],
        })
    }

    /// Writes the joints of the hand, and places, velocities and errors of the balls.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let place = |site: SiteId| *view.data.site(site).xpos();
        // The first three of a ball's six velocities are the velocity of its centre.
        let first = view.model.nv - BALLS[1];
        let moved = |ball: usize| state.qvel[first + 6 * ball..][..3].iter().map(|v| v * view.dt);
        rows.set("hand_pos", "rad", &state.qpos[..view.model.nq - BALLS[0]]);
        rows.set("object1_pos", "m", place(self.balls[0]));
        rows.set("object2_pos", "m", place(self.balls[1]));
        rows.set("object1_velp", "m", moved(0));
        rows.set("object2_velp", "m", moved(1));
        rows.set("target1_pos", "m", place(self.targets[0]));
        rows.set("target2_pos", "m", place(self.targets[1]));
        rows.set("target1_err", "m", self.error(view, 0));
        rows.set("target2_err", "m", self.error(view, 1));
    }

    fn error(&self, view: &View<'_>, k: usize) -> Vec3 {
        sub(*view.data.site(self.targets[k]).xpos(), *view.data.site(self.balls[k]).xpos())
    }
}

/// How well the balls follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// From ball to target \[m\].
    pub distances: [f64; 2],
    /// Whether each ball is at its target.
    pub near: [bool; 2],
    /// Whether a ball fell.
    pub fallen: bool,
}

impl Following {
    /// Judges an observation: balls closer than `near` \[m\] are at their targets, those below the height `drop` \[m\] fell.
    pub fn of(rows: &Rows, near: f64, drop: f64) -> Self {
        let distances = ["target1_err", "target2_err"].map(|row| norm(&rows[row]));
        Following {
            distances,
            near: distances.map(|distance| distance < near),
            fallen: rows["object1_pos"][2] < drop || rows["object2_pos"][2] < drop,
        }
    }

    /// Whether both balls are at their targets.
    pub fn both(&self) -> bool {
        self.near[0] && self.near[1]
    }

    /// One for each ball at its target, four more for both.
    pub fn bonus(&self) -> f64 {
        f64::from(self.near[0]) + f64::from(self.near[1]) + 4.0 * f64::from(self.both())
    }
}

/// How far the wrist is bent \[rad\], its three joints counted unequally.
pub fn wrist_error(rows: &Rows) -> f64 {
    const WEIGHTS: Vec3 = [5.0, 0.5, 1.0];
    let joints = &rows["hand_pos"];
    norm(&[joints[0] * WEIGHTS[0], joints[1] * WEIGHTS[1], joints[2] * WEIGHTS[2]])
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEADY: Orbit =
        Orbit { radii: [0.03, 0.036], center: [0.005, 0.06], period: 6.0, direction: 1.0, jumps: None };

    #[test]
    fn targets_move_steadily_or_in_jumps() {
        assert!((STEADY.angle(15, 0.1) - TAU / 4.0).abs() < 1e-12);
        assert_eq!(Orbit { direction: -1.0, ..STEADY }.angle(15, 0.1), -STEADY.angle(15, 0.1));
        let quarters = Orbit { jumps: Some(4), ..STEADY };
        assert_eq!(
            [0, 14, 15, 29, 30].map(|step| quarters.angle(step, 0.1) / TAU),
            [0.0, 0.0, 0.25, 0.25, 0.5]
        );
        // Seven and a half steps would pass between eighths; jumps are on whole steps, later rather than earlier.
        let eighths = Orbit { jumps: Some(8), ..STEADY };
        assert_eq!([7, 8, 15, 16].map(|step| eighths.angle(step, 0.1) / TAU), [0.0, 0.125, 0.125, 0.25]);
        assert_eq!(STEADY.at(0.0), [0.03 + 0.005, 0.06]);
    }

    #[test]
    fn both_balls_must_be_at_their_targets() {
        let mut rows = Rows::default();
        rows.set("object1_pos", "m", [0.0, 0.0, 0.2]);
        rows.set("object2_pos", "m", [0.0, 0.0, 0.05]);
        rows.set("target1_err", "m", [0.0, 0.01, 0.0]);
        rows.set("target2_err", "m", [0.0, 0.02, 0.0]);
        let one = Following::of(&rows, 0.015, 0.06);
        assert_eq!((one.near, one.fallen, one.both(), one.bonus()), ([true, false], true, false, 1.0));
        let both = Following::of(&rows, 0.03, 0.04);
        assert_eq!((both.fallen, both.both(), both.bonus()), (false, true, 6.0));
    }
}
