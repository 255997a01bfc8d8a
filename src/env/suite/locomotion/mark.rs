//! The mark on the ground that a body is to come to.

use super::walker::{Posture, Walker};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Setup, Verdict, View};
use physics::elements::SiteId;

/// Name of its site in all arenas.
const TARGET: &str = "target";

/// The mark.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    site: SiteId,
    /// Distance that solves a task \[m\].
    pub radius: f64,
}

impl Mark {
    /// Weights of what [`Mark::reward`] writes.
    pub const WEIGHTS: [(&str, f64); 5] =
        [("distance", 1.0), ("heading", 0.5), ("upright", 0.5), ("bonus", 2.0), ("fallen", 10.0)];

    /// The mark of an arena; `radius` is in heights of the root.
    ///
    /// # Errors
    /// The model has no site `target`.
    pub fn new(radius: f64, walker: &Walker, setup: &Setup<'_>) -> Result<Self, EnvError> {
        Ok(Mark { site: setup.scene.site(TARGET)?, radius: radius * walker.height })
    }

    /// Puts it on the ground \[m\].
    ///
    /// # Errors
    /// A place that is no number.
    pub fn put(&self, scene: &mut Scene, [x, y]: [f64; 2]) -> Result<(), EnvError> {
        scene.overwrite(|m| m.site_pos[self.site.index()] = [x, y, 0.0])
    }

    /// Where it is \[m\].
    pub fn place(&self, view: &View<'_>) -> [f64; 2] {
        let [x, y, _] = *view.data.site(self.site).xpos();
        [x, y]
    }

    /// Writes where it is from a body, in the frame of the heading.
    pub fn observe(&self, posture: &Posture, view: &View<'_>, rows: &mut Rows) {
        rows.set("target_error", "m", posture.towards(view.data.site(self.site).xpos()));
    }

    /// Rewards a body for being near it, and for looking there on the way.
    pub fn reward(&self, walker: &Walker, rows: &Rows, terms: &mut Rows) -> Verdict {
        let error = &rows["target_error"];
        let distance = norm(error);
        let solved = distance < self.radius;
        terms.set("distance", "m", [-distance]);
        terms.set("heading", "", [if solved { 1.0 } else { error[0] / distance }]);
        walker.judge(solved, rows, terms)
    }
}
