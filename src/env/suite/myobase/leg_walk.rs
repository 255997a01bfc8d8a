//! Walking at a given speed, on flat ground or on a relief.

use super::terrain::{self, Relief, Terrain};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::{mat_of_quat, norm};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations, observe_muscles};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use physics::math::{Vec3, add_scaled, ops, scale, sub};
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::f64::consts::{PI, TAU};

/// Height \[m\] of the centre of mass above the feet below which legs kneel.
const KNEELING: f64 = 0.61;
/// How far \[rad\] hips swing.
const SWING: f64 = 0.8;
/// Standard deviation of positions that are drawn.
const NOISE: f64 = 0.02;
/// Joint positions that the row `qpos_without_xy` leaves out.
const SKIPPED: usize = 2;
/// Joint positions that orient the pelvis.
const ROTATION: std::ops::Range<usize> = 3..7;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    #[serde(default = "eight_tenths")]
    min_height: f64,
    #[serde(default = "eight_tenths")]
    max_rot: f64,
    #[serde(default = "hip_period")]
    hip_period: f64,
    #[serde(default)]
    reset_type: Start,
    #[serde(default)]
    target_x_vel: f64,
    #[serde(default = "target_y_vel")]
    target_y_vel: f64,
    target_rot: Option<[f64; 4]>,
    terrain: Option<Relief>,
    variant: Option<String>,
    #[serde(default)]
    muscle_condition: Condition,
}

fn eight_tenths() -> f64 {
    0.8
}

fn hip_period() -> f64 {
    100.0
}

fn target_y_vel() -> f64 {
    1.2
}

/// Where episodes start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Start {
    /// In the middle of a step.
    #[default]
    Init,
    /// About the middle of a step, of the left leg or of the right.
    Random,
    /// Upright.
    Stand,
}

/// The bodies that are observed.
#[derive(Clone, Copy)]
struct Bodies {
    torso: BodyId,
    pelvis: BodyId,
    feet: [BodyId; 2],
}

/// Places of joint angles among the positions.
#[derive(Clone, Copy)]
struct Hips {
    /// Flexion, left and right.
    flexion: [usize; 2],
    /// Adduction and rotation, left and right.
    spread: [usize; 4],
}

#[derive(Clone)]
pub struct LegWalk {
    muscles: Muscles,
    terrain: Option<Terrain>,
    bodies: Bodies,
    hips: Hips,
    start: Start,
    min_height: f64,
    max_rot: f64,
    /// Steps of a walking cycle.
    period: f64,
    /// Velocities to walk with \[m/s\].
    velocity: [f64; 2],
    /// The orientation of the pelvis that is rewarded.
    upright: [f64; 4],
    compat: Compat,
}

impl LegWalk {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or elements are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let fixed = args.variant.as_deref() == Some("fixed");
        let terrain = match args.terrain {
            Some(relief) => Some(Terrain::new(setup.scene, relief, fixed, setup.compat)?),
            None => {
                terrain::remove(setup.scene)?;
                None
            }
        };
        let scene = &*setup.scene;
        let mut pose = Pose { qpos: vec![0.0; scene.model.nq], qvel: vec![0.0; scene.model.nv] };
        terrain::key_pose(&scene.model, 0, &mut pose)?;
        Ok(LegWalk {
            muscles,
            terrain,
            bodies: Bodies {
                torso: scene.body("torso")?,
                pelvis: scene.body("pelvis")?,
                feet: [scene.body("talus_l")?, scene.body("talus_r")?],
            },
            hips: Hips {
                flexion: places(scene, ["hip_flexion_l", "hip_flexion_r"])?,
                spread: places(
                    scene,
                    ["hip_adduction_l", "hip_adduction_r", "hip_rotation_l", "hip_rotation_r"],
                )?,
            },
            start: args.reset_type,
            min_height: args.min_height,
            max_rot: args.max_rot,
            period: args.hip_period,
            velocity: [args.target_x_vel, args.target_y_vel],
            upright: args.target_rot.unwrap_or_else(|| std::array::from_fn(|k| pose.qpos[ROTATION][k])),
            compat: setup.compat,
        })
    }
}

/// Where the angles of joints stand in the row `qpos_without_xy`.
fn places<const N: usize>(scene: &Scene, names: [&str; N]) -> Result<[usize; N], EnvError> {
    let mut places = [0; N];
    for (place, name) in places.iter_mut().zip(names) {
        let joint = scene.joint(name)?;
        *place = scene.model.jnt_qposadr[joint.index()] as usize - SKIPPED;
    }
    Ok(places)
}

/// The mean of a vector of every body, weighted by mass.
fn mean_by_mass<'a>(view: &View<'_>, vectors: impl Iterator<Item = &'a [f64]>) -> Vec3 {
    let masses = &view.model.body_mass;
    let sum = masses
        .iter()
        .zip(vectors)
        .fold([0.0; 3], |sum, (&mass, vector)| add_scaled(sum, [vector[0], vector[1], vector[2]], mass));
    scale(sum, 1.0 / masses.iter().sum::<f64>())
}

impl LegWalk {
    /// Part of the walking cycle that has passed, from 0 to 1. The original counts a step after its observation.
    fn phase(&self, view: &View<'_>) -> f64 {
        let steps = (view.data.time() / view.dt).round();
        let counted = if self.compat == Compat::Fixed { steps } else { (steps - 1.0).max(0.0) };
        counted / self.period % 1.0
    }

