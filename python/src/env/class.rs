//! `robohive._core.Env`.

use super::team;
use crate::actions;
use crate::arrays;
use crate::exceptions::exception;
use crate::infos::{Names, shaped, visual_dict};
use crate::request::Request;
use crate::turns::Turns;
use crate::world;
use env::{Env, EnvMemory, RenderMode};
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArrayDyn};
use physics::model::ObjType;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyAny, PyDict, PyString};
use render::Picture;
use render::picture::Channels;

/// One environment. Calls from several threads at once are refused; the interpreter's lock is released while physics
/// runs.
#[pyclass(frozen, name = "Env", module = "robohive._core")]
pub struct PyEnv {
    live: Turns<Live>,
    /// Names of its rows.
    names: Names,
    request: Request,
}

/// An environment in use, and the memory that its calls share.
struct Live {
    env: Env,
    /// The last action.
    action: Vec<f64>,
}

/// Observation, reward, terminated, truncated, infos.
type Stepped<'py> = (Bound<'py, PyArray1<f64>>, f64, bool, bool, Bound<'py, PyDict>);

#[pymethods]
impl PyEnv {
    #[new]
    fn new(
        py: Python<'_>,
        id: &str,
        settings: &Bound<'_, PyDict>,
        making: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let request = Request::read(id, settings, making)?;
        let env = request.make(py)?;
        Ok(PyEnv::of(py, env, request))
    }

