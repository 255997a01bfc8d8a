//! What an environment asks of a task: where episodes start, what is observed, what is rewarded.

use crate::assets::{Assets, own_file};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::spec::Spec;
use crate::team::Team;
use physics::elements::BodyId;
use physics::model::JointType;
use physics::{Data, Model};
use robot::{Compat, Config, Keeper, Roles};
use std::ops::Range;

/// What a task is built from.
pub struct Setup<'a> {
    /// The environment that the task is for.
    pub spec: &'a Spec,
    /// Files that settings name.
    pub assets: &'a dyn Assets,
    /// The world, at its reference configuration and forwarded; edits made here last for all episodes.
    pub scene: &'a mut Scene,
    /// Whether quirks of the original are reproduced.
    pub compat: Compat,
    /// Draws made at construction.
    pub rng: &'a mut Rng,
    /// The robot's configuration, where the id has one.
    pub config: Option<&'a Config>,
}

impl Setup<'_> {
    /// The roles in the file at `path`, among our own or among [`Setup::assets`].
    ///
    /// # Errors
    /// The file cannot be read, or is no file of roles.
    pub fn roles(&self, path: &str) -> Result<Roles, EnvError> {
        let bytes = own_file(path).map_or_else(|| self.assets.read(path), Ok);
        let bytes = bytes.map_err(|hint| self.wrong(format!("roles: {path}: {hint}")))?;
        Ok(Roles::from_toml(&String::from_utf8_lossy(&bytes), path)?)
    }

    /// A body on a free joint, and where `qpos` has that.
    ///
    /// # Errors
    /// The model has no such body, or its body has another joint or none.
    pub fn loose_body(&self, name: &str) -> Result<(BodyId, Range<usize>), EnvError> {
        let (m, body) = (&self.scene.model, self.scene.body(name)?);
        let mut joints = m.body(body).joints();
        let free = joints.find(|joint| m.jnt_type[joint.index()] == JointType::Free as i32);
        let free = free.ok_or_else(|| self.wrong(format!("the body {name} needs a free joint")))?;
        Ok((body, m.joint(free).qpos_range()))
    }

    /// An error about a setting of the environment.
    pub fn wrong(&self, message: impl Into<String>) -> EnvError {
        self.spec.wrong(message)
    }
}

/// A configuration to start from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Joint positions (nq).
    pub qpos: Vec<f64>,
    /// Joint velocities (nv).
    pub qvel: Vec<f64>,
}

/// The beginning of an episode, to be decided by the task.
pub struct Episode<'a> {
    /// The world. When [`Task::reset`] is called it is still in the state in which the last episode ended.
    pub scene: &'a mut Scene,
    /// Draws of this environment.
    pub rng: &'a mut Rng,
    /// Where the episode starts: the environment's initial pose unless changed here.
    pub start: &'a mut Pose,
    /// The initial pose.
    pub initial: &'a Pose,
}

/// The time between a policy's action and the physics that follows it.
pub struct Turn<'a> {
    /// The world, which the task may change.
    pub scene: &'a mut Scene,
    /// Draws of this environment.
    pub rng: &'a mut Rng,
    /// The action as the policy gave it (nu).
    pub wanted: &'a [f64],
    /// The action within its space (nu); what stands here goes to the robot.
    pub action: &'a mut [f64],
    /// Set to send the action to the actuators as controls, without normalisation.
    pub raw: bool,
    /// Control period \[s\].
    pub dt: f64,
    /// Steps taken in this episode.
    pub steps: usize,
}

/// The world as the robot's sensors show it, from which observations and rewards follow.
pub struct View<'a> {
    /// The model.
    pub model: &'a Model,
    /// The observed state and what follows from it.
    pub data: &'a Data,
    /// Controls applied in the last step (nu), within the robot's limits.
    pub control: &'a [f64],
    /// Control period \[s\].
    pub dt: f64,
    /// Steps taken in this episode.
    pub steps: usize,
}

/// What a reward decides beside its weighted terms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Verdict {
    /// The sparse reward.
    pub sparse: f64,
    /// Whether the task is solved in this state.
    pub solved: bool,
    /// Whether the episode ends here.
    pub done: bool,
}

/// How a step advances the physics.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// RoboHive's order: second half of a step, whole steps, first half, and a forward pass. All that is observed is of
    /// the new state.
    #[default]
    Forwarded,
    /// Whole steps, then forces and accelerations of bodies (`mj_rnePostConstraint`). Positions and velocities of joints
    /// are of the new state, all that follows from them of the state one time step before.
    Plain,
}

