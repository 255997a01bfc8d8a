//! States of an environment: saved ones, which continue an episode exactly, and recorded ones, which hold what RoboHive
//! writes into its traces.

use super::env::{Env, Past};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::randomize::RandomizedState;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Task, Verdict};
use physics::{Model, Snapshot};
use robot::Memory;

/// All that decides the rest of an episode: the state of the physics, the model with its edits, what task and robot
/// remember, and the position in the sequence of draws.
#[derive(Clone)]
pub struct EnvState {
    pub(crate) model: Model,
    pub(crate) snapshot: Snapshot,
    pub(crate) mover: physics::Memory,
    pub(crate) task: Box<dyn Task>,
    pub(crate) robot: Memory,
    pub(crate) rng: Rng,
    pub(crate) randomized: RandomizedState,
    pub(crate) rows: Rows,
    pub(crate) terms: Rows,
    pub(crate) verdict: Verdict,
    pub(crate) dense: f64,
    pub(crate) steps: usize,
    pub(crate) faulty: bool,
}

/// A state as RoboHive's traces hold it. What is missing keeps its value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorldState {
    /// Simulation time \[s\].
    pub time: Option<f64>,
    /// Joint positions (nq).
    pub qpos: Option<Vec<f64>>,
    /// Joint velocities (nv).
    pub qvel: Option<Vec<f64>>,
    /// Actuator activations (na).
    pub act: Option<Vec<f64>>,
    /// Positions of mocap bodies (nmocap x 3) \[m\].
    pub mocap_pos: Option<Vec<f64>>,
    /// Orientations of mocap bodies (nmocap x 4).
    pub mocap_quat: Option<Vec<f64>>,
    /// Positions of sites in their bodies (nsite x 3) \[m\].
    pub site_pos: Option<Vec<f64>>,
    /// Orientations of sites in their bodies (nsite x 4).
    pub site_quat: Option<Vec<f64>>,
    /// Positions of bodies in their parents (nbody x 3) \[m\].
    pub body_pos: Option<Vec<f64>>,
    /// Orientations of bodies in their parents (nbody x 4).
    pub body_quat: Option<Vec<f64>>,
    /// Controls of the last step (nu).
    pub ctrl: Option<Vec<f64>>,
    /// What the robot last sent to its actuators (nu), where that is not `ctrl`: a reset clears the controls alone.
    pub last_ctrl: Option<Vec<f64>>,
}

impl WorldState {
    /// The names of the parts, as traces and archives use them.
    pub const NAMES: [&'static str; 12] = [
        "time",
        "qpos",
        "qvel",
        "act",
        "mocap_pos",
        "mocap_quat",
        "site_pos",
        "site_quat",
        "body_pos",
        "body_quat",
        "ctrl",
        "last_ctrl",
    ];

    /// Every part that is there, by name.
    pub fn parts(self) -> impl Iterator<Item = (&'static str, Vec<f64>)> {
        let parts = [
            self.time.map(|time| vec![time]),
            self.qpos,
            self.qvel,
            self.act,
            self.mocap_pos,
            self.mocap_quat,
            self.site_pos,
            self.site_quat,
            self.body_pos,
            self.body_quat,
            self.ctrl,
        ];
        Self::NAMES.into_iter().zip(parts).filter_map(|(name, values)| Some((name, values?)))
    }

    /// Sets a part by name; `false` if no part has that name.
    pub fn set(&mut self, name: &str, values: &[f64]) -> bool {
        let part = match name {
            "time" => {
                self.time = values.first().copied();
                return true;
            }
            "qpos" => &mut self.qpos,
            "qvel" => &mut self.qvel,
            "act" => &mut self.act,
            "mocap_pos" => &mut self.mocap_pos,
            "mocap_quat" => &mut self.mocap_quat,
            "site_pos" => &mut self.site_pos,
            "site_quat" => &mut self.site_quat,
            "body_pos" => &mut self.body_pos,
            "body_quat" => &mut self.body_quat,
            "ctrl" => &mut self.ctrl,
            "last_ctrl" => &mut self.last_ctrl,
            _ => return false,
        };
        *part = Some(values.to_vec());
        true
    }
}

/// What an observation is made of, to be written by whoever has it from elsewhere.
#[doc(hidden)]
pub struct Injected<'a> {
    /// The world; nothing is recomputed from what is written.
    pub scene: &'a mut Scene,
    /// Controls of the last step.
    pub control: &'a mut [f64],
    /// Steps taken in the episode.
    pub steps: &'a mut usize,
}

