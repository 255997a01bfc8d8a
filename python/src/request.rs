//! Which environment is asked for: an id, settings that differ from its own, and how it is made.

use crate::exceptions::exception;
use crate::live::Asked;
use crate::settings::arguments;
use env::{Arguments, Env, EnvError, Options, Registry, RenderMode, Rendering, Spec};
use library::{Library, NoGpu, Renderer, Weights};
use physics::Engine;
use pyo3::exceptions::{PyNotImplementedError, PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use render::painter::Painters;
use std::sync::Arc;

/// A specification, with what making an environment of it takes beside.
#[derive(Clone)]
pub struct Request {
    /// The id's, without the settings that were overridden.
    pub spec: Spec,
    /// Options, changed settings among them.
    pub options: Options,
    /// Steps of an episode, whoever counts them.
    pub horizon: usize,
}

/// Options as Python gives them: keyword arguments of every environment that are no settings.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Making {
    seed: Option<u64>,
    compat: String,
    render_mode: Option<String>,
    camera: Option<String>,
    width: Option<usize>,
    height: Option<usize>,
    renderer: String,
    instability: String,
    solver: String,
    override_keys: Vec<String>,
    /// Whether the environment ends episodes at their length itself; otherwise a wrapper does.
    time_limit: bool,
    /// Devices, if the robot is not simulated.
    hardware: Option<Asked>,
}

impl Request {
    /// Reads a request: an id of the registry; `settings`, a dictionary that differs from the id's; and `making`, a
    /// dictionary of [`Making`].
    ///
    /// # Errors
    /// The id is unknown, a setting is none, or an option has a wrong value.
    pub fn read(id: &str, settings: &Bound<'_, PyDict>, making: &Bound<'_, PyDict>) -> PyResult<Self> {
        let py = settings.py();
        let mut spec = Registry::builtin().spec(id).map_err(|error| exception(py, &error))?.clone();
        let mut changes = arguments(settings)?;
        let making: Making = making.extract()?;
        forget(&mut spec, &making.override_keys, &changes)?;
        let wrong = |message: String| PyValueError::new_err(message);
        let default = Rendering::default();
        let mode = making
            .render_mode
            .map(|mode| mode.parse::<RenderMode>())
            .transpose()
            .map_err(|error| wrong(error.to_string()))?;
        let rendering = Rendering {
            mode,
            camera: making.camera.unwrap_or(default.camera),
            width: making.width.unwrap_or(default.width),
            height: making.height.unwrap_or(default.height),
        };
        let compat = making.compat.parse().map_err(|error| wrong(format!("compat: {error}")))?;
        let painters = painters(&making.renderer)?;
        let autoreset = match making.instability.as_str() {
            "truncate" => false,
            "reset" => true,
            other => return Err(wrong(format!("instability is truncate or reset, not {other}"))),
        };
        let engine = engine(&making.solver)?;
        let networks = Arc::new(Weights::from_environment());
        let seed = making.seed.unwrap_or(Options::default().seed);
        let horizon = spec.with(&changes).map_err(|error| exception(py, &error))?.max_episode_steps;
        if !making.time_limit {
            changes =
                changes.with("max_episode_steps", i64::MAX).map_err(|error| wrong(error.to_string()))?;
        }
        let options = Options::default()
            .with_seed(seed)
            .with_compat(compat)
            .with_changes(changes)
            .with_rendering(rendering)
            .with_networks(networks)
            .with_painters(painters)
            .with_autoreset(autoreset)
            .with_engine(engine);
        let hardware = making.hardware.map(|asked| asked.hardware(py, &spec, &options)).transpose()?;
        Ok(Request { spec, horizon, options: options.with_hardware(hardware) })
    }

    /// Makes the environment, from the models of this machine; the interpreter's lock is released meanwhile.
    ///
    /// # Errors
    /// Files are missing or wrong; settings do not fit.
    pub fn make(&self, py: Python<'_>) -> PyResult<Env> {
        let made = py.detach(|| {
            let library = Library::from_environment(None, None).map_err(|error| error.to_string())?;
            Ok::<Result<Env, EnvError>, String>(Env::build(&self.spec, &library, &self.options))
        });
        made.map_err(PyOSError::new_err)?.map_err(|error| exception(py, &error))
    }
}

/// The engine of a name.
fn engine(solver: &str) -> PyResult<Engine> {
    match solver {
        Engine::OWN => Ok(Engine::default()),
        "rapier" => rapier(),
        other => Err(PyValueError::new_err(format!("solver is own or rapier, not {other:?}"))),
    }
}

#[cfg(feature = "rapier")]
fn rapier() -> PyResult<Engine> {
    Ok(rapier::engine(rapier::Options::default()))
}

#[cfg(not(feature = "rapier"))]
fn rapier() -> PyResult<Engine> {
    Err(PyNotImplementedError::new_err(
        "this wheel has no rapier; build one with `maturin build --profile dist --features rapier`",
    ))
}

/// What draws pictures.
fn painters(renderer: &str) -> PyResult<Arc<dyn Painters>> {
    let renderer: Renderer = renderer
        .parse()
        .map_err(|valid| PyValueError::new_err(format!("renderer is {valid}, not {renderer:?}")))?;
    renderer.painters().map_err(|NoGpu| {
        PyNotImplementedError::new_err(
            "this wheel draws on the CPU alone; `maturin build --profile dist --features gpu` builds one that asks a GPU",
        )
    })
}

/// Takes settings away from a specification, so that the changes replace them rather than being merged into them.
fn forget(spec: &mut Spec, keys: &[String], changes: &Arguments) -> PyResult<()> {
    for key in keys {
        if !spec.args.remove(key) && !changes.contains(key) {
            let id = &spec.id;
            return Err(PyValueError::new_err(format!(
                "override_keys: {id} has no setting {key} to override"
            )));
        }
    }
    Ok(())
}
