//! Carrying an object with the whole arm into a receptacle.

use super::object::{Object, ObjectArgs};
use crate::draws::Ranges;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::{euler_of_mat, norm, quat_of_euler};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::sub;
use robot::{Compat, Keeper};
use serde::Deserialize;

/// Coordinates of the object, the last ones of the model: three slides and three hinges.
const OBJECT_JOINTS: usize = 6;

/// Starts in contact are drawn again; a task whose every start is in contact begins after this many.
const ATTEMPTS: usize = 1000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Positions of the receptacle \[m\].
    target_xyz_range: Ranges,
    /// Euler angles of the receptacle \[rad\].
    target_rxryrz_range: Ranges,
    /// Positions of the object \[m\]; without them the object lies where the first key frame has it.
    obj_xyz_range: Option<Ranges>,
    /// Sizes of the object's geoms \[m\], which then have random shapes, places, friction and mass.
    obj_geom_range: Option<Ranges>,
    obj_mass_range: Option<Bounds>,
    obj_friction_range: Option<Ranges>,
    /// How far joints start from the key frame, in parts of their range.
    #[serde(default)]
    qpos_noise_range: f64,
    /// Distance from the receptacle that solves \[m\].
    #[serde(default = "pos_th")]
    pos_th: f64,
    /// Norm of the differences of Euler angles that solves \[rad\].
    #[serde(default = "rot_th")]
    rot_th: f64,
    /// Distance from the palm beyond which the object is lost \[m\].
    #[serde(default = "drop_th")]
    drop_th: f64,
}

/// The ends of an interval.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Bounds {
    low: f64,
    high: f64,
}

fn pos_th() -> f64 {
    0.025
}

fn rot_th() -> f64 {
    0.262
}

fn drop_th() -> f64 {
    0.5
}

#[derive(Clone)]
pub struct Relocate {
    compat: Compat,
    muscles: Muscles,
    palm: SiteId,
    object: SiteId,
    goal: SiteId,
    goal_body: BodyId,
    targets: [Ranges; 2],
    shape: Object,
    /// Part of its range by which a joint may start elsewhere than in the key frame.
    noise: f64,
    key: usize,
    solved_within: [f64; 2],
    reach: f64,
}

impl Relocate {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings are wrong, or the model lacks hand, object, receptacle or key frames.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(Condition::None, setup)?;
        let scene = &*setup.scene;
        if scene.model.nq <= OBJECT_JOINTS + 1 {
            return Err(setup.wrong(format!(
                "its model has {} joints, too few for an object and an arm",
                scene.model.nq
            )));
        }
        let key = usize::from(args.obj_xyz_range.is_some());
        if key >= scene.model.nkey {
            return Err(setup.wrong(format!("its model has no key frame {key}, in which episodes start")));
        }
        let shape = ObjectArgs {
            places: args.obj_xyz_range,
            sizes: args.obj_geom_range,
            mass: args.obj_mass_range.map(|bounds| [bounds.low, bounds.high]),
            friction: args.obj_friction_range,
        };
        Ok(Relocate {
            compat: setup.compat,
            muscles,
            palm: scene.site("S_grasp")?,
            object: scene.site("object_o")?,
            goal: scene.site("target_o")?,
            goal_body: scene.body("target")?,
            targets: [args.target_xyz_range, args.target_rxryrz_range],
            shape: Object::new(shape, scene)?,
            noise: args.qpos_noise_range,
            key,
            solved_within: [args.pos_th, args.rot_th],
            reach: args.drop_th,
        })
    }

    /// Draws where the receptacle stands, and what the object is.
    fn draw(&mut self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        let place = self.targets[0].draw(rng)?;
        let turn = quat_of_euler(self.targets[1].draw(rng)?);
        self.shape.draw(rng)?;
        let body = self.goal_body.index();
        scene.edit(self.compat, |m| {
            m.body_pos[body] = place;
            m.body_quat[body] = turn;
            self.shape.impose(m, self.compat);
        })
    }

    /// Moves the joints of arm and hand away from the initial pose. The original adds the whole noise to every joint.
    fn disturb(&self, scene: &Scene, start: &mut Pose, rng: &mut Rng) -> Result<(), EnvError> {
        let arm = start.qpos.len() - OBJECT_JOINTS;
        for (position, &[low, high]) in start.qpos[..arm].iter_mut().zip(&scene.model.jnt_range) {
            let part = match self.compat {
                Compat::RoboHive07 => 1.0,
                Compat::Fixed => rng.uniform(-1.0, 1.0)?,
            };
            *position += part * self.noise * (high - low);
            if self.compat == Compat::Fixed && low < high {
                *position = position.clamp(low, high);
            }
        }
        Ok(())
    }
}

impl Task for Relocate {
    fn defaults(&self) -> Defaults {
        let keys =
            ["hand_qpos", "hand_qvel", "obj_pos", "goal_pos", "pos_err", "obj_rot", "goal_rot", "rot_err"];
        self.muscles.defaults(&keys, &[("pos_dist", 100.0), ("rot_dist", 1.0)])
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        let width = scene.model.nq;
        pose.qpos.copy_from_slice(&scene.model.key_qpos[self.key * width..(self.key + 1) * width]);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        for _ in 0..ATTEMPTS {
            let scene = &mut *episode.scene;
            self.draw(scene, episode.rng)?;
            episode.start.clone_from(episode.initial);
            if self.noise != 0.0 {
                self.disturb(scene, episode.start, episode.rng)?;
            }
            scene.data.reset(&scene.model);
            scene.data.state.qpos.copy_from_slice(&episode.start.qpos);
            scene.forward()?;
            if scene.data.contacts().len() == 0 {
                break;
            }
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let arm = state.qpos.len() - OBJECT_JOINTS;
        rows.set("hand_qpos", "rad", &state.qpos[..arm - 1]);
        rows.set("hand_qpos_corrected", "rad", &state.qpos[..arm]);
        rows.set("hand_qvel", "rad", state.qvel[..arm].iter().map(|speed| speed * view.dt));
        let [object, goal, palm] = [self.object, self.goal, self.palm].map(|site| view.data.site(site));
        rows.set("obj_pos", "m", object.xpos());
        rows.set("goal_pos", "m", goal.xpos());
        rows.set("palm_pos", "m", palm.xpos());
        rows.set("pos_err", "m", sub(*goal.xpos(), *object.xpos()));
        rows.set("reach_err", "m", sub(*palm.xpos(), *object.xpos()));
        let (object, goal) = (euler_of_mat(object.xmat()), euler_of_mat(goal.xmat()));
        rows.set("obj_rot", "rad", object);
        rows.set("goal_rot", "rad", goal);
        rows.set("rot_err", "rad", sub(goal, object));
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [reach, distance, angle] = ["reach_err", "pos_err", "rot_err"].map(|name| norm(&rows[name]));
        let lost = reach > self.reach;
        terms.set("pos_dist", "m", [-distance]);
        terms.set("rot_dist", "rad", [-angle]);
        terms.set("act_reg", "", [-effort(rows)]);
        let solved = distance < self.solved_within[0] && angle < self.solved_within[1] && !lost;
        Verdict { sparse: -angle - 10.0 * distance, solved, done: lost }
    }

    fn constant_rows(&self) -> Vec<String> {
        let names = ["goal_pos", "goal_rot"].iter().zip(&self.targets);
        names.filter(|(_, range)| range.low == range.high).map(|(name, _)| name.to_string()).collect()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
    }
}
