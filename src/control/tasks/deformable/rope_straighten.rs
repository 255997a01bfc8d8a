//! Straightening a rope: its loose end is grasped, and pulled away from the post until the rope is taut.

use super::hand::{Hand, Move, down};
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{add, norm, ops, scale, sub};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How far over the rope the hand comes \[m\].
const ABOVE: f64 = 0.08;
/// Opening of each finger around the rope \[m\].
const OPEN: f64 = 0.02;
/// How far over the middle of the rope the fingertips hold it \[m\].
const OVER: f64 = 0.005;
/// How much farther than the rope is long its end is pulled.
const TAUT: f64 = 1.003;
/// Which link is held, from the loose end: the fingers are to have rope on both sides.
const HELD: usize = 2;
/// Directions from the post in which the arm reaches far enough \[rad\].
const DIRECTIONS: [f64; 2] = [-0.3, 0.1];

/// The controller.
pub struct RopeStraighten {
    hand: Hand,
    links: Vec<BodyId>,
    end: SiteId,
}

impl RopeStraighten {
    /// The controller for an arm and a rope of links `rope_0` … that ends at the site `rope_end`.
    ///
    /// # Errors
    /// An element is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (scene, hand) = (env.scene(), Hand::new(env)?);
        let links: Vec<BodyId> = (0..).map_while(|k| scene.model.body(&format!("rope_{k}"))).collect();
        if links.len() <= HELD {
            return Err(ControlError::unfit(env, "the scene has no rope"));
        }
        Ok(RopeStraighten { hand, links, end: scene.site("rope_end")? })
    }
}

impl Controller for RopeStraighten {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let data = &env.scene().data;
        let place = |k: usize| *data.body(self.links[k]).xpos();
        let (first, held) = (place(0), self.links.len() - HELD);
        let (begins, ends) = (place(held), place(held + 1));
        let (link, way) = (sub(ends, begins), sub(*data.site(self.end).xpos(), first));
        let grasp = add(scale(add(begins, ends), 0.5), [0.0, 0.0, OVER]);
        let along = ops::atan2(link[1], link[0]);
        let direction = ops::atan2(way[1], way[0]).clamp(DIRECTIONS[0], DIRECTIONS[1]);
        // All links are as long as this one, which is held in its middle.
        let length = TAUT * norm(link) * (held as f64 + 0.5);
        let (sine, cosine) = ops::sincos(direction);
        let goal = [first[0] + length * cosine, first[1] + length * sine, grasp[2]];
        // The hand turns as the link does, the shorter way.
        let turn = (along - direction + PI).rem_euclid(TAU) - PI;
        let (across, aside) = (down(direction + turn + FRAC_PI_2), down(direction + FRAC_PI_2));
        let above = add(grasp, [0.0, 0.0, ABOVE]);
        let towards = |tip, turn, fingers, seconds| Move { tip, turn, fingers, seconds, patience: 1.0 };
        let plan = vec![
            towards(above, across, OPEN, 1.5),
            towards(grasp, across, OPEN, 1.0),
            towards(grasp, across, 0.0, 0.4),
            towards(goal, aside, 0.0, 3.0),
        ];
        self.hand.begin(env, plan);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        self.hand.act(env, action)
    }
}
