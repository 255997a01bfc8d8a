//! Numpy memory beside the engine's: what attributes such as `data.qpos` show, copied before and after every call.
//!
//! Python may write any of its arrays at any time, so none of them is the engine's own memory. All arrays of one scalar
//! type stand in one block, which costs nothing until it is touched; those that Python has asked for are copied in one
//! sweep, so that a call costs what was accessed.

use numpy::{Element, PyArray1, PyArrayMethods};
use physics::table::{Slice, SliceMut};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::ops::Range;

/// The engine's side of the arrays, by place in a layout.
pub trait Engine {
    /// Shows the array at `place`.
    fn read(&self, place: usize, show: &mut dyn FnMut(Slice<'_>));
}

/// The same where calls may write.
pub trait EngineMut: Engine {
    /// The array at `place`, to write.
    fn write(&mut self, place: usize) -> Option<SliceMut<'_>>;
}

/// A scalar of the engine, and how numpy holds it.
pub trait Scalar: Copy {
    /// The scalar in numpy's memory.
    type Stored: Element + Copy;
    fn of(slice: Slice<'_>) -> Option<&[Self]>;
    fn of_mut(slice: SliceMut<'_>) -> Option<&mut [Self]>;
    fn store(self) -> Self::Stored;
    fn load(stored: Self::Stored) -> Self;
    /// The same bits: a NaN is itself, and a zero is not its negative.
    fn is_same(self, stored: Self::Stored) -> bool;
    fn number(stored: Self::Stored) -> f64;
}

macro_rules! scalar {
    ($($t:ty, $stored:ty, $variant:ident, |$x:ident| $store:expr, |$s:ident| $load:expr, |$a:ident, $b:ident| $same:expr, $number:expr;)*) => {$(
        impl Scalar for $t {
            type Stored = $stored;
            fn of(slice: Slice<'_>) -> Option<&[Self]> {
                if let Slice::$variant(s) = slice { Some(s) } else { None }
            }
            fn of_mut(slice: SliceMut<'_>) -> Option<&mut [Self]> {
                if let SliceMut::$variant(s) = slice { Some(s) } else { None }
            }
            fn store(self) -> $stored {
                let $x = self;
                $store
            }
            fn load($s: $stored) -> Self {
                $load
            }
            fn is_same(self, $b: $stored) -> bool {
                let $a = self;
                $same
            }
            fn number(stored: $stored) -> f64 {
                let number: fn($stored) -> f64 = $number;
                number(stored)
            }
        }
    )*};
}
scalar! {
    // Numpy's truth values are bytes, and a program may set them to others than 0 and 1.
    bool, u8, Bool, |x| u8::from(x), |s| s != 0, |a, b| a == (b != 0), |s| f64::from(u8::from(s != 0));
    u8, u8, U8, |x| x, |s| s, |a, b| a == b, f64::from;
    i32, i32, I32, |x| x, |s| s, |a, b| a == b, f64::from;
    i64, i64, I64, |x| x, |s| s, |a, b| a == b, |s| s as f64;
    f32, f32, F32, |x| x, |s| s, |a, b| a.to_bits() == b.to_bits(), f64::from;
    f64, f64, F64, |x| x, |s| s, |a, b| a.to_bits() == b.to_bits(), |s| s;
}

/// One block of numpy memory for all arrays of one scalar type.
pub struct Arena<T: Scalar> {
    scalars: usize,
    memory: Option<Py<PyArray1<T::Stored>>>,
    /// Places that Python has asked for, and where they stand.
    handed: Vec<(usize, Range<usize>)>,
}

/// Which arrays are compared with the engine's.
pub type Wanted<'a> = &'a dyn Fn(usize) -> bool;

fn in_use(error: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(format!("the arrays are in use by another call: {error}"))
}

impl<T: Scalar> Arena<T> {
    /// Memory of `scalars` scalars, allocated with the first array.
    pub fn new(scalars: usize) -> Self {
        Arena { scalars, memory: None, handed: Vec::new() }
    }

    /// A numpy view of the array at `place`, kept up to date by every later call.
    pub fn hand<'py>(
        &mut self,
        py: Python<'py>,
        (place, range): (usize, Range<usize>),
        shape: &[usize],
        engine: &impl Engine,
    ) -> PyResult<Bound<'py, PyAny>> {
        let scalars = self.scalars;
        let memory =
            self.memory.get_or_insert_with(|| PyArray1::zeros(py, scalars, false).unbind()).bind(py).clone();
        if !self.handed.iter().any(|(known, _)| *known == place) {
            let mut all = memory.try_readwrite().map_err(in_use)?;
            copy_out::<T>(engine, place, &mut all.as_slice_mut()?[range.clone()]);
            self.handed.push((place, range.clone()));
        }
        let flat =
            memory.get_item(pyo3::types::PySlice::new(py, range.start as isize, range.end as isize, 1))?;
        flat.call_method1("reshape", (shape.to_vec(),))
    }

    /// Copies from numpy into the engine.
    pub fn pull(&self, py: Python<'_>, engine: &mut impl EngineMut) -> PyResult<()> {
        let Some(memory) = &self.memory else { return Ok(()) };
        let all = memory.bind(py).try_readonly().map_err(in_use)?;
        let all = all.as_slice()?;
        for (place, range) in &self.handed {
            if let Some(to) = engine.write(*place).and_then(T::of_mut) {
                to.iter_mut().zip(&all[range.clone()]).for_each(|(to, &from)| *to = T::load(from));
            }
        }
        Ok(())
    }

    /// Copies from the engine into numpy.
    pub fn push(&self, py: Python<'_>, engine: &impl Engine) -> PyResult<()> {
        let Some(memory) = &self.memory else { return Ok(()) };
        let mut all = memory.bind(py).try_readwrite().map_err(in_use)?;
        let all = all.as_slice_mut()?;
        for (place, range) in &self.handed {
            copy_out::<T>(engine, *place, &mut all[range.clone()]);
        }
        Ok(())
    }

    /// Calls `found(place, numbers)` for every wanted array that Python has made another than the engine's.
    pub fn differing(
        &self,
        py: Python<'_>,
        engine: &impl Engine,
        wanted: Wanted<'_>,
        found: &mut dyn FnMut(usize, Vec<f64>),
    ) -> PyResult<()> {
        let Some(memory) = &self.memory else { return Ok(()) };
        let all = memory.bind(py).try_readonly().map_err(in_use)?;
        let all = all.as_slice()?;
        for (place, range) in self.handed.iter().filter(|(place, _)| wanted(*place)) {
            let mine = &all[range.clone()];
            let mut same = true;
            engine.read(*place, &mut |slice| {
                same = T::of(slice).is_none_or(|own| {
                    // Without branches, which vectorises.
                    own.iter().zip(mine).fold(true, |same, (a, &b)| same & a.is_same(b))
                });
            });
            if !same {
                found(*place, mine.iter().map(|&x| T::number(x)).collect());
            }
        }
        Ok(())
    }
}

fn copy_out<T: Scalar>(engine: &impl Engine, place: usize, to: &mut [T::Stored]) {
    engine.read(place, &mut |slice| {
        if let Some(from) = T::of(slice) {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = from.store());
        }
    });
}
