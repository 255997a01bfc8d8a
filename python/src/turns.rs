//! One value that threads of Python take turns at, until it is closed.

use crate::exceptions::closed;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, TryLockError};

/// A value in use until it is closed.
pub struct Turns<T>(Mutex<Option<T>>);

impl<T> Turns<T> {
    /// An open value.
    pub fn of(value: T) -> Self {
        Turns(Mutex::new(Some(value)))
    }

    /// Takes the value for one call.
    ///
    /// # Errors
    /// It was closed; another thread is in a call of it, for which waiting could last forever after a fork.
    pub fn take(&self, py: Python<'_>, call: &str) -> PyResult<Taken<'_, T>> {
        let guard = self.guard(call)?;
        if guard.is_some() { Ok(Taken(guard)) } else { Err(closed(py, call)) }
    }

    /// Takes the value out; `None` where it was closed before.
    ///
    /// # Errors
    /// Another thread is in a call of it.
    pub fn close(&self) -> PyResult<Option<T>> {
        Ok(self.guard("close")?.take())
    }

    /// Whether the value was taken out.
    ///
    /// # Errors
    /// Another thread is in a call of it.
    pub fn is_closed(&self) -> PyResult<bool> {
        Ok(self.guard("closed")?.is_none())
    }

    fn guard(&self, call: &str) -> PyResult<MutexGuard<'_, Option<T>>> {
        match self.0.try_lock() {
            Ok(guard) => Ok(guard),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(format!(
                "{call} was called while another thread is in a call of the same object; give every thread its own, or take \
                 a lock around each call"
            ))),
        }
    }
}

/// A value taken for a call.
pub struct Taken<'a, T>(MutexGuard<'a, Option<T>>);

impl<T> Deref for Taken<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.0.as_ref().expect("what is closed is not taken")
    }
}

impl<T> DerefMut for Taken<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        self.0.as_mut().expect("what is closed is not taken")
    }
}
