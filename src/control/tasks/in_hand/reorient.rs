//! Reorienting a thing in the palm: a plan costs the turn that is left, and how far the thing leaves its place.

use super::search::{Search, Sizes};
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use physics::Data;
use physics::elements::BodyId;
use physics::math::{Quat, Vec3, cross, dot, norm, ops, quat_conj, quat_mul, quat_rotate, sub};

const SIZES: Sizes = Sizes { samples: 40, horizon: 0.4, step: 0.01, every: 0.05, knots: 5, noise: 0.2 };
/// Cost of a squared distance from its place \[1/m²\].
const PLACE: f64 = 200.0;
/// Distance at which a thing is about to be lost \[m\], and its cost.
const FAR: f64 = 0.05;
const LOSS: f64 = 10.0;

pub struct Reorient {
    search: Search,
    object: BodyId,
    target: BodyId,
    /// Where the thing was put \[m\].
    home: Vec3,
    /// The axis of a round thing, in its frame.
    axis: Option<Vec3>,
}

impl Reorient {
    /// The controller.
    ///
    /// # Errors
    /// No thing, or no target.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (object, target) = (env.scene().body("object")?, env.scene().body("target")?);
        Ok(Reorient {
            search: Search::new(env, SIZES),
            object,
            target,
            home: [0.0; 3],
            axis: env.spec().args.get("axis"),
        })
    }
}

impl Controller for Reorient {
    fn reset(&mut self, env: &Env, seed: u64) -> Result<(), ControlError> {
        self.home = *env.scene().data.body(self.object).xpos();
        self.search.begin(env, seed)
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let target = env.scene().model.body_quat[self.target.index()];
        let (object, home, axis) = (self.object, self.home, self.axis);
        let cost = |data: &Data| {
            let object = data.body(object);
            let away = norm(sub(*object.xpos(), home));
            let left = angle(target, *object.xquat(), axis);
            left + PLACE * away * away + LOSS * f64::from(away > FAR)
        };
        self.search.act(env, cost, action)
    }
}

/// The angle between two orientations, or between an axis in the one and in the other \[rad\].
fn angle(a: Quat, b: Quat, axis: Option<Vec3>) -> f64 {
    if let Some(axis) = axis {
        let [a, b] = [a, b].map(|quat| quat_rotate(quat, axis));
        return ops::atan2(norm(cross(a, b)), dot(a, b));
    }
    let [w, x, y, z] = quat_mul(a, quat_conj(b));
    2.0 * ops::atan2(norm([x, y, z]), w.abs())
}