    /// Starts an episode: its first observation and infos.
    #[pyo3(signature = (seed = None))]
    fn reset<'py>(
        &self,
        py: Python<'py>,
        seed: Option<u64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyDict>)> {
        let mut taken = self.live.take(py, "reset")?;
        let env = &mut taken.env;
        py.detach(|| env.reset(seed).map(|_| ())).map_err(|error| exception(py, &error))?;
        Ok((PyArray1::from_slice(py, env.observation()), self.names.infos(py, env)?))
    }

    /// One control period. A step that physics refuses ends the episode as truncated, with `fault` in the infos.
    #[pyo3(signature = (action, exteroception = false))]
    fn step<'py>(
        &self,
        py: Python<'py>,
        action: &Bound<'py, PyAny>,
        exteroception: bool,
    ) -> PyResult<Stepped<'py>> {
        let mut taken = self.live.take(py, "step")?;
        let Live { env, action: values } = &mut *taken;
        actions::read(action, values)?;
        let step = py.detach(|| {
            let step = env.step(values)?;
            if exteroception {
                env.exteroception()?;
            }
            Ok(step)
        });
        let step = step.map_err(|error| exception(py, &error))?;
        let infos = self.names.infos(py, env)?;
        if let Some(fault) = &step.fault {
            infos.set_item("fault", fault.to_string())?;
        }
        let observation = PyArray1::from_slice(py, env.observation());
        Ok((observation, step.reward, step.terminated, step.truncated, infos))
    }

    /// Takes many steps with the same action and returns nothing: what steps cost without crossing into Python.
    fn repeat(&self, py: Python<'_>, action: &Bound<'_, PyAny>, steps: usize) -> PyResult<()> {
        let mut taken = self.live.take(py, "repeat")?;
        let Live { env, action: values } = &mut *taken;
        actions::read(action, values)?;
        py.detach(|| (0..steps).try_for_each(|_| env.step(values).map(drop)))
            .map_err(|error| exception(py, &error))
    }

    /// A picture as the render mode asks for it: H x W x 3 bytes of colour, or H x W depths [m]; `None` without a mode.
    fn render<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let mut taken = self.live.take(py, "render")?;
        let env = &mut taken.env;
        let picture = py.detach(|| env.render()).map_err(|error| exception(py, &error))?;
        let mode = self.request.options.rendering.mode;
        picture.zip(mode).map(|(picture, mode)| pixels(py, picture, mode)).transpose()
    }

    /// Frees the environment; again, nothing.
    fn close(&self) -> PyResult<bool> {
        Ok(self.live.close()?.is_some())
    }

    /// Whether it was closed.
    fn closed(&self) -> PyResult<bool> {
        self.live.is_closed()
    }

    /// Another environment in the same state, which goes on by itself.
    fn fork(&self, py: Python<'_>) -> PyResult<Self> {
        Ok(self.like(py, self.copy(py)?))
    }

    /// The observation vector of the present state.
    fn observation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.with(py, "get_obs", |env| Ok(PyArray1::from_slice(py, env.observation())))
    }

    /// What each agent of an environment for several observes, and what it earns, by name.
    fn agents<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
        self.with(py, "agents", |env| team::seen(py, env))
    }

    /// The joint action of one action for each agent, by name.
    fn join<'py>(&self, py: Python<'py>, actions: &Bound<'_, PyDict>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.with(py, "join", |env| team::join(py, env, actions))
    }

    /// The observation dictionary of the present state.
    fn obs_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, "get_obs_dict", |env| self.names.obs_dict(py, env))
    }

    /// The terms of the reward of the present state.
    fn rwd_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, "get_reward_dict", |env| self.names.rwd_dict(py, env))
    }

    /// The rows of the proprioception.
    fn proprio_dict<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        self.with(py, "get_proprioception", |env| self.names.proprio_dict(py, env))
    }

    /// The images of the visual keys, drawn where they are not of the present state.
    fn visual_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let mut taken = self.live.take(py, "get_exteroception")?;
        let env = &mut taken.env;
        py.detach(|| env.exteroception().map(|_| ())).map_err(|error| exception(py, &error))?;
        env.visuals().map_or_else(|| Ok(PyDict::new(py)), |seen| visual_dict(py, seen))
    }

    /// What a step returns last.
    fn infos<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, "get_env_infos", |env| self.names.infos(py, env))
    }

    /// The state of the world.
    fn world<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, "get_env_state", |env| world::world(py, env, &self.names.own))
    }

    /// Takes over a state of the world, and observes and rewards it.
    fn set_world(&self, py: Python<'_>, state: &Bound<'_, PyDict>) -> PyResult<()> {
        let mut taken = self.live.take(py, "set_env_state")?;
        let env = &mut taken.env;
        let world = world::read(env, &self.names.own, state)?;
        py.detach(|| env.set_world(&world).map(|_| ())).map_err(|error| exception(py, &error))
    }

    /// What another process goes on from: arrays of the model that differ from those it was made with, by name, and
    /// words of everything else.
    fn memory<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyArray1<u64>>)> {
        let made = self.request.make(py)?;
        let memory = self.live.take(py, "pickle")?.env.memory(&made);
        let edits = PyDict::new(py);
        memory
            .edits
            .iter()
            .try_for_each(|(name, values)| edits.set_item(name, PyArray1::from_slice(py, values)))?;
        Ok((edits, PyArray1::from_vec(py, memory.words)))
    }

    /// Goes on from what [`memory`](Self::memory) returned.
    fn set_memory(
        &self,
        py: Python<'_>,
        edits: Vec<(String, PyReadonlyArray1<'_, f64>)>,
        words: PyReadonlyArray1<'_, u64>,
    ) -> PyResult<()> {
        let edit = |(name, values): &(String, PyReadonlyArray1<'_, f64>)| {
            (name.clone(), values.as_array().iter().copied().collect())
        };
        let memory = EnvMemory {
            edits: edits.iter().map(edit).collect(),
            words: words.as_array().iter().copied().collect(),
        };
        let mut taken = self.live.take(py, "unpickle")?;
        taken.env.set_memory(memory).map_err(|error| exception(py, &error))
    }

    /// Restarts all draws.
    fn seed(&self, py: Python<'_>, seed: u64) -> PyResult<()> {
        let mut taken = self.live.take(py, "seed")?;
        taken.env.seed(seed);
        Ok(())
    }

    /// `dense` and `sparse` rewards and `done` of a path's observations (T x length). The reward of a step belongs to the
    /// observation after it.
    fn path_rewards<'py>(
        &self,
        py: Python<'py>,
        observations: PyReadonlyArrayDyn<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let values: Vec<f64> = observations.as_array().iter().copied().collect();
        self.with(py, "compute_path_rewards", |env| {
            let rewards = env.path_rewards(&values).map_err(|error| exception(py, &error))?;
            let dense: Vec<_> = rewards.iter().map(|reward| reward.dense).collect();
            let sparse: Vec<_> = rewards.iter().map(|reward| reward.verdict.sparse).collect();
            let done: Vec<_> = rewards.iter().map(|reward| reward.verdict.done).collect();
            let dict = PyDict::new(py);
            dict.set_item("dense", PyArray1::from_vec(py, dense))?;
            dict.set_item("sparse", PyArray1::from_vec(py, sparse))?;
            dict.set_item("done", PyArray1::from_vec(py, done))?;
            Ok(dict)
        })
    }

    /// What does not change after the environment was made, by name.
    fn description<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, "description", |env| describe(py, env, &self.request))
    }

    /// Simulation time [s].
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, "time", |env| Ok(env.scene().data.time()))
    }

    /// An array or size of the model (`model`), an array of the simulation (`data`), or an option (`option`), under MuJoCo's
    /// name, as a copy; `None` if there is none.
    fn array<'py>(&self, py: Python<'py>, of: &str, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.with(py, "sim", |env| arrays::named(py, env.scene(), of, name))
    }

    /// The number of an element of the model.
    fn element(&self, py: Python<'_>, kind: &str, name: &str) -> PyResult<usize> {
        self.with(py, "sim", |env| arrays::element(env.scene(), kind, name))
    }

    /// The name of the camera of a number.
    fn camera_name(&self, py: Python<'_>, number: usize) -> PyResult<String> {
        self.with(py, "sim", |env| {
            let model = &env.scene().model;
            let missing = || PyValueError::new_err(format!("the model has {} cameras", model.ncam));
            let known = (number < model.ncam).then(|| model.name_of(ObjType::Camera, number).to_string());
            known.ok_or_else(missing)
        })
    }

    /// Colours of the present state from a camera, and depths [m] where they are wanted.
    fn draw<'py>(
        &self,
        py: Python<'py>,
        camera: &str,
        width: usize,
        height: usize,
        depth: bool,
    ) -> PyResult<(Bound<'py, PyAny>, Option<Bound<'py, PyAny>>)> {
        let mut taken = self.live.take(py, "render")?;
        let env = &mut taken.env;
        let mut picture = Picture::new(width, height);
        let channels = Channels { rgb: true, depth, segmentation: false };
        py.detach(|| env.draw(camera, channels, &mut picture)).map_err(|error| exception(py, &error))?;
        let depths = depth.then(|| pixels(py, &picture, RenderMode::DepthArray)).transpose()?;
        Ok((pixels(py, &picture, RenderMode::RgbArray)?, depths))
    }
}

