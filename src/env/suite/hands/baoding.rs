//! Two balls that circle each other in the palm of the hand of Nagabandi et al. (2019).

use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::baoding::{Following, KEYS, Orbit, Pairs, jumps, wrist_error};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use physics::math::{add, quat_rotate};
use robot::Compat;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_4;

/// Angles \[rad\] at which the balls start on their orbit.
const STARTS: [f64; 2] = [3.0 * FRAC_PI_4, -FRAC_PI_4];
/// How far in front of the palm the balls are \[m\].
const DEPTH: f64 = -0.045;
/// A ball closer than this to its target \[m\] is there.
const NEAR: f64 = 0.015;
/// A ball below this height \[m\] fell.
const DROP: f64 = 0.06;
/// How much softer the hand is than its model says.
const SOFTER: f64 = 0.1;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    n_shifts_per_period: Option<i64>,
}

#[derive(Clone)]
pub struct Baoding {
    pairs: Pairs,
    palm: BodyId,
    orbit: Orbit,
    compat: Compat,
}

impl Baoding {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit; the model lacks the palm, the balls, the targets or a keyframe.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let jumps = jumps(setup.spec, args.n_shifts_per_period)?;
        // The original does this once for the simulation and once for the observed one, which are the same.
        let times = if setup.compat == Compat::RoboHive07 { 2 } else { 1 };
        for _ in 0..times {
            setup.scene.overwrite(|m| {
                let (gains, biases) =
                    (m.actuator_gainprm.as_flattened_mut(), m.actuator_biasprm.as_flattened_mut());
                gains.iter_mut().for_each(|number| *number *= SOFTER);
                biases.iter_mut().for_each(|number| *number *= SOFTER);
            })?;
        }
        if setup.scene.model.nkey == 0 {
            return Err(setup.wrong("the model has no keyframe, and the hand starts in its first one"));
        }
        Ok(Baoding {
            pairs: Pairs::find(setup.scene)?,
            palm: setup.scene.body("palm")?,
            orbit: Orbit { radii: [0.03, 0.036], center: [0.005, 0.06], period: 6.0, direction: 1.0, jumps },
            compat: setup.compat,
        })
    }

    /// Puts the targets where they are in a step, which moves with the palm.
    fn place_targets(&self, scene: &mut Scene, steps: usize, dt: f64) -> Result<(), EnvError> {
        let angle = self.orbit.angle(steps, dt);
        let palm = scene.data.body(self.palm);
        let (origin, turned) = (*palm.xpos(), *palm.xquat());
        for (target, start) in self.pairs.targets.iter().zip(STARTS) {
            let [x, z] = self.orbit.at(angle + start);
            let place = add(origin, quat_rotate(turned, [x, DEPTH, z]));
            scene.overwrite(|m| m.site_pos[target.index()] = place)?;
        }
        Ok(())
    }
}

impl Task for Baoding {
    fn defaults(&self) -> Defaults {
        let weights = [
            ("pos_dist_1", 5.0),
            ("pos_dist_2", 5.0),
            ("drop_penalty", 500.0),
            ("wrist_angle", 0.5),
            ("act_reg", 1.0),
            ("bonus", 1.0),
        ];
        Defaults::new(&KEYS, &weights, 40)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos.copy_from_slice(&scene.model.key_qpos[..scene.model.nq]);
        Ok(())
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        if self.compat == Compat::Fixed {
            // In the original, targets stay where the episode before left them until the first step.
            self.place_targets(episode.scene, 0, 0.0)?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.place_targets(turn.scene, turn.steps, turn.dt)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.pairs.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let following = Following::of(rows, NEAR, DROP);
        let [first, second] = following.distances;
        terms.set("pos_dist_1", "m", [-first]);
        terms.set("pos_dist_2", "m", [-second]);
        terms.set("drop_penalty", "", [-f64::from(following.fallen)]);
        terms.set("wrist_angle", "rad", [-wrist_error(rows)]);
        // The hand has no activations to keep small.
        terms.set("act_reg", "", [0.0]);
        terms.set("bonus", "", [following.bonus()]);
        Verdict {
            sparse: -(first + second),
            solved: following.both() && !following.fallen,
            done: following.fallen,
        }
    }
}
