//! Turning a die in the hand until it lies as a second die does, beside which it is shown.

use super::die::Die;
use crate::error::EnvError;
use crate::rotation::{euler_of_mat, norm, quat_of_euler};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, GeomId, SiteId};
use physics::math::{Vec3, add, sub};
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::sync::Arc;

/// Coordinates of the die, the last ones of the model: three slides and three hinges.
const DIE_JOINTS: usize = 6;

/// Rotation of the forearm that turns the palm up \[rad\].
const PALM_UP: f64 = -1.5;

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Args {
    /// Offsets of the goal from its place in the model, per axis \[m\].
    goal_pos: [f64; 2],
    /// Euler angles of the goal \[rad\].
    goal_rot: [f64; 2],
    /// Largest change of the die's half size \[m\].
    obj_size_change: f64,
    /// Mass of the die \[kg\].
    obj_mass_range: [f64; 2],
    /// Largest change of the coefficients of friction.
    obj_friction_change: [f64; 3],
    /// Distance from the goal that solves \[m\].
    pos_th: f64,
    /// Norm of the differences of Euler angles that solves \[rad\].
    rot_th: f64,
    /// Distance from the goal beyond which the die is dropped \[m\].
    drop_th: f64,
}

impl Default for Args {
    fn default() -> Self {
        Args {
            goal_pos: [0.0; 2],
            goal_rot: [0.785; 2],
            obj_size_change: 0.0,
            obj_mass_range: [0.108; 2],
            obj_friction_change: [0.0; 3],
            pos_th: 0.025,
            rot_th: 0.262,
            drop_th: 0.2,
        }
    }
}

#[derive(Clone)]
pub struct Reorient {
    args: Arc<Args>,
    compat: Compat,
    muscles: Muscles,
    object: SiteId,
    goal: SiteId,
    goal_body: BodyId,
    goal_geom: GeomId,
    goal_size: Vec3,
    /// Where the goal is in the model, in the frame of the world \[m\].
    goal_place: Vec3,
    /// From the die to the goal while the die is where it should be \[m\].
    offset: Vec3,
    die: Die,
}

impl Reorient {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings are wrong, or the model has no die and goal.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(Condition::None, setup)?;
        let scene = &*setup.scene;
        if scene.model.nq <= DIE_JOINTS + 1 {
            return Err(
                setup.wrong(format!("its model has {} joints, too few for a die and a hand", scene.model.nq))
            );
        }
        let (object, goal) = (scene.site("object_o")?, scene.site("target_o")?);
        let goal_geom = scene.geom("target_dice")?;
        let goal_place = *scene.data.site(goal).xpos();
        let die = Die::new(scene, args.obj_mass_range, args.obj_size_change, args.obj_friction_change)?;
        Ok(Reorient {
            compat: setup.compat,
            muscles,
            object,
            goal,
            goal_body: scene.body("target")?,
            goal_geom,
            goal_size: scene.model.geom_size[goal_geom.index()],
            goal_place,
            offset: sub(goal_place, *scene.data.site(object).xpos()),
            die,
            args: args.into(),
        })
    }
}

impl Task for Reorient {
    fn defaults(&self) -> Defaults {
        let keys = [
            "hand_qpos_noMD5",
            "hand_qvel",
            "obj_pos",
            "goal_pos",
            "pos_err",
            "obj_rot",
            "goal_rot",
            "rot_err",
        ];
        let weights =
            [("pos_dist", 100.0), ("rot_dist", 1.0), ("bonus", 0.0), ("act_reg", 0.0), ("penalty", 0.0)];
        self.muscles.defaults(&keys, &weights)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        let flexed = scene.model.nq - DIE_JOINTS - 1;
        pose.qpos[..flexed].fill(0.0);
        pose.qpos[0] = PALM_UP;
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        let (args, rng) = (&self.args, &mut *episode.rng);
        let (mut shift, mut turn) = ([0.0; 3], [0.0; 3]);
        rng.fill_uniform(args.goal_pos[0], args.goal_pos[1], &mut shift)?;
        rng.fill_uniform(args.goal_rot[0], args.goal_rot[1], &mut turn)?;
        self.die.draw(rng)?;
        let fixed = self.compat == Compat::Fixed;
        episode.scene.edit(self.compat, |m| {
            m.body_pos[self.goal_body.index()] = add(self.goal_place, shift);
            m.body_quat[self.goal_body.index()] = quat_of_euler(turn);
            m.geom_size[self.goal_geom.index()] = self.goal_size.map(|size| size + self.die.growth());
            self.die.impose(m, fixed);
        })
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let hand = state.qpos.len() - DIE_JOINTS;
        rows.set("hand_qpos_noMD5", "rad", &state.qpos[..hand - 1]);
        rows.set("hand_qpos", "rad", &state.qpos[..hand]);
        rows.set("hand_qvel", "rad", state.qvel[..hand].iter().map(|speed| speed * view.dt));
        let (object, goal) = (view.data.site(self.object), view.data.site(self.goal));
        rows.set("obj_pos", "m", object.xpos());
        rows.set("goal_pos", "m", goal.xpos());
        rows.set("pos_err", "m", sub(sub(*goal.xpos(), *object.xpos()), self.offset));
        let (object, goal) = (euler_of_mat(object.xmat()), euler_of_mat(goal.xmat()));
        rows.set("obj_rot", "rad", object);
        rows.set("goal_rot", "rad", goal);
        rows.set("rot_err", "rad", sub(goal, object));
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (distance, angle) = (norm(&rows["pos_err"]), norm(&rows["rot_err"]));
        let dropped = distance > self.args.drop_th;
        let near = |threshold| f64::from(distance < threshold);
        terms.set("pos_dist", "m", [-distance]);
        terms.set("rot_dist", "rad", [-angle]);
        terms.set("bonus", "", [near(2.0 * self.args.pos_th) + near(self.args.pos_th)]);
        terms.set("act_reg", "", [-effort(rows)]);
        terms.set("penalty", "", [-f64::from(dropped)]);
        let solved = distance < self.args.pos_th && angle < self.args.rot_th && !dropped;
        Verdict { sparse: -angle - 10.0 * distance, solved, done: dropped }
    }

    fn constant_rows(&self) -> Vec<String> {
        let ranges = [("goal_pos", self.args.goal_pos), ("goal_rot", self.args.goal_rot)];
        let fixed = ranges.iter().filter(|(_, [low, high])| low == high);
        fixed.map(|(name, _)| name.to_string()).collect()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
    }
}