impl Env {
    /// Observes and rewards a state whose derived quantities come from elsewhere: for comparisons of these functions alone.
    #[doc(hidden)]
    pub fn observe_injected(&mut self, write: impl FnOnce(&mut Injected<'_>)) {
        let mut control = self.robot.last_control().to_vec();
        write(&mut Injected { scene: &mut self.scene, control: &mut control, steps: &mut self.steps });
        self.robot.set_control(&control).expect("as long as before");
        self.differs = false;
        self.write_rows();
        self.judge();
        self.gather();
    }

    /// All that decides the rest of the episode.
    pub fn state(&self) -> EnvState {
        let mut snapshot = Snapshot::default();
        self.scene.data.save(&mut snapshot);
        EnvState {
            model: self.scene.model.clone(),
            snapshot,
            mover: self.scene.mover.save(),
            task: self.task.clone(),
            robot: self.robot.memory(),
            rng: self.rng.clone(),
            randomized: self.randomized.state(),
            rows: self.rows.clone(),
            terms: self.terms.clone(),
            verdict: self.verdict,
            dense: self.dense,
            steps: self.steps,
            faulty: self.faulty,
        }
    }

    /// Continues from a saved state: all later steps are those that followed it, to the last bit.
    ///
    /// # Errors
    /// The state is one of another environment.
    pub fn set_state(&mut self, state: &EnvState) -> Result<(), EnvError> {
        let foreign = |_| EnvError::ForeignState {
            message: "it was saved by an environment with another model or engine".into(),
        };
        // First, so that a state under another engine changes nothing.
        self.scene.mover.restore(&state.mover).map_err(foreign)?;
        self.scene.data.restore(&state.snapshot).map_err(foreign)?;
        self.scene.model = state.model.clone();
        self.scene.forward()?;
        // The pass above moved the solver's start.
        self.scene.data.restore(&state.snapshot).map_err(foreign)?;
        self.task = state.task.clone();
        self.robot.restore(&state.robot);
        self.rng = state.rng.clone();
        self.randomized.restore(&state.randomized);
        self.rows.clone_from(&state.rows);
        self.terms.clone_from(&state.terms);
        (self.verdict, self.dense) = (state.verdict, state.dense);
        (self.steps, self.faulty) = (state.steps, state.faulty);
        self.observe_readings()?;
        self.eyes.close();
        self.gather();
        Ok(())
    }

    /// The state as RoboHive's traces hold it.
    pub fn world(&self) -> WorldState {
        let (model, state) = (&self.scene.model, &self.scene.data.state);
        let some = |values: &[f64]| (!values.is_empty()).then(|| values.to_vec());
        WorldState {
            time: Some(state.time),
            qpos: some(&state.qpos),
            qvel: some(&state.qvel),
            act: some(&state.act),
            mocap_pos: some(state.mocap_pos.as_flattened()),
            mocap_quat: some(state.mocap_quat.as_flattened()),
            site_pos: some(model.site_pos.as_flattened()),
            site_quat: some(model.site_quat.as_flattened()),
            body_pos: some(model.body_pos.as_flattened()),
            body_quat: some(model.body_quat.as_flattened()),
            ctrl: some(&state.ctrl),
            last_ctrl: some(self.robot.last_control()),
        }
    }

    /// The controls that an action becomes in the current state, with the limits of the robot. Devices hear nothing of it.
    ///
    /// # Errors
    /// The robot refuses the action.
    pub fn controls_of(&mut self, action: &[f64]) -> Result<Vec<f64>, EnvError> {
        let dt = self.dt();
        Ok(self.robot.plan(&self.scene.model, &self.scene.data, action, dt)?)
    }

    /// Pushes bodies from outside (`xfrc_applied`, `[nbody]`: force and torque about the centre of mass, in the world's frame
    /// \[N, N m\]) until other wrenches are given or an episode begins: for people who pull at what they see.
    ///
    /// # Panics
    /// There is not one wrench for each body of the model.
    pub fn push_bodies(&mut self, wrenches: &[[f64; 6]]) {
        self.scene.data.state.xfrc_applied.copy_from_slice(wrenches);
    }

    /// Takes over a recorded state, and observes and rewards it. The number of steps follows from its time.
    ///
    /// # Errors
    /// A part has another length than this environment's; physics refuses the state.
    pub fn set_world(&mut self, world: &WorldState) -> Result<&[f64], EnvError> {
        let scene = &mut self.scene;
        if let Some(time) = world.time {
            scene.data.state.time = time;
            self.steps = (time / (scene.model.opt.timestep * self.frame_skip as f64)).round() as usize;
        }
        let state = &mut scene.data.state;
        copy("qpos", world.qpos.as_deref(), &mut state.qpos)?;
        copy("qvel", world.qvel.as_deref(), &mut state.qvel)?;
        copy("act", world.act.as_deref(), &mut state.act)?;
        copy("mocap_pos", world.mocap_pos.as_deref(), state.mocap_pos.as_flattened_mut())?;
        copy("mocap_quat", world.mocap_quat.as_deref(), state.mocap_quat.as_flattened_mut())?;
        macro_rules! model_part {
            ($name:ident) => {
                if let Some(values) = &world.$name
                    && values != scene.model.$name.as_flattened()
                {
                    let mut outcome = Ok(());
                    scene.overwrite(|m| {
                        outcome = copy(stringify!($name), Some(values), m.$name.as_flattened_mut());
                    })?;
                    outcome?;
                }
            };
        }
        model_part!(site_pos);
        model_part!(site_quat);
        model_part!(body_pos);
        model_part!(body_quat);
        if let Some(ctrl) = &world.ctrl {
            copy("ctrl", Some(ctrl), &mut scene.data.state.ctrl)?;
            self.robot.set_control(ctrl)?;
        }
        if let Some(ctrl) = &world.last_ctrl {
            self.robot.set_control(ctrl)?;
        }
        self.faulty = false;
        self.scene.forward()?;
        self.perceive(Past::Unknown)?;
        self.judge();
        self.gather();
        Ok(&self.observation)
    }
}

fn copy(name: &str, from: Option<&[f64]>, to: &mut [f64]) -> Result<(), EnvError> {
    let Some(values) = from else { return Ok(()) };
    if values.len() != to.len() {
        let message = format!("{name} has {} values, and this environment has {}", values.len(), to.len());
        return Err(EnvError::ForeignState { message });
    }
    to.copy_from_slice(values);
    Ok(())
}
