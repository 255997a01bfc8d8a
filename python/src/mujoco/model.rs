//! `MjModel`: a compiled model, and the numpy arrays through which Python edits it.

use super::arena::Engine;
use super::error::{FatalError, refused};
use super::fresh::array;
use super::mirror::{Layout, Mirror};
use physics::model::{Arrays, EditError, ObjType};
use physics::table::Slice;
use physics::{Model as Compiled, set_const};
use pyo3::exceptions::{PyAttributeError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::{PyBytes, PyDict};
use std::sync::{Arc, Mutex, MutexGuard};
use viewer::settings;

/// A model as the compiler made it, on its way into an `MjModel`.
#[pyclass(frozen, module = "robohive._core.mujoco")]
pub struct CompiledModel {
    pub model: Arc<Compiled>,
}

#[pymethods]
impl CompiledModel {
    /// The model whose bytes `Model.to_bytes` returned.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        let model = Compiled::from_bytes(bytes).map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(CompiledModel { model: Arc::new(model) })
    }
}

/// A compiled model. `MjModel` inherits from it.
#[pyclass(subclass, frozen, module = "robohive._core.mujoco")]
pub struct Model {
    held: Mutex<Held>,
    /// All sizes, in order of declaration.
    sizes: Arc<[usize]>,
}

struct Held {
    model: Arc<Compiled>,
    sources: Arc<[Source]>,
    mirror: Mirror,
}

/// What an array of Python shows.
#[derive(Clone, Copy)]
enum Source {
    /// An array of the table of fields, by number.
    Array(usize, &'static str),
    /// A setting of several numbers: group, name.
    Setting(&'static str, &'static str),
}

struct View<'a> {
    arrays: &'a Arrays,
    sources: &'a [Source],
}

impl Engine for View<'_> {
    fn read(&self, place: usize, show: &mut dyn FnMut(Slice<'_>)) {
        match self.sources.get(place) {
            Some(Source::Array(number, _)) => {
                self.arrays.array(*number).map(show);
            }
            Some(Source::Setting(group, name)) => {
                settings::read(self.arrays, group, name, show);
            }
            None => {}
        }
    }
}

/// All arrays of a model, and all settings that are arrays.
fn lay_out(arrays: &Arrays) -> (Layout, Vec<Source>) {
    let (mut layout, mut sources) = (Layout::default(), Vec::new());
    arrays.visit(&mut |name, shape, slice| {
        sources.push(Source::Array(sources.len(), name));
        layout.add(name, shape, &slice);
    });
    for group in settings::GROUPS {
        settings::visit(arrays, group, &mut |name, slice| {
            if slice.len() > 1 {
                sources.push(Source::Setting(group, name));
                layout.add(format!("{group}.{name}"), vec![slice.len()], &slice);
            }
        });
    }
    (layout, sources)
}

/// Sizes of a model, in order of declaration.
fn sizes_of(arrays: &Arrays) -> Arc<[usize]> {
    let mut sizes = Vec::new();
    arrays.visit_sizes(&mut |_, size| sizes.push(size));
    sizes.into()
}

impl Held {
    fn view(&self) -> View<'_> {
        View { arrays: &self.model, sources: &self.sources }
    }

    /// Writes into the model what Python wrote into its arrays; pixels, which no motion depends on, only for `pictures`.
    fn accept_edits(&mut self, py: Python<'_>, pictures: bool) -> PyResult<()> {
        let wanted = |place: usize| pictures || !matches!(self.sources[place], Source::Array(_, "tex_data"));
        let edits = self.mirror.differing(py, &self.view(), &wanted)?;
        if edits.is_empty() {
            return Ok(());
        }
        let sources = Arc::clone(&self.sources);
        let written = Arc::make_mut(&mut self.model).overwrite(|draft| {
            for (place, numbers) in &edits {
                match sources[*place] {
                    Source::Array(_, name) => draft.assign(name, numbers),
                    Source::Setting(group, name) => settings::assign(draft, group, name, numbers),
                };
            }
        });
        written.map_err(|error| refused(&error))
    }
}

impl Model {
    fn lock(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Held>> {
        self.held.lock_py_attached(py).map_err(|_| PyRuntimeError::new_err("the model is lost after a fault"))
    }

    /// The model with all that Python has written into its arrays.
    ///
    /// # Errors
    /// Something that was written does not fit; the message names array and place.
    pub fn current(&self, py: Python<'_>) -> PyResult<Arc<Compiled>> {
        let mut held = self.lock(py)?;
        held.accept_edits(py, false)?;
        Ok(Arc::clone(&held.model))
    }

    /// The same with what was written into pixels of textures.
    ///
    /// # Errors
    /// As [`Model::current`].
    pub fn current_for_pictures(&self, py: Python<'_>) -> PyResult<Arc<Compiled>> {
        let mut held = self.lock(py)?;
        held.accept_edits(py, true)?;
        Ok(Arc::clone(&held.model))
    }

    /// Sizes of the model.
    pub fn sizes(&self) -> &Arc<[usize]> {
        &self.sizes
    }

    /// Changes the model, then shows it in the arrays of Python.
    pub fn change(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut Compiled) -> Result<(), String>,
    ) -> PyResult<()> {
        let mut held = self.lock(py)?;
        held.accept_edits(py, true)?;
        change(Arc::make_mut(&mut held.model)).map_err(FatalError::new_err)?;
        held.mirror.push(py, &held.view())
    }
}

#[pymethods]
impl Model {
    #[new]
    fn new(compiled: &CompiledModel) -> Self {
        let model = Arc::clone(&compiled.model);
        let (layout, sources) = lay_out(&model);
        let sizes = sizes_of(&model);
        let mirror = Mirror::new(Arc::new(layout));
        Model { held: Mutex::new(Held { model, sources: sources.into(), mirror }), sizes }
    }