/// When an episode counts as a success.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Success {
    /// It was solved in more than this many steps.
    MoreThan(usize),
    /// As the share of its horizon in which it was solved.
    Share,
}

/// The settings that an id may leave out.
#[derive(Clone, Debug, PartialEq)]
pub struct Defaults {
    /// Rows of the observation vector, in order.
    pub obs_keys: Vec<String>,
    /// Terms of the dense reward with their weights.
    pub weights: Vec<(String, f64)>,
    /// Rows of the proprioception; `None` where a task has none.
    pub proprio_keys: Option<Vec<String>>,
    /// Time steps of the physics in one step of the environment.
    pub frame_skip: usize,
    /// When an episode counts as a success.
    pub success: Success,
    /// Pictures show actuators, coloured by activation.
    pub show_actuators: bool,
}

impl Defaults {
    /// Defaults of a task that has rows, weights and a frame skip, whose success is RoboHive's: more than five
    /// solved steps.
    pub fn new(obs_keys: &[&str], weights: &[(&str, f64)], frame_skip: usize) -> Self {
        Defaults {
            obs_keys: obs_keys.iter().map(ToString::to_string).collect(),
            weights: weights.iter().map(|&(key, weight)| (key.to_string(), weight)).collect(),
            proprio_keys: None,
            frame_skip,
            success: Success::MoreThan(5),
            show_actuators: false,
        }
    }

    /// The same with proprioception.
    pub fn proprio(mut self, keys: &[&str]) -> Self {
        self.proprio_keys = Some(keys.iter().map(ToString::to_string).collect());
        self
    }
}

/// A task: three functions over a world, and what they remember between steps. [`Registry::add_task`](crate::Registry::add_task)
/// shows one.
pub trait Task: TaskCopy + Send + Sync {
    /// The settings that an id may leave out.
    fn defaults(&self) -> Defaults;

    /// The agents of a task for several: what each commands, observes and earns.
    fn team(&self) -> Option<&Team> {
        None
    }

    /// How a step advances the physics.
    fn timing(&self) -> Timing {
        Timing::Forwarded
    }

    /// Changes the initial pose, which is the model's reference configuration with every actuated joint in the middle
    /// of its range.
    ///
    /// # Errors
    /// The model does not fit the task.
    fn initial_pose(&self, _scene: &Scene, _pose: &mut Pose) -> Result<(), EnvError> {
        Ok(())
    }

    /// Restarts draws that the task makes from a generator of its own.
    fn seed(&mut self, _seed: u64) {}

    /// Decides how the next episode starts.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from; a world that physics refuses.
    fn reset(&mut self, _episode: &mut Episode<'_>) -> Result<(), EnvError> {
        Ok(())
    }

    /// Changes the world after the robot was reset and before the first observation.
    ///
    /// # Errors
    /// As [`Task::reset`].
    fn begin(&mut self, _episode: &mut Episode<'_>) -> Result<(), EnvError> {
        Ok(())
    }

    /// Changes the action or the world before the physics advances.
    ///
    /// # Errors
    /// A world that physics refuses.
    fn act(&mut self, _turn: &mut Turn<'_>) -> Result<(), EnvError> {
        Ok(())
    }

    /// Writes the observation dictionary. `time` stands in it already.
    fn observe(&self, view: &View<'_>, rows: &mut Rows);

    /// Writes the terms of the reward, from the observation alone where that suffices.
    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict;

    /// Whether [`Task::reward`] needs nothing but the observation, so that rewards of recorded paths can be recomputed.
    fn rewards_paths(&self) -> bool {
        true
    }

    /// Rows of the observation that never change under these settings: goals that are fixed, for one.
    fn constant_rows(&self) -> Vec<String> {
        Vec::new()
    }

    /// Rows of the observation that random actions may leave as they are: contacts that take skill, doors that are far.
    fn resting_rows(&self) -> Vec<String> {
        Vec::new()
    }

    /// Writes, or reads, what the task remembers from step to step and from episode to episode. What stands in the model
    /// or follows from the settings is kept elsewhere.
    fn keep(&mut self, _keeper: &mut Keeper) {}
}

/// Copies of a task behind a pointer, for saved states and parallel environments. Every task that is `Clone` has them.
pub trait TaskCopy {
    /// A copy.
    fn boxed(&self) -> Box<dyn Task>;
}

impl<T: Task + Clone + 'static> TaskCopy for T {
    fn boxed(&self) -> Box<dyn Task> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Task> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}
