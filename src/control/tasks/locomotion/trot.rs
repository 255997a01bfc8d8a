//! A trot that follows a command: Raibert's steps, legs by inverse kinematics, height and level kept by what the body lacks of them.

use super::body::Body;
use super::legs::Legs;
use super::wish::{Facts, Wish, wish};
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::{Gait, Steps};
use env::{Env, OwnRows};
use physics::math::Vec3;
use robot::{Pose, Walk};

/// Period of the gait in times of a fall from the height of the root, sqrt(h/g).
const PERIOD: f64 = 2.6;
/// Height to which feet are lifted, in heights of the root.
const LIFT: f64 = 0.18;
/// Balance of a step, in times of a fall.
const BALANCE: f64 = 0.35;
/// Share of what the root lacks of its height that a step adds.
const RAISE: f64 = 0.05;
/// Share of what the velocity lacks of the command that a step adds.
const HURRY: f64 = 0.01;
/// Share of the lean that feet push against.
const LEVEL: f64 = 0.6;
/// Most that corrections change, in heights of the root and in shares of the walking speed.
const MOST: f64 = 0.5;
/// Acceleration that commands are limited to, in walking speeds a second.
const RAMP: f64 = 2.0;
/// Share of the walking speed below which the body stands.
const STILL: f64 = 0.02;

/// A body that trots at a wanted velocity.
pub struct Trotter {
    legs: Legs,
    steps: Steps,
    walk: Walk,
    forward: Vec3,
    /// Height of the root over its feet when it stands \[m\].
    height: f64,
    /// Velocity that the feet follow now.
    now: [f64; 3],
    lacking: [f64; 3],
    raised: f64,
    places: Vec<Vec3>,
}

impl Trotter {
    /// The body with four legs whose elements have names that begin with `prefix`.
    ///
    /// # Errors
    /// A task without roles; a body that has not four feet, or whose legs are not of servos.
    pub fn new(env: &Env, prefix: &str) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let Body { root, feet, stand, walk, forward } = Body::new(env, prefix, "trot", 4)?;
        let mut legs = Legs::new(env, root, &feet, &stand)?;
        let homes: Vec<Vec3> = legs.homes(m).into_iter().map(|home| turned(home, forward)).collect();
        let height = -homes.iter().map(|home| home[2]).fold(f64::INFINITY, f64::min);
        let fall = (height / 9.81).sqrt();
        let gait = Gait { period: PERIOD * fall, duty: 0.55, lift: LIFT * height, balance: BALANCE * fall };
        Ok(Trotter {
            steps: Steps::trot(gait, &homes),
            walk,
            forward,
            height,
            now: [0.0; 3],
            lacking: [0.0; 3],
            raised: 0.0,
            places: homes,
            legs,
        })
    }

    /// Stands, as at the beginning of an episode.
    pub fn restart(&mut self, env: &Env) {
        self.legs.restart(&env.scene().model);
        self.steps.restart();
        (self.now, self.lacking, self.raised) = ([0.0; 3], [0.0; 3], 0.0);
    }

    /// What a wish is made of.
    pub fn facts<'a>(&self, rows: OwnRows<'a>) -> Facts<'a> {
        Facts { rows, walk: self.walk, height: self.height }
    }

    /// Velocity that the feet are to follow: what is wanted, approached at a limited rate, with what the body lacked of it.
    fn follow(&mut self, wanted: [f64; 3], measured: [f64; 3], dt: f64) -> [f64; 3] {
        let Walk { speed, turn } = self.walk;
        let most = [speed, speed, turn];
        for i in 0..3 {
            let step = RAMP * most[i] * dt;
            self.now[i] += (wanted[i] - self.now[i]).clamp(-step, step);
            let lacking = self.lacking[i] + HURRY * (self.now[i] - measured[i]);
            self.lacking[i] = lacking.clamp(-MOST * most[i], MOST * most[i]);
        }
        [0, 1, 2].map(|i| self.now[i] + self.lacking[i])
    }

    /// Writes the controls of the body into `controls` (nu) by which it trots at `wanted`: forward, to the left \[m/s\],
    /// counterclockwise \[rad/s\]. `rows` is what the body observes.
    pub fn trot(&mut self, env: &Env, rows: OwnRows<'_>, wanted: [f64; 3], controls: &mut [f64]) {
        let dt = env.dt();
        let measured = [rows["velocity"][0], rows["velocity"][1], rows["turning"][2]];
        let velocity = self.follow(wanted, measured, dt);
        let Walk { speed, turn } = self.walk;
        let moves = |v: [f64; 3]| (v[0].abs() + v[1].abs()) / speed + v[2].abs() / turn;
        if moves(self.now) > STILL || moves(measured) > 0.5 {
            self.steps.advance(velocity, measured, dt);
        } else {
            self.steps.restart();
        }
        self.places.clone_from_slice(self.steps.places());
        let wanted = rows.get("height_command").map_or(self.height, |row| row[0]);
        let most = MOST * self.height;
        self.raised = (self.raised + RAISE * (wanted - rows["height"][0])).clamp(-most, most);
        let [ahead, left, _] = [rows["up"][0], rows["up"][1], rows["up"][2]];
        let lowered = |&[x, y, z]: &Vec3| {
            let level = LEVEL * (ahead * x + left * y);
            let place = back([x, y, z + self.height - wanted - self.raised + level], self.forward);
            Pose { position: Some(place), orientation: None }
        };
        let feet: Vec<Pose> = self.places.iter().map(lowered).collect();
        self.legs.solve(&env.scene().model, &feet, dt, controls);
    }
}

/// The controller.
pub struct Trot {
    body: Trotter,
    wish: Wish,
    controls: Vec<f64>,
}

impl Trot {
    /// The controller for a body with four legs.
    ///
    /// # Errors
    /// As [`Trotter::new`].
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let controls = vec![0.0; env.scene().model.nu];
        Ok(Trot { body: Trotter::new(env, "")?, wish: wish(&env.spec().task), controls })
    }
}

impl Controller for Trot {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        self.body.restart(env);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let rows = env.rows().of("");
        let wanted = (self.wish)(&self.body.facts(rows));
        self.body.trot(env, rows, wanted, &mut self.controls);
        command(env, &self.controls, action)
    }
}

/// A vector of the root's frame in the frame whose first axis is `forward`.
fn turned([x, y, z]: Vec3, [c, s, _]: Vec3) -> Vec3 {
    [c * x + s * y, c * y - s * x, z]
}

/// The inverse of [`turned`].
fn back([x, y, z]: Vec3, [c, s, _]: Vec3) -> Vec3 {
    [c * x - s * y, s * x + c * y, z]
}
