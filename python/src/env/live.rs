//! An environment in use, and the memory that its calls share.

use crate::exceptions::closed;
use crate::infos::Names;
use env::Env;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, TryLockError};

/// An environment until it is closed.
pub struct Live {
    /// The environment.
    pub env: Env,
    /// The last action.
    pub action: Vec<f64>,
}

/// A place for one environment that threads take turns at.
pub struct Place {
    live: Mutex<Option<Live>>,
    /// Names of its rows.
    pub names: Names,
}

impl Place {
    /// The place of a new environment.
    pub fn of(py: Python<'_>, env: Env) -> Self {
        let (names, action) = (Names::of(py, &env), vec![0.0; env.action_len()]);
        Place { live: Mutex::new(Some(Live { env, action })), names }
    }

    /// Takes the environment for one call.
    ///
    /// # Errors
    /// It was closed; another thread is in a call of it, for which waiting could last forever after a fork.
    pub fn take(&self, py: Python<'_>, call: &str) -> PyResult<Taken<'_>> {
        let guard = self.guard(call)?;
        if guard.is_some() { Ok(Taken(guard)) } else { Err(closed(py, call)) }
    }

    /// Drops the environment; whether there was one.
    ///
    /// # Errors
    /// Another thread is in a call of it.
    pub fn close(&self) -> PyResult<bool> {
        Ok(self.guard("close")?.take().is_some())
    }

    /// Whether the environment was dropped.
    ///
    /// # Errors
    /// Another thread is in a call of it.
    pub fn closed(&self) -> PyResult<bool> {
        Ok(self.guard("closed")?.is_none())
    }

    fn guard(&self, call: &str) -> PyResult<MutexGuard<'_, Option<Live>>> {
        match self.live.try_lock() {
            Ok(guard) => Ok(guard),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(format!(
                "{call} was called while another thread is in a call of this environment; give every thread its own \
                 (copy.deepcopy), or take a lock around each call"
            ))),
        }
    }
}

/// An environment taken for a call.
pub struct Taken<'a>(MutexGuard<'a, Option<Live>>);

impl Taken<'_> {
    /// The environment.
    pub fn live(&mut self) -> &mut Live {
        self.0.as_mut().expect("a closed environment is not taken")
    }
}
