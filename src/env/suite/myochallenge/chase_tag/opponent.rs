//! The opponent: a body that moves on the plane, by one of several policies.

use super::noise::Noise;
use super::repeller;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::{euler_of_quat, norm, quat_of_euler};
use crate::scene::Scene;
use physics::Data;
use physics::elements::BodyId;
use physics::math::ops;
use robot::Keeper;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The opponent stays within this distance of the middle, along x and along y \[m\].
const ARENA: f64 = 5.5;
/// It appears within this distance.
const SPAWN: f64 = 5.0;
/// Where it stands when it never moves: position \[m\] and heading \[rad\].
const STAND: [f64; 3] = [0.0, -5.0, 0.0];
/// Fastest motion \[m/s\] and turn \[rad/s\].
const FASTEST: f64 = 2.0;

/// How the opponent moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Policy {
    /// It stands at a fixed place.
    Fixed,
    /// It stands where it appeared.
    Stationary,
    /// It follows noise.
    Random,
    /// It runs away from the agent and the walls.
    Repelled,
    /// It chases the agent.
    Chasing,
}

/// What varies between opponents.
#[derive(Clone, Debug)]
pub struct OpponentArgs {
    /// Probabilities of [`Policy::Fixed`], [`Policy::Stationary`] and [`Policy::Random`].
    pub probabilities: [f64; 3],
    /// Whether it runs away otherwise.
    pub repelled: bool,
    /// Distance from the agent at which it may appear \[m\].
    pub spawn_distance: f64,
    /// Speeds of the chase \[m/s\].
    pub chase_speeds: [f64; 2],
    /// Bounds of random motion \[m/s, rad/s\].
    pub random_speeds: [f64; 2],
    /// Bounds of the speed of an escape \[m/s\].
    pub escape_speeds: [f64; 2],
}

/// The opponent in an episode.
#[derive(Clone)]
pub struct Opponent {
    args: OpponentArgs,
    /// Which of the mocap bodies it is.
    mocap: usize,
    root: BodyId,
    pelvis: BodyId,
    policy: Policy,
    velocity: [f64; 2],
    chase_speed: f64,
    noise: Noise,
}

impl Opponent {
    /// An opponent somewhere in the scene.
    ///
    /// # Errors
    /// The model lacks the opponent or the agent; ranges that cannot be drawn from.
    pub fn new(args: OpponentArgs, scene: &mut Scene, rng: &mut Rng) -> Result<Self, EnvError> {
        let mocap = scene.model.body_mocapid[scene.body("opponent")?.index()];
        let mut opponent = Opponent {
            args,
            mocap: usize::try_from(mocap)
                .map_err(|_| EnvError::missing("mocap body", "opponent", [].into_iter()))?,
            root: scene.body("root")?,
            pelvis: scene.body("pelvis")?,
            policy: Policy::Stationary,
            velocity: [0.0; 2],
            chase_speed: 0.0,
            noise: Noise::new(rng)?,
        };
        opponent.appear(false, scene, rng)?;
        Ok(opponent)
    }

    /// Writes or reads what an episode drew of it, its motion, and the noise that it follows.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        use Policy::{Chasing, Fixed, Random, Repelled, Stationary};
        keeper.choice(&mut self.policy, &[Fixed, Stationary, Random, Repelled, Chasing]);
        keeper.numbers(&mut self.velocity);
        keeper.number(&mut self.chase_speed);
        self.noise.keep(keeper);
    }

    /// Starts an episode: draws noise, policy, place and speed.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from.
    pub fn reset(&mut self, chasing: bool, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        self.noise.redraw(rng)?;
        self.appear(chasing, scene, rng)
    }

    fn appear(&mut self, chasing: bool, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        self.velocity = [0.0; 2];
        self.policy = if chasing { Policy::Chasing } else { self.draw_policy(rng) };
        let [x, y, _] = *scene.data.body(self.root).xpos();
        let mut pose = [x, y, 0.0];
        while norm(&[pose[0] - x, pose[1] - y]) < self.args.spawn_distance {
            pose = [rng.uniform(-SPAWN, SPAWN)?, rng.uniform(-SPAWN, SPAWN)?, rng.uniform(-TAU, TAU)?];
        }
        if self.policy == Policy::Fixed {
            pose = STAND;
        }
        self.place(&mut scene.data, pose);
        let [slowest, fastest] = self.args.chase_speeds;
        self.chase_speed = rng.uniform(slowest, fastest)?;
        Ok(())
    }

    fn draw_policy(&self, rng: &mut Rng) -> Policy {
        let [fixed, stationary, random] = self.args.probabilities;
        let drawn = rng.random();
        if drawn < fixed {
            Policy::Fixed
        } else if drawn < fixed + stationary {
            Policy::Stationary
        } else if self.args.repelled && drawn >= fixed + stationary + random {
            Policy::Repelled
        } else {
            Policy::Random
        }
    }

    /// Position \[m\] and heading \[rad, within ±π\].
    pub fn pose(&self, data: &Data) -> [f64; 3] {
        let [x, y, _] = data.state.mocap_pos[self.mocap];
        [x, y, euler_of_quat(data.state.mocap_quat[self.mocap])[2]]
    }

    /// The last motion: forwards \[m/s\] and turning \[rad/s\], as the policy wanted it.
    pub fn velocity(&self) -> [f64; 2] {
        self.velocity
    }

    fn place(&self, data: &mut Data, [x, y, heading]: [f64; 3]) {
        data.state.mocap_pos[self.mocap][..2].copy_from_slice(&[x, y]);
        data.state.mocap_quat[self.mocap] = quat_of_euler([0.0, 0.0, heading]);
    }

    /// Moves for `dt` seconds.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from.
    pub fn advance(&mut self, data: &mut Data, rng: &mut Rng, dt: f64) -> Result<(), EnvError> {
        let [x, y, heading] = self.pose(data);
        let [agent_x, agent_y, _] = *data.body(self.pelvis).xpos();
        let [speed, turn] = match self.policy {
            Policy::Fixed | Policy::Stationary => [0.0; 2],
            Policy::Random => {
                let [low, high] = self.args.random_speeds;
                self.noise.sample(rng)?.map(|value| value.clamp(low, high))
            }
            Policy::Repelled => {
                let speeds = self.args.escape_speeds;
                repeller::escape([x, y, heading], [agent_x, agent_y], speeds, &mut self.noise, rng)?
            }
            Policy::Chasing => {
                let (sine, cosine) = (ops::sin(heading), ops::cos(heading));
                [self.chase_speed, cosine * (agent_x - x) + sine * (agent_y - y)]
            }
        };
        self.velocity = [speed.abs(), turn];
        let [speed, turn] = self.velocity.map(|value| value.clamp(-FASTEST, FASTEST));
        let (along_x, along_y) = (ops::cos(heading + FRAC_PI_2), ops::sin(heading + FRAC_PI_2));
        let moved = |from: f64, along: f64| (from - dt * speed * along).clamp(-ARENA, ARENA);
        self.place(data, [moved(x, along_x), moved(y, along_y), heading + dt * turn]);
        Ok(())
    }
}
