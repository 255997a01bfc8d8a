//! Turning a pen in the hand until it points as another one does: a plan costs the angle between them, less while it is what the task asks
//! for, and how far the pen leaves its place.

use super::search::{Search, Sizes};
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use physics::Data;
use physics::elements::SiteId;
use physics::math::{dot, norm, sub};

const SIZES: Sizes = Sizes { samples: 40, horizon: 0.3, step: 0.01, every: 0.01, knots: 5, noise: 0.4 };
/// Cosine of the angle beyond which the pen points as it is to, and what it costs that it does not.
const ALIGNED: f64 = 0.955;
const ASKEW: f64 = 2.0;
/// Cost of a squared distance from its place \[1/m²\].
const PLACE: f64 = 5.0;
/// Height below which the pen is about to be lost \[m\], and its cost.
const LOW: f64 = 0.1;
const LOSS: f64 = 10.0;

pub struct Pen {
    search: Search,
    /// Ends of the pen, and of the one that it is to point as.
    ends: [SiteId; 2],
    wanted: [SiteId; 2],
    place: SiteId,
}

impl Pen {
    /// The controller.
    ///
    /// # Errors
    /// A site is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let site = |name: &str| env.scene().site(name);
        Ok(Pen {
            search: Search::new(env, SIZES),
            ends: [site("object_top")?, site("object_bottom")?],
            wanted: [site("target_top")?, site("target_bottom")?],
            place: site("eps_ball")?,
        })
    }
}

impl Controller for Pen {
    fn reset(&mut self, env: &Env, seed: u64) -> Result<(), ControlError> {
        self.search.begin(env, seed)
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (ends, wanted, place) = (self.ends, self.wanted, self.place);
        let cost = |data: &Data| {
            let at = |site: SiteId| *data.site(site).xpos();
            let [along, there] = [ends, wanted].map(|[top, bottom]| sub(at(top), at(bottom)));
            let cosine = dot(along, there) / (norm(along) * norm(there));
            let [top, bottom] = ends.map(at);
            let middle = [0, 1, 2].map(|i| 0.5 * (top[i] + bottom[i]));
            let away = norm(sub(middle, at(place)));
            let lost = LOSS * f64::from(middle[2] < LOW);
            (1.0 - cosine).max(0.0) + ASKEW * f64::from(cosine <= ALIGNED) + PLACE * away * away + lost
        };
        self.search.act(env, cost, action)
    }
}
