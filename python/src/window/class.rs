//! `robohive._core.Window`.

use super::arguments::{FigureGiven, OpeningGiven, PlaceGiven, SightGiven, TextGiven, describe, image, text};
use crate::env::PyEnv;
use crate::mujoco::{Data, Guest, Model};
use physics::{Data as Simulation, Model as Compiled};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::PyDict;
use std::ffi::OsString;
use std::process::Command;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use viewer::remote::{Client, Order, Post, Reports};

/// How long a window may take to open.
const PATIENCE: Duration = Duration::from_secs(90);

/// A window in a process of its own. Calls of a window that is closed do nothing.
#[pyclass(frozen, weakref, name = "Window", module = "robohive._core")]
pub struct PyWindow {
    client: Mutex<Client>,
    reports: Arc<Post<Reports>>,
}

/// A model and its simulation, as Python holds them.
type Subject<'py> = (Bound<'py, Model>, Bound<'py, Data>);

#[pymethods]
impl PyWindow {
    /// Opens a window of a model in a state, or an empty one; `command` is the process that calls `serve_window`.
    #[staticmethod]
    #[pyo3(signature = (command, opening, subject = None))]
    fn open(
        py: Python<'_>,
        command: Vec<OsString>,
        opening: OpeningGiven,
        subject: Option<Subject<'_>>,
    ) -> PyResult<Self> {
        match subject {
            None => Self::start(py, &command, opening, None),
            Some((m, d)) => with(py, &m, &d, |m, d| Self::start(py, &command, opening, Some((m, d))))?,
        }
    }

    /// Opens a window of an environment.
    #[staticmethod]
    fn of_env(py: Python<'_>, command: Vec<OsString>, opening: OpeningGiven, env: &PyEnv) -> PyResult<Self> {
        env.with(py, "render", |env| {
            let scene = env.scene();
            Self::start(py, &command, opening, Some((&scene.model, &scene.data)))
        })
    }

    /// Shows another model.
    fn show(
        &self,
        py: Python<'_>,
        opening: OpeningGiven,
        m: &Bound<'_, Model>,
        d: &Bound<'_, Data>,
    ) -> PyResult<bool> {
        with(py, m, d, |m, d| py.detach(|| self.locked().open(opening.into(), Some((m, d)))))
    }

    /// Sends what has changed of the model, where `whole`, and the state.
    fn sync(&self, py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>, whole: bool) -> PyResult<bool> {
        with(py, m, d, |m, d| py.detach(|| self.locked().sync(m, d, whole)))
    }

    /// The same of an environment.
    fn sync_env(&self, py: Python<'_>, env: &PyEnv) -> PyResult<bool> {
        env.with(py, "render", |env| {
            let scene = env.scene();
            Ok(py.detach(|| self.locked().sync(&scene.model, &scene.data, true)))
        })
    }

    /// Takes note that the settings of a model are those that the window has told of.
    fn agrees(&self, py: Python<'_>, m: &Bound<'_, Model>) -> PyResult<()> {
        let model = m.get().current(py)?;
        self.lock(py).agrees(&model);
        Ok(())
    }

    /// Sends camera and options.
    fn look(&self, py: Python<'_>, m: &Bound<'_, Model>, sight: SightGiven) -> PyResult<bool> {
        let sight = sight.sight(&*m.get().current(py)?);
        Ok(self.lock(py).look(sight))
    }

