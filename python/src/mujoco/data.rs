//! `MjData`: one simulation, and the numpy arrays through which Python reads and writes it.

use super::arena::{Engine, EngineMut};
use super::error::FatalError;
use super::lent::Lent;
use super::mirror::{Layout, Mirror};
use super::model::Model;
use super::statistics;
use super::timed::Timers;
use super::warned::Warned;
use mjcf::edit::carry_state;
use numpy::PyArray1;
use physics::data::ArrayAddress;
use physics::table::{Slice, SliceMut};
use physics::{Data as Simulation, Model as Compiled};
use pyo3::exceptions::{PyAttributeError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

/// One simulation. `MjData` inherits from it.
#[pyclass(subclass, frozen, module = "robohive._core.mujoco")]
pub struct Data {
    model: Py<Model>,
    held: Mutex<Held>,
}

/// What a call works with.
pub struct Held {
    pub simulation: Simulation,
    addresses: Arc<[ArrayAddress]>,
    /// Warnings as Python sees them.
    warned: Warned,
    mirror: Mirror,
    /// Arrays of changing length.
    pub lent: Lent,
    /// How long calls took.
    pub timers: Timers,
    sizes: Arc<[usize]>,
}

struct View<'a> {
    simulation: &'a mut Simulation,
    addresses: &'a [ArrayAddress],
    warned: &'a mut Warned,
}

impl Engine for View<'_> {
    fn read(&self, place: usize, show: &mut dyn FnMut(Slice<'_>)) {
        match self.addresses.get(place) {
            Some(&at) => _ = self.simulation.array(at).map(show),
            None => show(Slice::I32(self.warned.array(place - self.addresses.len()))),
        }
    }
}

impl EngineMut for View<'_> {
    fn write(&mut self, place: usize) -> Option<SliceMut<'_>> {
        match self.addresses.get(place) {
            Some(&at) => self.simulation.array_mut(at),
            None => Some(SliceMut::I32(self.warned.array_mut(place - self.addresses.len()))),
        }
    }
}

fn lay_out(model: &Compiled, simulation: &Simulation) -> (Layout, Vec<ArrayAddress>) {
    let (mut layout, mut addresses) = (Layout::default(), Vec::new());
    simulation.visit_arrays(model, &mut |at, name, shape, slice| {
        addresses.push(at);
        layout.add(name, shape, &slice);
    });
    // After all that the engine has an address for.
    for name in Warned::NAMES {
        layout.add(name, vec![Warned::KINDS], &Slice::I32(&[0; Warned::KINDS]));
    }
    (layout, addresses)
}

impl Held {
    /// Takes over what Python wrote into its arrays.
    pub fn pull(&mut self, py: Python<'_>) -> PyResult<()> {
        let Held { simulation, addresses, warned, mirror, lent, .. } = self;
        warned.show(&simulation.warnings);
        mirror.pull(py, &mut View { simulation, addresses, warned })?;
        simulation.warnings = warned.counts();
        lent.pull(py, simulation)
    }

    /// Shows what the engine computed in the arrays of Python.
    pub fn push(&mut self, py: Python<'_>) -> PyResult<()> {
        let Held { simulation, addresses, warned, mirror, lent, .. } = self;
        lent.recall();
        warned.show(&simulation.warnings);
        mirror.push(py, &View { simulation, addresses, warned })
    }

    /// Refuses a model of other sizes.
    pub fn check_fits(&self, model: &Model) -> PyResult<()> {
        if Arc::ptr_eq(&self.sizes, model.sizes()) || self.sizes == *model.sizes() {
            return Ok(());
        }
        Err(FatalError::new_err("the MjData was made of another MjModel: their sizes differ"))
    }
}