    /// A copy of the model as it is now.
    fn _compiled(&self, py: Python<'_>) -> PyResult<CompiledModel> {
        Ok(CompiledModel { model: self.current_for_pictures(py)? })
    }

    /// The model as bytes of its own format.
    fn _to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.current_for_pictures(py)?.to_bytes()))
    }

    /// The array called `name`, a view that later calls keep up to date.
    fn _array<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let mut held = self.lock(py)?;
        let Held { model, sources, mirror } = &mut *held;
        let found = mirror.hand(py, name, &View { arrays: model, sources })?;
        found.ok_or_else(|| PyAttributeError::new_err(format!("the model has no array {name:?}")))
    }

    /// A copy of the array called `name`.
    fn _copied<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let held = self.lock(py)?;
        let mut copied = None;
        held.model.visit(&mut |own, shape, slice| {
            if own == name {
                copied = Some(array(py, slice, shape));
            }
        });
        copied.unwrap_or_else(|| Err(PyAttributeError::new_err(format!("the model has no array {name:?}"))))
    }

    /// Type and shape of every array.
    fn _describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (layout, _) = lay_out(&self.lock(py)?.model);
        layout.describe(py)
    }

    /// Sizes by name.
    fn _size_table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (all, held) = (PyDict::new(py), self.lock(py)?);
        let mut result = Ok(());
        held.model.visit_sizes(&mut |name, size| {
            if result.is_ok() {
                // All bits set stand for none.
                result = all.set_item(name, i64::try_from(size).unwrap_or(-1));
            }
        });
        result.map(|()| all)
    }

    /// Bytes of `names`, `paths` or `text_data`.
    fn _bytes<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyBytes>> {
        let held = self.lock(py)?;
        let model = &held.model;
        Ok(PyBytes::new(
            py,
            match name {
                "names" => &model.names,
                "paths" => &model.paths,
                "text_data" => &model.text_data,
                _ => return Err(PyAttributeError::new_err(format!("no bytes called {name:?}"))),
            },
        ))
    }

    /// Names and numbers of the settings of a group.
    fn _settings<'py>(&self, py: Python<'py>, group: &str) -> PyResult<Bound<'py, PyDict>> {
        let model = self.current(py)?;
        settings_dict(py, &model, group)
    }

    /// The numbers of one setting.
    fn _setting(&self, py: Python<'_>, group: &str, name: &str) -> PyResult<Option<f64>> {
        let held = self.lock(py)?;
        let mut value = None;
        settings::read(&held.model, group, name, &mut |slice| value = first(slice));
        Ok(value)
    }

    /// Overwrites a setting that is one number. What was written into arrays counts from the next call on.
    fn _set_setting(&self, py: Python<'_>, group: &str, name: &str, value: f64) -> PyResult<()> {
        let mut held = self.lock(py)?;
        let mut fits = None;
        let edited = Arc::make_mut(&mut held.model).overwrite(|draft| {
            fits = settings::assign(draft, group, name, &[value]);
        });
        edited.map_err(|error: EditError| refused(&error))?;
        match fits {
            Some(true) => Ok(()),
            Some(false) => Err(PyValueError::new_err(format!("[{value:?}] is no value of {group}.{name}"))),
            None => Err(PyAttributeError::new_err(format!("{group} has no setting {name:?}"))),
        }
    }

    /// Id of an element by code of its kind and name, -1 for none.
    fn _id(&self, py: Python<'_>, kind: i32, name: &str) -> PyResult<i32> {
        let kind = ObjType::from_code(kind);
        let held = self.lock(py)?;
        Ok(kind.and_then(|kind| held.model.id_of(kind, name)).map_or(-1, |id| id as i32))
    }

    /// Name of an element by code of its kind and id, empty for none.
    fn _name(&self, py: Python<'_>, kind: i32, id: i64) -> PyResult<String> {
        let held = self.lock(py)?;
        let at = ObjType::from_code(kind).zip(usize::try_from(id).ok());
        Ok(at.map_or("", |(kind, id)| held.model.name_of(kind, id)).to_owned())
    }

    /// Recomputes what follows from masses, poses and gears at `qpos0`.
    fn _set_const(&self, py: Python<'_>) -> PyResult<()> {
        self.change(py, |model| set_const(model).map_err(|error| error.to_string()))
    }
}

fn first(slice: Slice<'_>) -> Option<f64> {
    slice.to_f64().first().copied()
}

/// Names of all arrays, and of all sizes.
#[pyfunction]
pub fn model_fields() -> (Vec<&'static str>, Vec<&'static str>) {
    let (mut arrays, mut sizes) = (Vec::new(), Vec::new());
    let empty = Arrays::default();
    empty.visit(&mut |name, _, _| arrays.push(name));
    empty.visit_sizes(&mut |name, _| sizes.push(name));
    (arrays, sizes)
}

/// Settings of a group before anything is set.
#[pyfunction]
pub fn default_settings<'py>(py: Python<'py>, group: &str) -> PyResult<Bound<'py, PyDict>> {
    settings_dict(py, &Arrays::default(), group)
}

/// Settings of a group as numbers and lists of numbers.
fn settings_dict<'py>(py: Python<'py>, arrays: &Arrays, group: &str) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let mut result = Ok(());
    settings::visit(arrays, group, &mut |name, slice| {
        if result.is_err() {
            return;
        }
        result = match &slice {
            Slice::I32([code]) => all.set_item(name, code),
            slice if slice.len() == 1 => all.set_item(name, first(*slice)),
            slice => all.set_item(name, slice.to_f64()),
        };
    });
    result.map(|()| all)
}
