//! Pose: joints are to take target angles.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations};
use crate::suite::named::Named;
use crate::task::{Defaults, Episode, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::f64::consts::TAU;

/// Beyond this distance \[rad\] the episode ends.
const FAR: f64 = TAU;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    #[serde(default)]
    viz_site_targets: Vec<String>,
    target_jnt_range: Option<Named<[f64; 2]>>,
    target_jnt_value: Option<Vec<f64>>,
    #[serde(default)]
    reset_type: Start,
    #[serde(default)]
    target_type: TargetType,
    #[serde(default = "pose_thd")]
    pose_thd: f64,
    weight_bodyname: Option<String>,
    weight_range: Option<[f64; 2]>,
    #[serde(default)]
    muscle_condition: Condition,
}

fn pose_thd() -> f64 {
    0.35
}

/// Where episodes start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Start {
    /// In the initial pose.
    #[default]
    Init,
    /// Anywhere within the ranges of the joints.
    Random,
}

/// Where target angles come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum TargetType {
    /// Drawn from ranges.
    #[default]
    Generate,
    /// The same in every episode.
    Fixed,
}

/// A ball in the hand whose mass is drawn.
#[derive(Clone)]
struct Weight {
    body: BodyId,
    range: [f64; 2],
    compat: Compat,
}

#[derive(Clone)]
pub struct Pose {
    muscles: Muscles,
    /// Sites and those that show where they belong.
    sites: Vec<[SiteId; 2]>,
    /// Bounds of the target angles; none where they are the same in every episode.
    ranges: Option<[Vec<f64>; 2]>,
    /// Target angles (nq).
    target: Vec<f64>,
    start: Start,
    near: f64,
    weight: Option<Weight>,
}

impl Pose {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit each other or the model.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let scene = &*setup.scene;
        let ranges = match (&args.target_jnt_range, args.target_type) {
            (Some(named), TargetType::Generate) => {
                for (joint, _) in &named.0 {
                    scene.joint(joint)?;
                }
                Some([0, 1].map(|end| named.0.iter().map(|(_, range)| range[end]).collect::<Vec<f64>>()))
            }
            (None, TargetType::Generate) => {
                return Err(setup.wrong("target_jnt_range is missing; or target_type is \"fixed\""));
            }
            (_, TargetType::Fixed) => None,
        };
        let target = match &ranges {
            Some([low, high]) => low.iter().zip(high).map(|(low, high)| (low + high) / 2.0).collect(),
            None => args.target_jnt_value.ok_or_else(|| setup.wrong("target_jnt_value is missing"))?,
        };
        let nq = scene.model.nq;
        if target.len() != nq {
            let message =
                format!("{} target angles are given, and the model has {nq} joint positions", target.len());
            return Err(setup.wrong(message));
        }
        let pair = |site: &String| Ok([scene.site(site)?, scene.site(&format!("{site}_target"))?]);
        let sites = args.viz_site_targets.iter().map(pair).collect::<Result<_, EnvError>>()?;
        let weight = match (args.weight_bodyname, args.weight_range) {
            (Some(name), Some(range)) => {
                Some(Weight { body: scene.body(&name)?, range, compat: setup.compat })
            }
            (None, None) => None,
            _ => return Err(setup.wrong("weight_bodyname and weight_range belong together")),
        };
        Ok(Pose { muscles, sites, ranges, target, start: args.reset_type, near: args.pose_thd, weight })
    }
}

impl Weight {
    /// Draws the mass, from which the radius of the ball follows.
    fn draw(&self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        let mass = rng.uniform(self.range[0], self.range[1])?;
        let radius = 0.01 + 2.5 * mass / 100.0;
        let body = self.body.index();
        let geom = scene.model.body_geomadr[body] as usize;
        scene.edit(self.compat, |m| {
            m.body_mass[body] = mass;
            m.geom_size[geom][0] = radius;
            if self.compat == Compat::Fixed {
                m.body_inertia[body] = [0.4 * mass * radius * radius; 3];
            }
        })
    }
}

impl Pose {
    /// Draws target angles where they are drawn, and shows where sites belong at these angles.
    fn set_target(&mut self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        if let Some([low, high]) = &self.ranges {
            rng.fill_uniform_each(low, high, &mut self.target)?;
        }
        scene.data.state.qpos.copy_from_slice(&self.target);
        scene.forward()?;
        for [site, shown] in &self.sites {
            let place = *scene.data.site(*site).xpos();
            scene.overwrite(|m| m.site_pos[shown.index()] = place)?;
        }
        Ok(())
    }
}

impl Task for Pose {
    fn defaults(&self) -> Defaults {
        let weights = [("pose", 1.0), ("bonus", 4.0), ("act_reg", 1.0), ("penalty", 50.0)];
        self.muscles.defaults(&["qpos", "qvel", "pose_err"], &weights)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        if let Some(weight) = &self.weight {
            weight.draw(episode.scene, episode.rng)?;
        }
        self.set_target(episode.scene, episode.rng)?;
        if self.start == Start::Random {
            for (position, &[low, high]) in
                episode.start.qpos.iter_mut().zip(&episode.scene.model.jnt_range[..])
            {
                *position = episode.rng.uniform(low, high)?;
            }
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        rows.set("qpos", "rad", &state.qpos);
        rows.set("qvel", "rad", state.qvel.iter().map(|velocity| velocity * view.dt));
        if view.model.na > 0 {
            observe_activations(view, rows);
        } else {
            rows.set("act", "", state.qpos.iter().map(|_| 0.0));
        }
        rows.set(
            "pose_err",
            "rad",
            self.target.iter().zip(&state.qpos).map(|(target, angle)| target - angle),
        );
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(&rows["pose_err"]);
        let within = |threshold| f64::from(distance < threshold);
        let far = distance > FAR;
        terms.set("pose", "rad", [-distance]);
        terms.set("bonus", "", [within(self.near) + within(1.5 * self.near)]);
        terms.set("penalty", "", [-f64::from(far)]);
        terms.set("act_reg", "", [-effort(rows)]);
        Verdict { sparse: -distance, solved: distance < self.near, done: far }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
        keeper.numbers(&mut self.target);
    }
}