    /// How far \[rad\] the flexion of the hips is from where the cycle wants it.
    fn off_cycle(&self, rows: &Rows) -> f64 {
        let angle = TAU * rows["phase_var"][0];
        let wanted = [SWING * ops::cos(angle + PI), SWING * ops::cos(angle)];
        let single = |x: f64| if self.compat == Compat::Fixed { x } else { f64::from(x as f32) };
        let hips = self.hips.flexion.map(|place| rows["qpos_without_xy"][place]);
        norm(&[single(wanted[0]) - hips[0], single(wanted[1]) - hips[1]])
    }

    /// Whether the legs have fallen, turned away or sunk to their knees.
    fn fallen(&self, rows: &Rows) -> bool {
        let height = rows["height"][0];
        let rotation = mat_of_quat(pelvis_rotation(rows));
        let feet = &rows["feet_heights"];
        let kneels = self.terrain.is_some() && height - (feet[0] + feet[1]) / 2.0 < KNEELING;
        height < self.min_height || rotation[0].abs() > self.max_rot || kneels
    }

    /// Starts about the middle of a step. The original means to keep the height and the rotation of the pelvis, and
    /// keeps the height.
    fn draw_start(&self, scene: &Scene, rng: &mut Rng, start: &mut Pose) -> Result<(), EnvError> {
        let key = if rng.random() < 0.5 { 2 } else { 3 };
        terrain::key_pose(&scene.model, key, start)?;
        for (place, position) in start.qpos.iter_mut().enumerate() {
            let noise = rng.normal(0.0, NOISE)?;
            let kept = place == 2 || (self.compat == Compat::Fixed && ROTATION.contains(&place));
            if !kept {
                *position += noise;
            }
        }
        Ok(())
    }
}

fn pelvis_rotation(rows: &Rows) -> [f64; 4] {
    std::array::from_fn(|k| rows["qpos_without_xy"][ROTATION.start - SKIPPED + k])
}

impl Task for LegWalk {
    fn defaults(&self) -> Defaults {
        let rows = [
            "qpos_without_xy",
            "qvel",
            "com_vel",
            "torso_angle",
            "feet_heights",
            "height",
            "feet_rel_positions",
            "phase_var",
            "muscle_length",
            "muscle_velocity",
            "muscle_force",
        ];
        let weights = [
            ("vel_reward", 5.0),
            ("done", -100.0),
            ("cyclic_hip", -10.0),
            ("ref_rot", 10.0),
            ("joint_angle_rew", 5.0),
        ];
        self.muscles.defaults(&rows, &weights)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        terrain::key_pose(&scene.model, 0, pose)?;
        pose.qvel.fill(0.0);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        if let Some(terrain) = &mut self.terrain {
            terrain.draw(episode.scene, episode.rng)?;
        }
        match self.start {
            Start::Random => self.draw_start(episode.scene, episode.rng, episode.start),
            Start::Init => terrain::key_pose(&episode.scene.model, 2, episode.start),
            Start::Stand => terrain::key_pose(&episode.scene.model, 0, episode.start),
        }
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (state, data) = (&view.data.state, view.data);
        let place = |body: BodyId| *data.body(body).xpos();
        let [left, right] = self.bodies.feet.map(place);
        let pelvis = place(self.bodies.pelvis);
        rows.set("t", "s", [data.time()]);
        rows.set("qpos_without_xy", "m, rad", &state.qpos[SKIPPED..]);
        rows.set("qvel", "m, rad", state.qvel.iter().map(|velocity| velocity * view.dt));
        let velocity = mean_by_mass(view, data.vel.cvel.iter().map(|velocity| &velocity[3..]));
        rows.set("com_vel", "m/s", [-velocity[0], -velocity[1]]);
        rows.set("torso_angle", "", data.body(self.bodies.torso).xquat());
        rows.set("feet_heights", "m", [left[2], right[2]]);
        rows.set("height", "m", [mean_by_mass(view, data.kin.xipos.iter().map(|center| &center[..]))[2]]);
        let feet = [left, right].into_iter().flat_map(|foot| sub(foot, pelvis));
        rows.set("feet_rel_positions", "m", feet);
        rows.set("phase_var", "", [self.phase(view)]);
        observe_muscles(view, rows);
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let bell = |k: usize| {
            let off = self.velocity[k] - rows["com_vel"][k];
            ops::exp(-off * off)
        };
        let velocity = bell(1) + bell(0);
        let rotation = pelvis_rotation(rows);
        let turned = norm(&std::array::from_fn::<_, 4, _>(|k| 5.0 * (rotation[k] - self.upright[k])));
        let angle = |&place: &usize| rows["qpos_without_xy"][place].abs();
        let spread = self.hips.spread.iter().map(angle).sum::<f64>() / self.hips.spread.len() as f64;
        let done = self.fallen(rows);
        terms.set("vel_reward", "", [velocity]);
        terms.set("cyclic_hip", "rad", [self.off_cycle(rows)]);
        terms.set("ref_rot", "", [ops::exp(-turned)]);
        terms.set("joint_angle_rew", "", [ops::exp(-5.0 * spread)]);
        terms.set("act_mag", "", [effort(rows)]);
        terms.set("done", "", [f64::from(done)]);
        Verdict { sparse: velocity, solved: velocity >= 1.0, done }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
    }
}
