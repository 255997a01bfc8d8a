//! An environment: a robot in a world, with a task.

use super::hardware::Live;
use super::options::Options;
use super::parts::{action_bounds, build_robot, initial_pose, load, read_config};
use crate::assets::Assets;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::pictures::eyes::Eyes;
use crate::pictures::rendering::Rendering;
use crate::pictures::sight::Sight;
use crate::pictures::visual::{VisualKey, parse_keys};
use crate::randomize::Randomized;
use crate::registry::Registry;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::spec::{Settings, Spec};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Timing, Turn, Verdict, View};
use crate::task_type::TaskType;
use mjcf::diagnostic::Diagnostics;
use physics::{Data, StepError};
use render::scene::{Camera, SceneOptions};
use render::{Picture, Profile};
use robot::{Compat, Robot};
use std::ops::Range;
use std::sync::Arc;

/// What a step yields beside the observation.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The reward, dense or sparse as the environment is set.
    pub reward: f64,
    /// The task ended the episode.
    pub terminated: bool,
    /// The episode is over for another reason: its length, or a fault.
    pub truncated: bool,
    /// Why physics refused the step. The observation then repeats the step before, the reward is zero, and the next call must
    /// be a reset.
    pub fault: Option<StepError>,
}

/// What happened to the world since physics last looked at it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Past {
    /// Anything.
    Unknown,
    /// [`Scene::advance`], and nothing after it.
    Advance,
    /// [`Scene::advance_plainly`], after which nothing is recomputed.
    Plain,
}

/// An environment with one episode in progress.
pub struct Env {
    pub(crate) spec: Arc<Spec>,
    pub(crate) settings: Arc<Settings>,
    pub(crate) warnings: Arc<Diagnostics>,
    pub(crate) defaults: Arc<Defaults>,
    pub(crate) compat: Compat,
    pub(crate) task: Box<dyn Task>,
    pub(crate) robot: Robot,
    /// The robot is hardware, which the scene mirrors.
    pub(crate) live: Option<Live>,
    pub(crate) rng: Rng,
    pub(crate) initial: Pose,
    pub(crate) scene: Scene,
    /// The state as the sensors show it, where it can differ from the true one.
    pub(crate) observed: Data,
    /// Whether `observed` is what the last observation was made of.
    pub(crate) differs: bool,
    pub(crate) frame_skip: usize,
    pub(crate) weights: Vec<(String, f64)>,
    pub(crate) visual_keys: Arc<[VisualKey]>,
    pub(crate) eyes: Eyes,
    pub(crate) sight: Sight,
    /// What changes in the scene from episode to episode.
    pub(crate) randomized: Randomized,
    pub(crate) rendering: Rendering,
    /// What [`Env::render`] drew.
    pub(crate) rendered: Picture,
    pub(crate) obs_places: Vec<Range<usize>>,
    pub(crate) proprio_places: Vec<Range<usize>>,
    pub(crate) start: Pose,
    pub(crate) action: Vec<f64>,
    pub(crate) rows: Rows,
    pub(crate) terms: Rows,
    pub(crate) verdict: Verdict,
    pub(crate) dense: f64,
    pub(crate) observation: Vec<f64>,
    pub(crate) steps: usize,
    pub(crate) faulty: bool,
    pub(crate) faults: usize,
}

impl Registry {
    /// Makes an environment of this registry, ready for [`Env::reset`].
    ///
    /// # Errors
    /// The id is unknown; files are missing or wrong; settings do not fit.
    pub fn make(&self, id: &str, assets: &dyn Assets, options: &Options) -> Result<Env, EnvError> {
        let spec = self.spec(id)?;
        Env::of_task(self.task(spec)?, spec, assets, options)
    }
}

impl Env {
    /// Makes the environment of an id from the built-in registry, ready for [`Env::reset`].
    ///
    /// # Errors
    /// The id is unknown; files are missing or wrong; settings do not fit.
    pub fn make(id: &str, assets: &dyn Assets, options: &Options) -> Result<Self, EnvError> {
        Registry::builtin().make(id, assets, options)
    }

    /// Makes the environment that a specification describes, whose task is one of this crate.
    ///
    /// # Errors
    /// Files are missing or wrong; settings do not fit.
    pub fn build(spec: &Spec, assets: &dyn Assets, options: &Options) -> Result<Self, EnvError> {
        Self::of_task(Registry::builtin().task(spec)?, spec, assets, options)
    }

