//! A valve of three blades that three fingers turn in unison. Each tip goes down behind a blade, pushes it along a circle round the shaft,
//! and where the finger ends it is lifted, goes back over the blades, and goes down behind the one that follows. As fingers stand 120
//! degrees apart, and blades too, one angle tells where all of them are.

use super::finger::Finger;
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::wrap;
use crate::tasks::roles::roles_of;
use env::Env;
use physics::elements::SiteId;
use physics::math::{Vec3, ops};
use std::f64::consts::TAU;

/// Distance of pushing tips from the shaft \[m\].
const RADIUS: f64 = 0.062;
/// Distance of the tip's middle from the middle of a blade that it touches \[m\]: their radii.
const TOUCH: f64 = 0.031;
/// Heights of tips that push, and of tips that pass over blades \[m\].
const LOW: f64 = 0.106;
const HIGH: f64 = 0.15;
/// Largest angle of a tip from the middle of its finger's stroke \[rad\].
const STROKE: f64 = 1.15;
/// Angle behind a blade at which tips go down, beside what they touch at \[rad\].
const CLEARANCE: f64 = 0.16;
/// Angle from where they go down at which tips may leave their height \[rad\].
const NEAR: f64 = 0.1;
/// How far ahead of the blade tips are told to be at most, for what the valve lacks \[rad\].
const STEP: f64 = 0.4;
/// Share of what the valve lacks that a step adds to how far tips press, and the most that they press \[rad\].
const GAIN: f64 = 0.12;
const PRESS: f64 = 0.6;
/// How far beyond the mark a valve is before it is turned back \[rad\].
const BEYOND: f64 = 0.15;

/// What the tips are doing.
#[derive(Clone, Copy, PartialEq)]
enum Stage {
    /// Going up where they are.
    Up,
    /// Going back to behind a blade, over the blades.
    Back,
    /// Going down there.
    Down,
    Push,
}

pub struct ClawTurn {
    fingers: Vec<Finger>,
    /// A site on a blade.
    mark: SiteId,
    stage: Stage,
    /// 1 to turn the valve counterclockwise, else -1.
    sense: f64,
    /// Where the tips are told to be, from the middle of the stroke, in the sense of turning \[rad\].
    angle: f64,
    /// Where they touch the blade that they push \[rad\].
    touching: f64,
    /// How far beyond that they are told to be, to press \[rad\].
    press: f64,
    controls: Vec<f64>,
}

impl ClawTurn {
    /// The controller of a claw over a valve whose shaft stands at the origin.
    ///
    /// # Errors
    /// A claw without roles, or with fingers of other joints; no valve.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (scene, roles) = (env.scene(), roles_of(env)?);
        let unfit = |error: robot::ConfigError| ControlError::unfit(env, error.to_string());
        let claw = roles.cast(&scene.model, "", "claw_turn");
        let (root, tips) = (claw.root().map_err(unfit)?, claw.fingertips().map_err(unfit)?);
        Ok(ClawTurn {
            fingers: tips.into_iter().map(|tip| Finger::new(env, root, tip)).collect::<Result<_, _>>()?,
            mark: scene.site("valve_mark")?,
            stage: Stage::Back,
            sense: 1.0,
            angle: 0.0,
            touching: 0.0,
            press: 0.0,
            controls: vec![0.0; scene.model.nu],
        })
    }

    /// The angle of a site from the middle of a finger's stroke, in the sense of turning \[rad\].
    fn angle_of(&self, env: &Env, finger: &Finger, site: SiteId) -> f64 {
        self.sense * (direction(*env.scene().data.site(site).xpos()) - finger.direction)
    }

    /// Where tips touch a blade from behind that is up to a third of a turn ahead of `first` \[rad\].
    fn contact(&self, env: &Env, first: f64) -> f64 {
        let behind = self.angle_of(env, &self.fingers[0], self.mark) - ops::asin(TOUCH / RADIUS);
        (behind - first).rem_euclid(TAU / 3.0) + first
    }

    /// How far the tip that is farthest from it is from an angle \[rad\].
    fn away(&self, env: &Env, angle: f64) -> f64 {
        let away = |finger: &Finger| {
            let turned = self.angle_of(env, finger, finger.tip) - angle;
            wrap(turned).abs()
        };
        self.fingers.iter().map(away).fold(0.0, f64::max)
    }

    /// Moves stage and angle on by a step; `error` is what the valve lacks, in the sense of turning \[rad\].
    fn advance(&mut self, env: &Env, error: f64) {
        self.press *= f64::from(self.stage == Stage::Push);
        match self.stage {
            Stage::Up => self.stage = Stage::Back,
            Stage::Back => {
                self.angle = self.contact(env, CLEARANCE - STROKE) - CLEARANCE;
                if self.away(env, self.angle) < NEAR {
                    self.stage = Stage::Down;
                }
            }
            Stage::Down => (self.stage, self.touching) = (Stage::Push, self.angle),
            Stage::Push if error < -BEYOND => {
                (self.sense, self.angle, self.stage) = (-self.sense, -self.angle, Stage::Up);
            }
            Stage::Push => {
                let contact = self.contact(env, self.touching - TAU / 6.0);
                self.touching = contact;
                if contact > STROKE {
                    self.stage = Stage::Up;
                } else {
                    self.press = (self.press + GAIN * error).clamp(-PRESS, PRESS);
                    self.angle = contact + error.clamp(-STEP, STEP) + self.press;
                }
            }
        }
    }
}

impl Controller for ClawTurn {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        self.fingers.iter_mut().for_each(|finger| finger.begin(&env.scene().data.state.qpos));
        self.sense = if env.rows()["target_error"][0] < 0.0 { -1.0 } else { 1.0 };
        (self.stage, self.press) = (Stage::Back, 0.0);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        self.advance(env, self.sense * env.rows()["target_error"][0]);
        let height = if matches!(self.stage, Stage::Up | Stage::Back) { HIGH } else { LOW };
        for finger in &mut self.fingers {
            let (sine, cosine) = ops::sincos(finger.direction + self.sense * self.angle);
            let place = [RADIUS * cosine, RADIUS * sine, height];
            finger.point(env, place, &mut self.controls);
        }
        command(env, &self.controls, action)
    }
}

/// The direction of a place from the shaft \[rad\].
fn direction([x, y, _]: Vec3) -> f64 {
    ops::atan2(y, x)
}
