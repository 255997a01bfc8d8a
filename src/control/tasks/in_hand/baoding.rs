//! Two balls that go round each other in the palm: a plan costs the turn that is left of the line between them, and how far they leave the
//! middle of the palm.

use super::search::{Search, Sizes};
use crate::controller::Controller;
use crate::error::ControlError;
use crate::maths::wrap;
use env::Env;
use physics::Data;
use physics::elements::BodyId;
use physics::math::{Vec3, add, norm, ops, scale, sub};

const SIZES: Sizes = Sizes { samples: 40, horizon: 0.4, step: 0.01, every: 0.05, knots: 5, noise: 0.2 };
/// Cost of a squared distance of a ball from the middle of both places \[1/m²\].
const PLACE: f64 = 100.0;
/// Distance from there at which a ball is about to be lost \[m\], and its cost.
const FAR: f64 = 0.07;
const LOSS: f64 = 10.0;

pub struct Baoding {
    search: Search,
    balls: [BodyId; 2],
    /// The middle between the places where the balls were put \[m\].
    middle: Vec3,
    /// The bearing that the line from the first to the second is to have \[rad\].
    wanted: f64,
}

impl Baoding {
    /// The controller.
    ///
    /// # Errors
    /// A ball is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let balls = [env.scene().body("first")?, env.scene().body("second")?];
        Ok(Baoding { search: Search::new(env, SIZES), balls, middle: [0.0; 3], wanted: 0.0 })
    }
}

impl Controller for Baoding {
    fn reset(&mut self, env: &Env, seed: u64) -> Result<(), ControlError> {
        let [first, second] = self.balls.map(|ball| *env.scene().data.body(ball).xpos());
        self.middle = scale(add(first, second), 0.5);
        let target = &env.rows()["target_line"];
        self.wanted = ops::atan2(target[1], target[0]);
        self.search.begin(env, seed)
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (balls, middle, wanted) = (self.balls, self.middle, self.wanted);
        let cost = |data: &Data| {
            let [first, second] = balls.map(|ball| *data.body(ball).xpos());
            let [x, y, _] = sub(second, first);
            let left = wrap(wanted - ops::atan2(y, x));
            let away = [first, second].map(|place| norm(sub(place, middle)));
            let place = PLACE * away.iter().map(|away| away * away).sum::<f64>();
            left.abs() + place + LOSS * f64::from(away[0].max(away[1]) > FAR)
        };
        self.search.act(env, cost, action)
    }
}
