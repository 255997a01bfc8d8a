//! Two balls that circle each other in the palm, or rest there.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::baoding::{Following, KEYS};
use crate::suite::circling::{Circling, draw_radii, open_hand};
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::{BodyId, GeomId};
use physics::geometry::shape;
use physics::math::Vec3;
use physics::model::{Draft, GeomType};
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// Time of a turn \[s\] before the first reset.
const FIRST_PERIOD: f64 = 6.0;

#[derive(Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Args {
    /// Height below which a ball is dropped \[m\].
    drop_th: f64,
    /// Distance from its target within which a ball is right \[m\].
    proximity_th: f64,
    /// Time of a turn \[s\].
    goal_time_period: [f64; 2],
    /// Half axes of the path \[m\].
    goal_xrange: [f64; 2],
    goal_yrange: [f64; 2],
    /// Radius of the balls \[m\].
    obj_size_range: Option<[f64; 2]>,
    /// Mass of a ball \[kg\].
    obj_mass_range: Option<[f64; 2]>,
    /// Largest change of the coefficients of friction.
    obj_friction_change: Option<Vec3>,
    task_choice: Choice,
}

impl Default for Args {
    fn default() -> Self {
        Args {
            drop_th: 1.25,
            proximity_th: 0.015,
            goal_time_period: [5.0; 2],
            goal_xrange: [0.025; 2],
            goal_yrange: [0.028; 2],
            obj_size_range: None,
            obj_mass_range: None,
            obj_friction_change: None,
            task_choice: Choice::Fixed,
        }
    }
}

/// Whether the way of the balls is drawn.
#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Choice {
    /// Against the clock, always.
    Fixed,
    /// Any way, from any place.
    Random,
}

/// Ways of the balls: how many turns a period has, in the original's order.
const WAYS: [f64; 3] = [0.0, -1.0, 1.0];
const AGAINST_THE_CLOCK: f64 = WAYS[2];

/// What a reset draws for each ball.
#[derive(Clone, Default)]
struct Balls {
    mass: Option<[f64; 2]>,
    friction: Option<[Vec3; 2]>,
    radius: Option<[f64; 2]>,
}

#[derive(Clone)]
pub struct Baoding {
    args: Args,
    compat: Compat,
    muscles: Muscles,
    bodies: [BodyId; 2],
    geoms: [GeomId; 2],
    circling: Circling,
    /// Bounds of the coefficients of friction.
    friction: Option<[Vec3; 2]>,
}

impl Baoding {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings are wrong, or the model lacks the balls or their targets.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(Condition::None, setup)?;
        let random = args.task_choice == Choice::Random;
        let way = if random { *setup.rng.choose(&WAYS)? } else { AGAINST_THE_CLOCK };
        let radii = draw_radii([args.goal_xrange, args.goal_yrange], setup.rng)?;
        let scene = &*setup.scene;
        let geoms = [scene.geom("ball1")?, scene.geom("ball2")?];
        let nominal = scene.model.geom_friction[geoms[0].index()];
        let bound = |side: f64, change: Vec3| [0, 1, 2].map(|k| nominal[k] + side * change[k]);
        let mut circling = Circling::new(scene, radii, FIRST_PERIOD, opposite(FRAC_PI_4))?;
        circling.orbit.direction = way;
        Ok(Baoding {
            compat: setup.compat,
            muscles,
            bodies: [scene.body("ball1")?, scene.body("ball2")?],
            geoms,
            circling,
            friction: args.obj_friction_change.map(|change| [bound(-1.0, change), bound(1.0, change)]),
            args,
        })
    }
}

/// Angles of two balls \[rad\] opposite each other; the first is at `angle`.
fn opposite(angle: f64) -> [f64; 2] {
    [angle, angle - PI]
}

/// Two numbers, the first ball's and the second's.
fn draw_pair(range: Option<[f64; 2]>, rng: &mut Rng) -> Result<Option<[f64; 2]>, EnvError> {
    let Some([low, high]) = range else { return Ok(None) };
    Ok(Some([rng.uniform(low, high)?, rng.uniform(low, high)?]))
}

impl Baoding {
    fn draw_path(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        if self.args.task_choice == Choice::Random {
            self.circling.orbit.direction = *rng.choose(&WAYS)?;
            self.circling.starts = opposite(rng.uniform(0.0, TAU)?);
        }
        self.circling.orbit.radii = draw_radii([self.args.goal_xrange, self.args.goal_yrange], rng)?;
        let [low, high] = self.args.goal_time_period;
        self.circling.orbit.period = rng.uniform(low, high)?;
        Ok(())
    }

    fn draw_balls(&self, rng: &mut Rng) -> Result<Balls, EnvError> {
        let mass = draw_pair(self.args.obj_mass_range, rng)?;
        let mut friction = self.friction.map(|_| [[0.0; 3]; 2]);
        if let (Some([low, high]), Some(friction)) = (&self.friction, &mut friction) {
            for ball in friction {
                rng.fill_uniform_each(low, high, ball)?;
            }
        }
        Ok(Balls { mass, friction, radius: draw_pair(self.args.obj_size_range, rng)? })
    }

    /// Writes the balls into a model; with `inertia`, also their moments of inertia, which the original leaves as they were.
    fn impose(&self, balls: &Balls, m: &mut Draft<'_>, inertia: bool) {
        for k in 0..2 {
            let (body, geom) = (self.bodies[k].index(), self.geoms[k].index());
            if let Some(mass) = balls.mass {
                m.body_mass[body] = mass[k];
            }
            if let Some(friction) = balls.friction {
                m.geom_friction[geom] = friction[k];
            }
            if let Some(radius) = balls.radius {
                m.geom_size[geom] = [radius[k]; 3];
            }
            if inertia {
                m.body_inertia[body] =
                    shape::inertia(GeomType::Sphere, m.geom_size[geom], m.body_mass[body], false);
            }
        }
    }
}

impl Task for Baoding {
    fn defaults(&self) -> Defaults {
        let weights = [("pos_dist_1", 5.0), ("pos_dist_2", 5.0)];
        Defaults { success: Success::Share, ..self.muscles.defaults(&KEYS, &weights) }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        open_hand(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        self.draw_path(episode.rng)?;
        let balls = self.draw_balls(episode.rng)?;
        let fixed = self.compat == Compat::Fixed;
        if balls.mass.is_some() || balls.friction.is_some() || balls.radius.is_some() {
            episode.scene.edit(self.compat, |m| self.impose(&balls, m, fixed))?;
        }
        if fixed {
            // In the original, targets stay where the episode before left them until the first step.
            self.circling.place_targets(episode.scene, 0, 0.0)?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.circling.place_targets(turn.scene, turn.steps, turn.dt)?;
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.circling.pairs.observe(view, rows);
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let following = Following::of(rows, self.args.proximity_th, self.args.drop_th);
        let [first, second] = following.distances;
        terms.set("pos_dist_1", "m", [-first]);
        terms.set("pos_dist_2", "m", [-second]);
        terms.set("act_reg", "", [-effort(rows)]);
        Verdict {
            sparse: -(first + second),
            solved: following.both() && !following.fallen,
            done: following.fallen,
        }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
        self.circling.keep(keeper);
    }
}
