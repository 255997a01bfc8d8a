//! Picking and placing: where the object comes to rest is simulated ahead, and it is grasped from above across a narrow side, carried over
//! the walls of the bins, and held at the target.

use super::arm::Arm;
use super::extent::around;
use super::grasp::{Carry, Grasp, Load, from_above};
use super::moves::{Move, Pace, Script};
use super::named::site;
use crate::error::ControlError;
use env::Env;
use physics::Data;
use physics::elements::{BodyId, Element, SiteId};
use physics::math::sub;
use std::f64::consts::PI;

/// Time in which objects come to rest \[s\].
const FALL: f64 = 1.2;
/// Directions that are compared.
const DIRECTIONS: usize = 12;
/// Width up to which one is as good as another \[m\].
const WIDE: f64 = 0.062;
/// How high over the target the object passes the walls \[m\].
const OVER: f64 = 0.06;
/// How high over the target it is held, still over the walls \[m\].
const HELD: f64 = 0.03;
/// Speed of fingers that touch, as a share of full speed, and seconds in which they close: an episode lasts 4 s.
const QUICK: [f64; 2] = [0.9, 0.16];
/// Commands ahead of the limits of velocity, which then decide.
pub const HASTY: Pace = Pace { joint: 3.5, tool: 3.0, near: 0.06 };

pub struct PickPlace {
    object: BodyId,
    site: SiteId,
    target: SiteId,
    grasp: Grasp,
    /// The objects at rest, when they have fallen into the bin.
    rest: Option<Box<Data>>,
}

impl PickPlace {
    /// The script for the object and the target of the environment.
    ///
    /// # Errors
    /// Settings without their names.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let (site, target) = (site(env, "object_site_name")?, site(env, "target_site_name")?);
        let body = scene.model.site_bodyid[site.index()] as usize;
        let object = BodyId::at(&scene.model, body)
            .ok_or_else(|| ControlError::unfit(env, "the site of the object is on no body"))?;
        let load = Load { width: 0.07, above: 0.04, away: 0.0, touch: QUICK };
        Ok(PickPlace { object, site, target, grasp: Grasp::new(load), rest: None })
    }
}

impl Script for PickPlace {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = PickPlace::new(env)?;
        let scene = env.scene();
        let mut rest = Box::new(scene.data.clone());
        while rest.time() < scene.data.time() + FALL {
            physics::step(&scene.model, &mut rest)?;
        }
        self.rest = Some(rest);
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let (m, data) = (&env.scene().model, &env.scene().data);
        let fallen = self.rest.as_deref().filter(|_| self.grasp.is_new()).unwrap_or(data);
        let boxes =
            (0..DIRECTIONS).map(|k| around(m, fallen, self.object, PI * k as f64 / DIRECTIONS as f64));
        let least = boxes.clone().map(|(_, width, _)| width).fold(f64::INFINITY, f64::min);
        let grasps = || {
            let narrow = boxes.clone().filter(|(_, width, _)| *width <= least.max(WIDE));
            narrow.flat_map(|(frame, width, half)| from_above(arm, &frame, width, half, false)).collect()
        };
        let tool = arm.tool(env);
        let way = sub(data.kin.site_xpos[self.target.index()], data.kin.site_xpos[self.site.index()]);
        let carry = |step| match step {
            0 => Some(tool.moved([0.0, 0.0, way[2] + OVER])),
            _ => Some(tool.moved([way[0], way[1], way[2] + HELD])),
        };
        let carry = |step| {
            carry(step).map(|to| Carry { to: vec![to], speed: if step == 0 { 0.5 } else { 1.0 }, pause: 0.0 })
        };
        Ok(self.grasp.next(env, arm, grasps, carry))
    }
}
