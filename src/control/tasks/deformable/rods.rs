//! The rods in the hem of a cloth: the one with a handle is grasped there from above, and carried somewhere with the cloth.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::grasp::{Carry, Grasp, Load, from_above};
use crate::tasks::arms::moves::Move;
use env::Env;
use physics::elements::{BodyId, GeomId, SiteId};
use physics::math::{Vec3, distance, sub};

/// How far over the middle of the rod fingers would be clear of it, which they are to reach below \[m\].
const BELOW: f64 = 0.008;
/// Speed at which it is touched, as a share of full speed, and seconds in which fingers close: the arm is to have come to rest.
const TOUCH: [f64; 2] = [0.2, 0.8];
/// Distance from the fingertips at which they have lost it \[m\].
const LOST: f64 = 0.025;
/// Speed with a cloth in the hand, as a share of full speed, and how long the arm waits after each part of the way \[s\].
const CARRY: (f64, f64) = (0.5, 0.3);

/// The rods of a cloth, and what is done with the first.
pub struct Rods {
    bodies: [BodyId; 2],
    handle: SiteId,
    /// Width of what is held \[m\].
    width: f64,
    /// How far over the middle of that fingers would be clear of what it lies on \[m\].
    below: f64,
    /// How far the rod that is carried is.
    carried: Option<Grasp>,
}

impl Rods {
    /// The bodies `rod_0` and `rod_1` of the environment, and the site `handle`, on the first rod or in the geom `handle`, a post on it.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let size = |geom: GeomId| scene.model.geom_size[geom.index()];
        let (width, below) = match scene.model.geom("handle") {
            Some(post) => (2.0 * size(post)[0], size(post)[2]),
            None => (2.0 * size(scene.geom("rod_0")?)[0], BELOW),
        };
        let bodies = [scene.body("rod_0")?, scene.body("rod_1")?];
        Ok(Rods { bodies, handle: scene.site("handle")?, width, below, carried: None })
    }

    /// Where they are; each lies along the y axis of its frame.
    pub fn frames(&self, env: &Env) -> [Frame; 2] {
        self.bodies.map(|body| Frame::of_body(&env.scene().data, body))
    }

    /// The next move of carrying the first rod along the places that `way` says of it, by their numbers. It is grasped, again if it was lost
    /// or let go of, where it is `wanted`; `None` where it is not.
    pub fn next(
        &mut self,
        env: &Env,
        arm: &Arm,
        wanted: bool,
        way: impl Fn(usize) -> Option<Vec3>,
    ) -> Option<Move> {
        let (rod, tool) = (self.frames(env)[0], arm.tool(env));
        let handle = Frame { place: Frame::of_site(&env.scene().data, self.handle).place, turn: rod.turn };
        let grasps = || from_above(arm, &handle, self.width, self.below, false);
        let carry = |step| {
            let to = vec![tool.moved(sub(way(step)?, rod.place))];
            Some(Carry { to, speed: CARRY.0, pause: CARRY.1 })
        };
        let is_lost = distance(tool.place, handle.place) > LOST;
        self.carried = self.carried.take().filter(|grasp| !(grasp.is_carrying() && is_lost));
        for _ in 0..2 {
            let load = Load { width: self.width, above: 0.05, away: 0.06, touch: TOUCH };
            self.carried = self.carried.take().or_else(|| wanted.then(|| Grasp::new(load)));
            let next = self.carried.as_mut()?.next(env, arm, grasps, carry);
            if next.is_some() {
                return next;
            }
            self.carried = None;
        }
        None
    }
}
