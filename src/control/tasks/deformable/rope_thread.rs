//! Threading a rope: it is grasped behind its stiff tip, itself or by a post there, brought before the ring, put straight to its axis, and pushed
//! through.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::grasp::{Carry, Grasp, Load, from_above};
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::{BodyId, GeomId, SiteId};
use physics::math::{add, norm, ops, quat_from_axis_angle, quat_mul, scale, sub};
use std::f64::consts::FRAC_PI_2;

/// The link that is held: with those after it, it is the tip.
const HELD: &str = "rope_19";
/// Width of the rope, and how far over its middle fingers would be clear of it, which they are to reach below \[m\].
const ROPE: (f64, f64) = (0.01, 0.008);
/// Speed at which it is touched, as a share of full speed, and seconds in which fingers close: the arm is to have come to rest.
const TOUCH: [f64; 2] = [0.2, 0.8];
/// How far the loose end is from the middle of the ring along its axis: before it, and when it is threaded \[m\].
const BEFORE: f64 = -0.03;
const BEYOND: f64 = 0.068;
/// Steps in which the tip, before the ring, is put straight.
const STRAIGHTEN: usize = 2;

pub struct RopeThread {
    held: BodyId,
    /// The post on it, if it has one.
    handle: Option<GeomId>,
    /// Width of what is held, and how far over its middle fingers would be clear of it \[m\].
    width: f64,
    below: f64,
    end: SiteId,
    ring: SiteId,
    grasp: Grasp,
}

impl RopeThread {
    /// The script for the rope and the ring of the environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let (end, ring, handle) = (scene.site("rope_end")?, scene.site("ring")?, scene.model.geom("handle"));
        let post = |geom: GeomId| scene.model.geom_size[geom.index()];
        let (width, below) = handle.map(post).map_or(ROPE, |size| (2.0 * size[0], size[2]));
        let load = Load { width, above: 0.06, away: 0.06, touch: TOUCH };
        Ok(RopeThread { held: scene.body(HELD)?, handle, width, below, end, ring, grasp: Grasp::new(load) })
    }
}

impl Script for RopeThread {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = RopeThread::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let data = &env.scene().data;
        let (begin, end) = (data.kin.xpos[self.held.index()], data.kin.site_xpos[self.end.index()]);
        let (way, ring, tool) = (sub(end, begin), Frame::of_site(data, self.ring), arm.tool(env));
        let yaw = quat_from_axis_angle([0.0, 0.0, 1.0], ops::atan2(way[1], way[0]));
        let pitch = -ops::atan2(way[2], norm([way[0], way[1], 0.0]));
        // The tip: its x axis points to the loose end, where its origin is.
        let tip = Frame { place: end, turn: quat_mul(yaw, quat_from_axis_angle([0.0, 1.0, 0.0], pitch)) };
        let goal = |along: f64, tool: &Frame| {
            let place = ring.point([along, 0.0, 0.0]);
            Frame { place, turn: ring.turn }.with(&tool.within(&tip))
        };
        // Fingers close across the middle of the link, the way round in which the wrist can put it before the ring.
        let middle =
            self.handle.map_or_else(|| add(begin, scale(way, 0.1)), |post| data.kin.geom_xpos[post.index()]);
        let across = quat_mul(yaw, quat_from_axis_angle([0.0, 0.0, 1.0], FRAC_PI_2));
        let ways = from_above(arm, &Frame { place: middle, turn: across }, self.width, self.below, false);
        let goals: Vec<Frame> = ways.iter().map(|way| goal(BEFORE, way)).collect();
        let from = arm.places(&data.state.qpos);
        let best =
            arm.nearest(env, &from, &goals).and_then(|(near, _)| goals.iter().position(|at| *at == near));
        let grasps = || vec![ways[best.unwrap_or(0)]];
        let carry = |step| {
            let along = if step <= STRAIGHTEN { BEFORE } else { BEYOND };
            let to = vec![if step == 0 {
                tool.moved([0.0, 0.0, ring.place[2] - begin[2]])
            } else {
                goal(along, &tool)
            }];
            let (speed, pause) = if step > STRAIGHTEN { (0.2, 1.0) } else { (0.4, 0.4) };
            (step <= STRAIGHTEN + 1).then_some(Carry { to, speed, pause })
        };
        Ok(self.grasp.next(env, arm, grasps, carry))
    }
}