    fn of_task(
        task: &TaskType,
        spec: &Spec,
        assets: &dyn Assets,
        options: &Options,
    ) -> Result<Self, EnvError> {
        let spec = spec.with(&options.changes)?;
        let (settings, own) = spec.settings()?;
        let loaded = load(&spec, &settings, assets)?;
        let mut scene = Scene::under(loaded.model, &options.engine)?;
        scene.data.autoreset = options.autoreset;
        let mut rng = Rng::pcg64(options.seed);
        let hardware = options.hardware.as_ref();
        let config = match hardware.and_then(|hardware| hardware.config.clone()) {
            Some(config) => Some(config),
            None => read_config(&spec, &settings, assets)?,
        };
        let mut setup = Setup {
            spec: &spec,
            assets,
            scene: &mut scene,
            compat: options.compat,
            rng: &mut rng,
            config: config.as_ref(),
        };
        let task = task.build(own, &mut setup)?;
        let defaults = task.defaults();
        let robot = build_robot(&spec, &settings, config.as_ref(), &scene.model, options.compat, hardware)?;
        let mut initial = initial_pose(&scene, settings.normalize_act);
        task.initial_pose(&scene, &mut initial)?;
        let weights = settings.weights().map_err(|message| spec.wrong(message))?;
        let cameras = scene.model.camera_names().map(|(_, name)| name);
        let visual_keys =
            parse_keys(&settings.visual_keys, cameras).map_err(|error| spec.wrong(error.to_string()))?;
        let visual = settings.visual_randomization.as_ref();
        let mechanics = settings.physics_randomization.as_ref();
        let randomized = Randomized::new(visual, mechanics, &scene.model, options.seed)
            .map_err(|message| spec.wrong(message))?;
        // A name that is wrong fails here rather than at the first picture.
        Camera::named(&scene.model, &options.rendering.camera)?;
        let nu = scene.model.nu;
        let mut env = Env {
            frame_skip: settings.frame_skip.unwrap_or(defaults.frame_skip),
            weights: weights.unwrap_or_else(|| defaults.weights.clone()),
            eyes: Eyes::new(&visual_keys, &scene.model, options.networks.clone())?,
            sight: sight(&defaults, options),
            randomized,
            rendering: options.rendering.clone(),
            rendered: Picture::default(),
            live: hardware.map(|it| Live::new(it, config.as_ref(), &visual_keys)).transpose()?,
            visual_keys: visual_keys.into(),
            spec: Arc::new(spec),
            settings: Arc::new(settings),
            warnings: Arc::new(loaded.warnings),
            defaults: Arc::new(defaults),
            compat: options.compat,
            task,
            robot,
            rng,
            start: initial.clone(),
            initial,
            observed: Data::new(&scene.model),
            differs: false,
            scene,
            obs_places: Vec::new(),
            proprio_places: Vec::new(),
            action: vec![0.0; nu],
            rows: Rows::default(),
            terms: Rows::default(),
            verdict: Verdict::default(),
            dense: 0.0,
            observation: Vec::new(),
            steps: 0,
            faulty: false,
            faults: 0,
        };
        env.first_observation()?;
        Ok(env)
    }

    /// Learns the rows of the observation. The original takes a step with a zero action here, which hidden counters see.
    fn first_observation(&mut self) -> Result<(), EnvError> {
        if self.compat == Compat::RoboHive07 && self.live.is_none() {
            self.advance(&vec![0.0; self.scene.model.nu])??;
        }
        self.perceive(Past::Unknown)?;
        self.judge();
        let keys = self.obs_keys().to_vec();
        self.obs_places = self.places(&keys)?;
        self.proprio_places = match self.proprio_keys() {
            Some(keys) => self.places(keys)?,
            None => Vec::new(),
        };
        if let Some((name, _)) = self.weights.iter().find(|(name, _)| self.terms.get(name).is_none()) {
            let terms: Vec<_> = self.terms.rows().iter().map(|row| row.name()).collect();
            return Err(self
                .spec
                .wrong(format!("no reward term is named {name}; there are {}", terms.join(", "))));
        }
        self.gather();
        Ok(())
    }

    fn places(&self, keys: &[String]) -> Result<Vec<Range<usize>>, EnvError> {
        let place = |key: &String| {
            self.rows.place(key).ok_or_else(|| {
                let rows: Vec<_> = self.rows.rows().iter().map(|row| row.name()).collect();
                self.spec.wrong(format!("no observation is named {key}; there are {}", rows.join(", ")))
            })
        };
        keys.iter().map(place).collect()
    }