    /// Camera and options that a person has chosen since the last call.
    fn seen<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let seen = self.lock(py).seen();
        seen.map(|sight| describe(py, &sight)).transpose()
    }

    /// Adds items to the scene, in place of the former.
    fn items(&self, py: Python<'_>, m: &Bound<'_, Model>, guests: Vec<Guest>) -> PyResult<bool> {
        let meshes = m.get().current(py)?.nmesh;
        let items = guests.iter().map(|guest| guest.item(meshes)).collect::<Result<_, _>>()?;
        Ok(self.tell(py, &Order::Items(items)))
    }

    /// Lays texts over the picture, in place of the former.
    fn texts(&self, py: Python<'_>, texts: Vec<TextGiven>) -> bool {
        self.tell(py, &Order::Texts(texts.into_iter().map(text).collect()))
    }

    /// Lays images over the picture, in place of the former.
    fn images(&self, py: Python<'_>, images: Vec<(PlaceGiven, Vec<u8>)>) -> bool {
        self.tell(py, &Order::Images(images.into_iter().map(image).collect()))
    }

    /// Lays figures over the picture, in place of the former.
    fn figures(&self, py: Python<'_>, figures: Vec<FigureGiven>) -> bool {
        self.tell(py, &Order::Figures(figures.into_iter().map(Into::into).collect()))
    }

    /// Shows a message.
    fn trouble(&self, py: Python<'_>, text: String) -> bool {
        self.tell(py, &Order::Trouble(text))
    }

    /// What a person has done since the last call, by name.
    fn take<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let mut seen = self.reports.look();
        all.set_item("controls", std::mem::take(&mut seen.controls))?;
        all.set_item("equalities", std::mem::take(&mut seen.equalities))?;
        all.set_item("reload", std::mem::take(&mut seen.reload))?;
        let settings = std::mem::take(&mut seen.settings).into_iter();
        let settings: Vec<_> =
            settings.map(|edit| (edit.group, edit.name, edit.numbers.slice().to_f64())).collect();
        all.set_item("settings", settings)?;
        let Some(grasp) = seen.grasp.take() else { return Ok(all) };
        let held = PyDict::new(py);
        held.set_item("select", grasp.body)?;
        held.set_item("pulls", grasp.pulls)?;
        held.set_item("turns", grasp.turns)?;
        held.set_item("localpos", grasp.point)?;
        held.set_item("localmass", grasp.mass)?;
        held.set_item("scale", grasp.reach)?;
        held.set_item("refselpos", grasp.target)?;
        held.set_item("refpos", grasp.origin)?;
        held.set_item("refquat", grasp.orientation)?;
        all.set_item("grasp", held)?;
        Ok(all)
    }

    /// Where in the window the picture is: left, bottom, width, height [pixels].
    fn place(&self) -> Option<PlaceGiven> {
        self.reports.look().place.map(|place| (place.left, place.bottom, place.width, place.height))
    }

    /// The keys that were pressed since the last call, by GLFW's numbers.
    fn take_keys(&self) -> Vec<i32> {
        std::mem::take(&mut self.reports.look().keys)
    }

    /// Waits, at most so long [s], until keys are pressed, the model is asked for again, or the window is closed. False when it
    /// is closed.
    fn wait(&self, py: Python<'_>, seconds: f64) -> PyResult<bool> {
        let patience = Duration::try_from_secs_f64(seconds)
            .map_err(|error| PyValueError::new_err(format!("seconds: {error}")))?;
        let ready = |seen: &Reports| seen.over || seen.left || seen.reload || !seen.keys.is_empty();
        Ok(py.detach(|| {
            let seen = self.reports.wait(patience, ready);
            !seen.over && !seen.left
        }))
    }

    /// Overwrites the state of a simulation by the last one of what ran in the window, which is closed. False where nothing
    /// of this model ran there.
    fn finish(&self, py: Python<'_>, d: &Bound<'_, Data>) -> PyResult<bool> {
        let last = py.detach(|| {
            self.reports.wait(Duration::from_secs(1), |seen| seen.last.is_some() || seen.over).last.take()
        });
        let Some(last) = last else { return Ok(false) };
        let mut held = d.get().lock()?;
        held.pull(py)?;
        let written = last.write(&mut held.simulation);
        held.push(py)?;
        Ok(written)
    }

    /// Whether the window is open.
    fn is_open(&self, py: Python<'_>) -> bool {
        self.lock(py).is_open()
    }

    /// Why the window was lost, if it was neither closed by a person nor by the program.
    fn lost(&self) -> Option<String> {
        let seen = self.reports.look();
        let gone = || "the window's process has ended".to_owned();
        (seen.over && !seen.left).then(|| seen.failed.clone().unwrap_or_else(gone))
    }

    /// Closes the window.
    fn close(&self, py: Python<'_>) {
        py.detach(|| self.locked().close());
    }

    /// Number of the window's process.
    fn process(&self, py: Python<'_>) -> Option<u32> {
        self.lock(py).process()
    }
}

impl PyWindow {
    fn start(
        py: Python<'_>,
        command: &[OsString],
        opening: OpeningGiven,
        subject: Option<(&Compiled, &Simulation)>,
    ) -> PyResult<Self> {
        let (program, arguments) =
            command.split_first().ok_or_else(|| PyValueError::new_err("an empty command"))?;
        let opened = py.detach(|| {
            Client::spawn(Command::new(program).args(arguments), opening.into(), subject, PATIENCE)
        });
        let client = opened.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        Ok(PyWindow { reports: Arc::clone(client.reports()), client: Mutex::new(client) })
    }

    fn lock(&self, py: Python<'_>) -> MutexGuard<'_, Client> {
        self.client.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner)
    }

    /// The same without the interpreter's lock.
    fn locked(&self) -> MutexGuard<'_, Client> {
        self.client.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tell(&self, py: Python<'_>, order: &Order) -> bool {
        py.detach(|| self.locked().tell(order))
    }
}

/// Works on a model and its simulation as Python has written them.
fn with<R>(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    work: impl FnOnce(&Compiled, &Simulation) -> R,
) -> PyResult<R> {
    let compiled = m.get().current_for_pictures(py)?;
    let mut held = d.get().lock()?;
    held.check_fits(m.get())?;
    held.pull(py)?;
    Ok(work(&compiled, &held.simulation))
}
