//! Hopping round by two of Raibert's three parts (Legged robots that balance, MIT Press 1986, chapter 2): thrust while the leg extends
//! keeps the height, and the foot is put down where the present speed would keep it, and further ahead by as much as it is too fast. The
//! boom does the third part, which keeps the body upright.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use env::Env;
use physics::math::ops;

/// Speed of the hopper along the circle \[m/s\].
const SPEED: f64 = 0.8;
/// Place of the foot by speed in excess \[s\].
const GAIN: f64 = 0.1;
/// Furthest place of the foot \[m\].
const FURTHEST: f64 = 0.2;
/// Thrust while the leg extends \[N\].
const THRUST: f64 = 90.0;
/// Length of the leg, and of the boom with the half width of the hopper \[m\].
const LEG: f64 = 0.5;
const BOOM: f64 = 1.25;
/// Shortening from which the leg counts as loaded \[m\].
const LOADED: f64 = 0.01;
/// Time of a stance, before one was measured \[s\].
const STANCE: f64 = 0.18;
/// Share that the newest stance has in the estimate.
const NEWEST: f64 = 0.3;

/// Where the leg is in its cycle.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Flight,
    Compression,
    Thrust,
}

pub struct HopperBoom {
    phase: Phase,
    /// When the foot came down \[s\].
    landed: f64,
    /// Estimate of the time of a stance \[s\].
    stance: f64,
}

impl HopperBoom {
    /// The controller.
    ///
    /// # Errors
    /// An observation without the foot.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        match env.rows().get("stance") {
            Some(_) => Ok(HopperBoom { phase: Phase::Flight, landed: 0.0, stance: STANCE }),
            None => Err(ControlError::unfit(env, "the observation stance is needed")),
        }
    }
}

impl Controller for HopperBoom {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        (self.phase, self.stance) = (Phase::Flight, STANCE);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let data = &env.scene().data;
        let (qpos, qvel, now) = (&data.state.qpos, &data.state.qvel, data.time());
        let (speed, shortened) = (qvel[0] * BOOM, qpos[3]);
        let stands = env.rows()["stance"][0] > 0.0 || shortened > LOADED;
        self.phase = match (stands, self.phase) {
            (false, Phase::Flight) => Phase::Flight,
            (false, _) => {
                self.stance += NEWEST * (now - self.landed - self.stance);
                Phase::Flight
            }
            (true, Phase::Flight) => {
                self.landed = now;
                Phase::Compression
            }
            (true, Phase::Compression) if shortened > LOADED && qvel[3] < 0.0 => Phase::Thrust,
            (true, phase) => phase,
        };
        let ahead = speed * self.stance / 2.0 + GAIN * (speed - SPEED);
        let hip = match self.phase {
            Phase::Flight => ops::asin(ahead.clamp(-FURTHEST, FURTHEST) / LEG),
            // The servo follows the leg, so that it swings freely over the foot.
            _ => qpos[2] + env.dt() * qvel[2],
        };
        let pushes = self.phase == Phase::Thrust && shortened > LOADED;
        command(env, &[hip, if pushes { THRUST } else { 0.0 }], action)
    }
}