    /// Another environment in the same state, which goes on by itself.
    ///
    /// # Errors
    /// The robot is hardware, which is there only once.
    pub fn fork(&self) -> Result<Env, EnvError> {
        Ok(Env {
            spec: self.spec.clone(),
            settings: self.settings.clone(),
            warnings: self.warnings.clone(),
            defaults: self.defaults.clone(),
            compat: self.compat,
            task: self.task.clone(),
            robot: self.robot.fork()?,
            live: None,
            rng: self.rng.clone(),
            initial: self.initial.clone(),
            scene: self.scene.clone(),
            observed: self.observed.clone(),
            differs: self.differs,
            frame_skip: self.frame_skip,
            weights: self.weights.clone(),
            visual_keys: self.visual_keys.clone(),
            eyes: self.eyes.fork(),
            sight: self.sight.clone(),
            randomized: self.randomized.clone(),
            rendering: self.rendering.clone(),
            rendered: Picture::default(),
            obs_places: self.obs_places.clone(),
            proprio_places: self.proprio_places.clone(),
            start: self.start.clone(),
            action: self.action.clone(),
            rows: self.rows.clone(),
            terms: self.terms.clone(),
            verdict: self.verdict,
            dense: self.dense,
            observation: self.observation.clone(),
            steps: self.steps,
            faulty: self.faulty,
            faults: self.faults,
        })
    }

    /// Restarts all draws, as `env.seed(seed)` of the original does.
    pub fn seed(&mut self, seed: u64) {
        self.rng = Rng::pcg64(seed);
        self.task.seed(seed);
        self.randomized.seed(seed);
    }

    /// Starts an episode and returns its first observation. A seed restarts all draws first.
    ///
    /// # Errors
    /// The task draws from an impossible range, or physics refuses the first state; devices that fail.
    pub fn reset(&mut self, seed: Option<u64>) -> Result<&[f64], EnvError> {
        if let Some(seed) = seed {
            self.seed(seed);
        }
        self.steps = 0;
        self.faulty = false;
        self.start.clone_from(&self.initial);
        self.randomized.undo(&mut self.scene);
        let mut episode = Episode {
            scene: &mut self.scene,
            rng: &mut self.rng,
            start: &mut self.start,
            initial: &self.initial,
        };
        self.task.reset(&mut episode)?;
        self.randomize()?;
        self.robot.clip_reset(&mut self.start.qpos, &mut self.start.qvel);
        self.scene.reset();
        self.scene.data.state.qpos.copy_from_slice(&self.start.qpos);
        self.scene.data.state.qvel.copy_from_slice(&self.start.qvel);
        self.scene.forward()?;
        self.robot.reset(&self.scene.model, &self.scene.data, &mut self.rng)?;
        if let Some(live) = &mut self.live {
            (live.ready)(&self.start.qpos).map_err(EnvError::NotReady)?;
            self.robot.moved()?;
            (live.begun, live.commanded) = (None, false);
            live.pacer.start();
        }
        let mut episode = Episode {
            scene: &mut self.scene,
            rng: &mut self.rng,
            start: &mut self.start,
            initial: &self.initial,
        };
        self.task.begin(&mut episode)?;
        self.perceive(Past::Unknown)?;
        self.judge();
        self.gather();
        Ok(&self.observation)
    }

    /// Applies an action for one control period.
    ///
    /// # Errors
    /// The action has another length or holds NaN or infinities; the last step was refused and no reset followed. An
    /// action of the right form that physics cannot follow is no error: [`Step::fault`].
    pub fn step(&mut self, action: &[f64]) -> Result<Step, EnvError> {
        if self.faulty {
            return Err(EnvError::NeedsReset);
        }
        if action.len() != self.action.len() {
            return Err(EnvError::ActionLength { expected: self.action.len(), found: action.len() });
        }
        if let Some(index) = action.iter().position(|value| !value.is_finite()) {
            return Err(EnvError::ActionValue { index, value: action[index] });
        }
        let mut outcome = self.advance(action)?;
        self.steps += 1;
        let past = match self.task.timing() {
            Timing::Forwarded => Past::Advance,
            Timing::Plain => Past::Plain,
        };
        outcome = outcome.and_then(|()| self.perceive(past));
        let truncated = self.steps >= self.spec.max_episode_steps;
        if let Err(fault) = outcome {
            self.faulty = true;
            self.faults += 1;
            return Ok(Step { reward: 0.0, terminated: false, truncated: true, fault: Some(fault) });
        }
        self.judge();
        self.gather();
        Ok(Step { reward: self.reward(), terminated: self.verdict.done, truncated, fault: None })
    }

