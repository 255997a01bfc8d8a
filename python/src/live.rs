//! Robots that are hardware: which devices an environment drives, and how far they may go.

use crate::exceptions::{Raised, exception};
use env::{Env, EnvError, Hardware, NotReady, Options, Ready, Spec};
use hardware::Setup;
use library::{Library, Rehearsal, real_hardware};
use numpy::PyArray1;
use pyo3::exceptions::{PyFileNotFoundError, PyValueError};
use pyo3::prelude::*;
use robot::Config;
use std::path::PathBuf;
use std::sync::Arc;

/// Devices as Python asks for them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    /// The robot's config, if not the environment's own.
    config: Option<PathBuf>,
    arm: bool,
    dry_run: bool,
    rehearse: bool,
    /// Folder of the flight recorder.
    flight: Option<PathBuf>,
    /// Called with the start pose between episodes.
    ready: Option<Py<PyAny>>,
}

impl Asked {
    /// What an environment of this specification drives.
    ///
    /// # Errors
    /// The config cannot be read, or does not fit the model.
    pub fn hardware(self, py: Python<'_>, spec: &Spec, options: &Options) -> PyResult<Hardware> {
        let config = self.config.as_ref().map(|path| {
            if !path.exists() {
                let text = format!("robot_config: there is no file {}", path.display());
                return Err(PyFileNotFoundError::new_err(text));
            }
            Config::read(path).map_err(|error| exception(py, &EnvError::Config(error)))
        });
        let config = config.transpose()?;
        let ready = self.ready.map(calling);
        let setup =
            Setup::default().with_armed(self.arm).with_dry_run(self.dry_run).with_records(self.flight);
        if !self.rehearse {
            let nobody = || -> Ready { Arc::new(|_| Ok(())) };
            return Ok(real_hardware(config, &setup, ready.unwrap_or_else(nobody)));
        }
        let config = config.ok_or_else(|| {
            PyValueError::new_err("rehearse=True simulates the devices of a config: name it as robot_config")
        })?;
        let made = py.detach(|| {
            let library = Library::from_environment(None, None).map_err(|error| error.to_string())?;
            Ok::<_, String>(Env::build(spec, &library, options))
        });
        let mut simulated = made.map_err(PyValueError::new_err)?.map_err(|error| exception(py, &error))?;
        let rehearsal = Rehearsal::new(&config, &mut simulated)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(rehearsal.hardware(config, setup, ready))
    }
}

/// A function of Python as what prepares an episode.
fn calling(function: Py<PyAny>) -> Ready {
    Arc::new(move |qpos| {
        let called = Python::attach(|py| function.call1(py, (PyArray1::from_slice(py, qpos),)).map(drop));
        called.map_err(|error| NotReady::from(Raised(error)))
    })
}