impl Data {
    /// What the simulation holds, unless another thread is at work with it.
    pub fn lock(&self) -> PyResult<MutexGuard<'_, Held>> {
        match self.held.try_lock() {
            Ok(held) => Ok(held),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "this MjData is in use by another thread; give each thread an MjData of its own",
            )),
        }
    }

    /// The same for what only looks: waits for another thread that is at work.
    pub fn wait(&self, py: Python<'_>) -> MutexGuard<'_, Held> {
        self.held.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Data {
    #[new]
    fn new(py: Python<'_>, model: Py<Model>) -> PyResult<Self> {
        let compiled = model.get().current(py)?;
        let simulation = Simulation::new(&compiled);
        let (layout, addresses) = lay_out(&compiled, &simulation);
        let sizes = Arc::clone(model.get().sizes());
        let mirror = Mirror::new(Arc::new(layout));
        let warned = Warned::default();
        let (lent, timers) = (Lent::default(), Timers::default());
        let held = Held { simulation, addresses: addresses.into(), warned, mirror, lent, timers, sizes };
        Ok(Data { model, held: Mutex::new(held) })
    }

    /// The model that the simulation was made of.
    #[getter]
    fn _model(&self, py: Python<'_>) -> Py<Model> {
        self.model.clone_ref(py)
    }

    /// The array called `name`, a view that later calls keep up to date.
    fn _array<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let mut held = self.wait(py);
        let Held { simulation, addresses, warned, mirror, .. } = &mut *held;
        warned.show(&simulation.warnings);
        let found = mirror.hand(py, name, &View { simulation, addresses, warned })?;
        found.ok_or_else(|| PyAttributeError::new_err(format!("the data have no array {name:?}")))
    }

    /// Type and shape of every array whose length does not change.
    fn _describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let compiled = self.model.get().current(py)?;
        lay_out(&compiled, &self.wait(py).simulation).0.describe(py)
    }

    /// Takes over everything of `other`, a simulation of a model of the same sizes.
    fn _assign(&self, py: Python<'_>, other: &Bound<'_, Data>) -> PyResult<()> {
        if std::ptr::eq(self, other.get()) {
            return Ok(());
        }
        let (mut held, mut from) = (self.lock()?, other.get().lock()?);
        held.check_fits(other.get().model.get())?;
        from.pull(py)?;
        held.simulation.clone_from(&from.simulation);
        held.timers.clone_from(&from.timers);
        held.push(py)
    }

    /// Takes over the state of `other`, a simulation of another model, for every element that both models have.
    fn _carry(&self, py: Python<'_>, other: &Bound<'_, Data>) -> PyResult<()> {
        let (mut held, mut from) = (self.lock()?, other.get().lock()?);
        from.pull(py)?;
        let (old, new) = (other.get().model.get().current(py)?, self.model.get().current(py)?);
        held.simulation = carry_state(&old, &from.simulation, &new);
        held.push(py)
    }

    /// Simulation time [s].
    #[getter]
    fn get_time(&self, py: Python<'_>) -> f64 {
        self.wait(py).simulation.state.time
    }

    #[setter]
    fn set_time(&self, py: Python<'_>, time: f64) {
        self.wait(py).simulation.state.time = time;
    }

    /// Number of contacts.
    #[getter]
    fn ncon(&self, py: Python<'_>) -> usize {
        self.wait(py).simulation.con.contact.len()
    }

    /// Numbers of constraint rows and islands by name.
    fn _counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (all, held) = (PyDict::new(py), self.wait(py));
        let mut result = Ok(());
        let mut put = |name: &'static str, count: usize| {
            if result.is_ok() {
                result = all.set_item(name, count);
            }
        };
        held.simulation.state.visit_counts(&mut put);
        held.simulation.efc.visit_counts(&mut put);
        held.simulation.island.visit_counts(&mut put);
        result.map(|()| all)
    }

    /// Durations \[s\] and numbers of calls, by `mjtTimer`.
    fn _timers<'py>(&self, py: Python<'py>) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<i32>>) {
        let Timers { duration, number } = &self.wait(py).timers;
        (PyArray1::from_slice(py, duration), PyArray1::from_slice(py, number))
    }

    /// Every array and count by name, flat.
    fn _dump<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let compiled = self.model.get().current(py)?;
        let mut held = self.wait(py);
        held.pull(py)?;
        let all = PyDict::new(py);
        let mut result = Ok(());
        held.simulation.visit(&compiled, &mut |name, _, slice| {
            if result.is_ok() {
                result = all.set_item(name, PyArray1::from_vec(py, slice.to_f64()));
            }
        });
        result?;
        statistics::dump(&held.simulation, &held.timers, |name, values| {
            all.set_item(name, PyArray1::from_vec(py, values))
        })?;
        Ok(all)
    }

    /// Overwrites every array by what `_dump` returned.
    fn _restore(&self, py: Python<'_>, arrays: HashMap<String, Vec<f64>>) -> PyResult<()> {
        let mut held = self.lock()?;
        held.simulation.con.contact.clear();
        for (name, values) in &arrays {
            let Held { simulation, timers, .. } = &mut *held;
            if statistics::restore(simulation, timers, name, values) {
                continue;
            }
            match (name.as_str(), &values[..]) {
                ("energy", [potential, kinetic]) => simulation.energy = [*potential, *kinetic],
                ("solver_fwdinv", [a, b]) => simulation.solver.solver_fwdinv = [*a, *b],
                ("nisland" | "nidof", [count]) => _ = simulation.island.set_count(name, *count as usize),
                _ => _ = simulation.assign(name, values),
            }
        }
        held.push(py)
    }
}

/// Names of the arrays whose length follows from the model, and of the arrays and counts that change with every step.
#[pyfunction]
pub fn data_fields() -> (Vec<&'static str>, Vec<&'static str>) {
    let (mut fixed, mut changing) = (Vec::new(), Vec::new());
    let empty = Simulation::default();
    empty.visit_arrays(&Compiled::default(), &mut |_, name, _, _| fixed.push(name));
    empty.state.visit_counts(&mut |name, _| changing.push(name));
    empty.efc.visit(&mut |name, _, _| changing.push(name));
    empty.efc.visit_counts(&mut |name, _| changing.push(name));
    empty.island.visit(&mut |name, _, _| changing.push(name));
    empty.island.visit_counts(&mut |name, _| changing.push(name));
    (fixed, changing)
}