    /// Sends an action through task and robot, and advances the physics by one control period. The inner error is that of
    /// physics.
    fn advance(&mut self, wanted: &[f64]) -> Result<Result<(), StepError>, EnvError> {
        let dt = self.dt();
        let normalized = self.settings.normalize_act;
        for (k, (action, &wanted)) in self.action.iter_mut().zip(wanted).enumerate() {
            let [low, high] = action_bounds(&self.scene, normalized, k);
            *action = wanted.clamp(low, high);
        }
        let mut turn = Turn {
            scene: &mut self.scene,
            rng: &mut self.rng,
            wanted,
            action: &mut self.action,
            raw: false,
            dt,
            steps: self.steps,
        };
        self.task.act(&mut turn)?;
        let raw = turn.raw;
        let Scene { model, data, .. } = &mut self.scene;
        let control = if raw {
            self.robot.set_control(&self.action)?
        } else {
            self.robot.control(model, data, &self.action, dt)?
        };
        data.state.ctrl.copy_from_slice(control);
        if let Some(live) = &mut self.live {
            live.commanded = true;
            live.pacer.finish(dt);
            return Ok(Ok(()));
        }
        let robot = &mut self.robot;
        let tracks = robot.tracks_steps();
        let track = |data: &Data| {
            if tracks {
                robot.track(data);
            }
        };
        Ok(match self.task.timing() {
            Timing::Forwarded => self.scene.advance(self.frame_skip, track),
            Timing::Plain => self.scene.advance_plainly(self.frame_skip, track),
        })
    }

    /// Reads the sensors, and writes the observation dictionary of the state that they show.
    pub(crate) fn perceive(&mut self, past: Past) -> Result<(), StepError> {
        let Scene { model, data, .. } = &mut self.scene;
        self.robot.sense(model, data, &mut self.rng);
        // The original writes what it read into the simulation itself; hardware is all that there is to know.
        let mirrors = self.compat == Compat::RoboHive07 || self.live.is_some();
        let written = mirrors && self.robot.write_readings(data);
        if let Some(live) = &mut self.live {
            data.state.time -= *live.begun.get_or_insert(data.state.time);
        }
        if past == Past::Unknown || written {
            self.scene.forward()?
        } else if past == Past::Advance {
            self.scene.complete()
        }
        self.observe_readings()?;
        self.write_rows();
        Ok(())
    }

    /// Computes the state as the last readings show it, where that is kept apart from the true one.
    pub(crate) fn observe_readings(&mut self) -> Result<(), StepError> {
        self.differs = false;
        if self.compat == Compat::Fixed && self.live.is_none() {
            self.observed.state.clone_from(&self.scene.data.state);
            if self.robot.write_readings(&mut self.observed) {
                physics::forward(&self.scene.model, &mut self.observed)?;
                self.differs = true;
            }
        }
        Ok(())
    }

    /// Writes the observation dictionary.
    pub(crate) fn write_rows(&mut self) {
        self.eyes.close();
        let mut rows = std::mem::take(&mut self.rows);
        rows.begin();
        rows.set("time", "s", [self.scene.data.time()]);
        self.task.observe(&self.view(), &mut rows);
        self.rows = rows;
    }

    /// Writes the terms of the reward.
    pub(crate) fn judge(&mut self) {
        let mut terms = std::mem::take(&mut self.terms);
        terms.begin();
        self.verdict = self.task.reward(&self.view(), &self.rows, &mut terms);
        self.dense = self.weighted(&terms);
        self.terms = terms;
    }

    /// The dense reward of terms.
    pub(crate) fn weighted(&self, terms: &Rows) -> f64 {
        self.weights.iter().map(|(name, weight)| weight * terms.get(name).map_or(0.0, |term| term[0])).sum()
    }

    /// Puts the observation vector together.
    pub(crate) fn gather(&mut self) {
        self.observation.clear();
        for place in &self.obs_places {
            self.observation.extend_from_slice(&self.rows.values()[place.clone()]);
        }
    }

    pub(crate) fn view(&self) -> View<'_> {
        View {
            model: &self.scene.model,
            data: if self.differs { &self.observed } else { &self.scene.data },
            control: self.robot.last_control(),
            dt: self.dt(),
            steps: self.steps,
        }
    }
}

/// What the pictures of an environment follow: MuJoCo 3.1.3, RoboHive's own, where its quirks are reproduced. Tasks of muscles
/// show them by activation.
fn sight(defaults: &Defaults, options: &Options) -> Sight {
    let profile = match options.compat {
        Compat::RoboHive07 => Profile::Mujoco313,
        Compat::Fixed => Profile::Mujoco312,
    };
    let mut shown = SceneOptions::default();
    shown.show.actuators = defaults.show_actuators;
    shown.show.activations = defaults.show_actuators;
    Sight::new(profile, shown, options.painters.clone())
}