impl PyEnv {
    fn of(py: Python<'_>, env: Env, request: Request) -> Self {
        let (names, action) = (Names::of(py, &env), vec![0.0; env.action_len()]);
        PyEnv { live: Turns::of(Live { env, action }), names, request }
    }

    /// Another environment in the same state.
    ///
    /// # Errors
    /// This one was closed, or is in a call of another thread.
    pub fn copy(&self, py: Python<'_>) -> PyResult<Env> {
        let taken = self.live.take(py, "copy")?;
        taken.env.fork().map_err(|error| exception(py, &error))
    }

    /// An environment that was made by the same request.
    pub fn like(&self, py: Python<'_>, env: Env) -> Self {
        PyEnv::of(py, env, self.request.clone())
    }

    /// Works on the environment with the interpreter's lock released, for a call of this name.
    ///
    /// # Errors
    /// It was closed, or is in a call of another thread.
    pub fn detached<T: Send>(
        &self,
        py: Python<'_>,
        call: &str,
        f: impl FnOnce(&mut Env) -> T + Send,
    ) -> PyResult<T> {
        let mut taken = self.live.take(py, call)?;
        let env = &mut taken.env;
        Ok(py.detach(|| f(env)))
    }

    /// Looks at the environment, for a call of this name.
    ///
    /// # Errors
    /// It was closed, or is in a call of another thread; or those of `f`.
    pub fn with<T>(&self, py: Python<'_>, call: &str, f: impl FnOnce(&Env) -> PyResult<T>) -> PyResult<T> {
        f(&self.live.take(py, call)?.env)
    }
}

fn pixels<'py>(py: Python<'py>, picture: &Picture, mode: RenderMode) -> PyResult<Bound<'py, PyAny>> {
    let (height, width) = (picture.height, picture.width);
    match mode {
        RenderMode::RgbArray => Ok(shaped(py, &[height, width, 3], &picture.rgb)?.into_any()),
        RenderMode::DepthArray => Ok(shaped(py, &[height, width], &picture.depth)?.into_any()),
    }
}

fn describe<'py>(py: Python<'py>, env: &Env, request: &Request) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let bounds: Vec<_> = (0..env.action_len()).map(|k| env.action_bounds(k)).collect();
    let edge = |side: usize| bounds.iter().map(|bound| bound[side]).collect::<Vec<_>>();
    let visual: Vec<_> = env.visual_keys().iter().map(ToString::to_string).collect();
    let weights = PyDict::new(py);
    env.weights().iter().try_for_each(|(name, weight)| weights.set_item(name, weight))?;
    dict.set_item("id", &env.spec().id)?;
    dict.set_item("suite", &env.spec().suite)?;
    dict.set_item("task", &env.spec().task)?;
    dict.set_item("compat", request.options.compat.to_string())?;
    let mode = request.options.rendering.mode.map(|mode| mode.to_string());
    dict.set_item("render_mode", mode)?;
    dict.set_item("horizon", request.horizon)?;
    dict.set_item("frame_skip", env.frame_skip())?;
    dict.set_item("dt", env.dt())?;
    dict.set_item("normalize_act", env.settings().normalize_act)?;
    dict.set_item("obs_range", env.settings().obs_range)?;
    dict.set_item("obs_range_given", request.options.changes.contains("obs_range"))?;
    dict.set_item("obs_size", env.observation().len())?;
    dict.set_item("obs_keys", env.obs_keys())?;
    dict.set_item("proprio_keys", env.proprio_keys())?;
    dict.set_item("visual_keys", visual)?;
    dict.set_item("weights", weights)?;
    dict.set_item("sparse", env.settings().reward_mode == env::RewardMode::Sparse)?;
    dict.set_item("share", env.success() == env::Success::Share)?;
    dict.set_item("action_low", PyArray1::from_vec(py, edge(0)))?;
    dict.set_item("action_high", PyArray1::from_vec(py, edge(1)))?;
    dict.set_item("agents", team::describe(py, env)?)?;
    dict.set_item("warnings", PyString::new(py, &env.warnings().to_string()))?;
    Ok(dict)
}
