//! The arrays of one model or one simulation as Python sees them: names, types and shapes from the engine's tables of
//! fields, and an arena for each type of scalar.

use super::arena::{Arena, Engine, EngineMut, Wanted};
use physics::table::Slice;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// Types of scalars, with numpy's characters for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Bool,
    U8,
    I32,
    I64,
    F32,
    F64,
}

impl Kind {
    fn of(slice: &Slice<'_>) -> Self {
        match slice {
            Slice::Bool(_) => Kind::Bool,
            Slice::U8(_) => Kind::U8,
            Slice::I32(_) => Kind::I32,
            Slice::I64(_) => Kind::I64,
            Slice::F32(_) => Kind::F32,
            Slice::F64(_) => Kind::F64,
        }
    }

    fn dtype(self) -> &'static str {
        match self {
            Kind::Bool => "bool",
            Kind::U8 => "uint8",
            Kind::I32 => "int32",
            Kind::I64 => "int64",
            Kind::F32 => "float32",
            Kind::F64 => "float64",
        }
    }
}

struct Place {
    kind: Kind,
    shape: Vec<usize>,
    range: Range<usize>,
}

/// What arrays there are: the same for all simulations of a model.
#[derive(Default)]
pub struct Layout {
    places: Vec<Place>,
    by_name: HashMap<String, usize>,
    totals: [usize; 6],
}

impl Layout {
    /// Adds an array; its place is the number of those before it.
    pub fn add(&mut self, name: impl Into<String>, shape: Vec<usize>, slice: &Slice<'_>) {
        let kind = Kind::of(slice);
        let start = self.totals[kind as usize];
        self.totals[kind as usize] += slice.len();
        self.by_name.insert(name.into(), self.places.len());
        self.places.push(Place { kind, shape, range: start..start + slice.len() });
    }

    /// Place of the array called `name`.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// Type and shape of every array by name.
    pub fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (name, &place) in &self.by_name {
            let Place { kind, shape, .. } = &self.places[place];
            all.set_item(name, (kind.dtype(), shape.clone()))?;
        }
        Ok(all)
    }
}

/// The arrays that Python has asked for.
pub struct Mirror {
    layout: Arc<Layout>,
    bools: Arena<bool>,
    u8s: Arena<u8>,
    i32s: Arena<i32>,
    i64s: Arena<i64>,
    f32s: Arena<f32>,
    f64s: Arena<f64>,
}

impl Mirror {
    /// No array yet.
    pub fn new(layout: Arc<Layout>) -> Self {
        let [bools, u8s, i32s, i64s, f32s, f64s] = layout.totals;
        Mirror {
            layout,
            bools: Arena::new(bools),
            u8s: Arena::new(u8s),
            i32s: Arena::new(i32s),
            i64s: Arena::new(i64s),
            f32s: Arena::new(f32s),
            f64s: Arena::new(f64s),
        }
    }

    /// The numpy array called `name`; `None` when there is none.
    pub fn hand<'py>(
        &mut self,
        py: Python<'py>,
        name: &str,
        engine: &impl Engine,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let layout = Arc::clone(&self.layout);
        let Some(place) = layout.find(name) else { return Ok(None) };
        let Place { kind, shape, range } = &layout.places[place];
        let at = (place, range.clone());
        Ok(Some(match kind {
            Kind::Bool => self.bools.hand(py, at, shape, engine)?.call_method1("view", ("?",))?,
            Kind::U8 => self.u8s.hand(py, at, shape, engine)?,
            Kind::I32 => self.i32s.hand(py, at, shape, engine)?,
            Kind::I64 => self.i64s.hand(py, at, shape, engine)?,
            Kind::F32 => self.f32s.hand(py, at, shape, engine)?,
            Kind::F64 => self.f64s.hand(py, at, shape, engine)?,
        }))
    }

    /// Copies what Python may have written into the engine.
    pub fn pull(&self, py: Python<'_>, engine: &mut impl EngineMut) -> PyResult<()> {
        self.bools.pull(py, engine)?;
        self.u8s.pull(py, engine)?;
        self.i32s.pull(py, engine)?;
        self.i64s.pull(py, engine)?;
        self.f32s.pull(py, engine)?;
        self.f64s.pull(py, engine)
    }

    /// Copies what the engine computed into the arrays of Python.
    pub fn push(&self, py: Python<'_>, engine: &impl Engine) -> PyResult<()> {
        self.bools.push(py, engine)?;
        self.u8s.push(py, engine)?;
        self.i32s.push(py, engine)?;
        self.i64s.push(py, engine)?;
        self.f32s.push(py, engine)?;
        self.f64s.push(py, engine)
    }

    /// The wanted arrays that Python has made others than the engine's: place, numbers.
    pub fn differing(
        &self,
        py: Python<'_>,
        engine: &impl Engine,
        wanted: Wanted<'_>,
    ) -> PyResult<Vec<(usize, Vec<f64>)>> {
        let mut all = Vec::new();
        let mut found = |place, numbers| all.push((place, numbers));
        self.bools.differing(py, engine, wanted, &mut found)?;
        self.u8s.differing(py, engine, wanted, &mut found)?;
        self.i32s.differing(py, engine, wanted, &mut found)?;
        self.i64s.differing(py, engine, wanted, &mut found)?;
        self.f32s.differing(py, engine, wanted, &mut found)?;
        self.f64s.differing(py, engine, wanted, &mut found)?;
        Ok(all)
    }
}
