//! `robohive._core.VecEnv`.

use super::arrays::{Actions, Numbers, NumbersMut, Rows};
use super::infos::{Keys, Level, infos, vector};
use super::state::{states, visual_dict};
use crate::env::PyEnv;
use crate::exceptions::exception;
use crate::infos::Names;
use crate::turns::Turns;
use env::{Autoreset, EnvError, VecEnv};
use library::memory::check_room;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyIndexError, PyMemoryError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::time::{Duration, Instant};

/// Environments of one id. Calls from several threads at once are refused; the interpreter's lock is released while physics
/// runs.
#[pyclass(frozen, name = "VecEnv", module = "robohive._core")]
pub struct PyVecEnv {
    live: Turns<Live>,
    keys: Keys,
    names: Names,
    count: usize,
    autoreset: Autoreset,
}

struct Live {
    envs: VecEnv,
    /// Time in which the interpreter's lock was released for steps and resets.
    released: Duration,
}

/// How a call hands over what it yields: precision of observations, level of infos, images in them, and the array to write.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Form<'py> {
    narrow: bool,
    infos: String,
    exteroception: bool,
    out: Option<Bound<'py, PyAny>>,
}

type Flags<'py> = Bound<'py, PyArray1<bool>>;
/// Observations, rewards, terminated, truncated, infos.
type Stepped<'py> =
    (Bound<'py, PyAny>, Bound<'py, PyArray1<f64>>, Flags<'py>, Flags<'py>, Bound<'py, PyDict>);
type Observed<'py> = (Bound<'py, PyAny>, Bound<'py, PyDict>);

#[pymethods]
impl PyVecEnv {
    /// `count` copies of an environment, the one of index k seeded with `seed + k`, on a number of threads (0: as many as there
    /// are cores).
    #[new]
    fn new(
        py: Python<'_>,
        env: &PyEnv,
        count: usize,
        seed: u64,
        autoreset: &str,
        threads: usize,
    ) -> PyResult<Self> {
        let env = env.copy(py)?;
        let autoreset = match autoreset {
            "NextStep" => Autoreset::NextStep,
            "SameStep" => Autoreset::SameStep,
            "Disabled" => Autoreset::Disabled,
            _ => {
                let text = format!("autoreset_mode is NextStep, SameStep or Disabled, not {autoreset}");
                return Err(PyValueError::new_err(text));
            }
        };
        if count == 0 {
            return Err(PyValueError::new_err("num_envs is 1 or more"));
        }
        check_room(count, VecEnv::bytes_of(&env)).map_err(|no_room| {
            PyMemoryError::new_err(format!("{no_room}: give num_envs at most {}", no_room.fitting()))
        })?;
        let (keys, names) = (Keys::of(py, &env), Names::of(py, &env));
        let made = py.detach(move || VecEnv::new(&env, count, autoreset, threads));
        let mut envs = made.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        for index in 0..count {
            envs.env_mut(index).into_iter().for_each(|env| env.seed(seed.wrapping_add(index as u64)));
        }
        let live = Turns::of(Live { envs, released: Duration::ZERO });
        Ok(PyVecEnv { live, keys, names, count, autoreset })
    }

    /// Resets the environments with a flag in `mask` (all without one), each with its seed where it has one: observations of
    /// all, and infos.
    #[pyo3(signature = (seeds, mask, form))]
    fn reset<'py>(
        &self,
        py: Python<'py>,
        seeds: Vec<Option<u64>>,
        mask: Option<PyReadonlyArray1<'py, bool>>,
        form: Form<'py>,
    ) -> PyResult<Observed<'py>> {
        let mut live = self.live.take(py, "reset")?;
        let mask = mask.map_or_else(|| vec![true; self.count], |mask| mask.as_array().to_vec());
        if [mask.len(), seeds.len()] != [self.count; 2] {
            return Err(PyValueError::new_err(format!(
                "seeds and mask have one value for each of {}",
                self.count
            )));
        }
        let mut rows = form.rows(py, [self.count, live.envs.observation_len()])?;
        let numbers = rows.numbers()?;
        let outcome = live.released(py, |envs| match numbers {
            NumbersMut::Narrow(rows) => envs.reset_into(&seeds, &mask, rows),
            NumbersMut::Wide(rows) => envs.reset_into(&seeds, &mask, rows),
        });
        outcome.map_err(|error| exception(py, &error))?;
        let ids: Vec<_> = (0..self.count).collect();
        let told = (!mask.iter().all(|&reset| reset)).then_some(mask.as_slice());
        Ok((rows.into_array(), self.infos(py, &mut live.envs, &ids, told, &form)?))
    }

    /// One control period of every environment.
    fn step<'py>(
        &self,
        py: Python<'py>,
        actions: &Bound<'py, PyAny>,
        form: Form<'py>,
    ) -> PyResult<Stepped<'py>> {
        let mut live = self.live.take(py, "step")?;
        self.check_going_on(py, &live.envs)?;
        let actions = Actions::read(actions, self.count, live.envs.action_len())?;
        let mut rows = form.rows(py, [self.count, live.envs.observation_len()])?;
        let (given, taken) = (actions.numbers()?, rows.numbers()?);
        let outcome = live.released(py, |envs| match (given, taken) {
            (Numbers::Narrow(given), NumbersMut::Narrow(rows)) => envs.step_into(given, rows),
            (Numbers::Narrow(given), NumbersMut::Wide(rows)) => envs.step_into(given, rows),
            (Numbers::Wide(given), NumbersMut::Narrow(rows)) => envs.step_into(given, rows),
            (Numbers::Wide(given), NumbersMut::Wide(rows)) => envs.step_into(given, rows),
        });
        outcome.map_err(|error| exception(py, &error))?;
        let ids: Vec<_> = (0..self.count).collect();
        self.stepped(py, &mut live.envs, &ids, rows, &form)
    }

    /// Lets the environments `ids` step with their rows of actions, and returns at once.
    fn send(&self, py: Python<'_>, ids: Vec<usize>, actions: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut live = self.live.take(py, "send")?;
        let actions = Actions::read(actions, ids.len(), live.envs.action_len())?;
        let sent = match actions.numbers()? {
            Numbers::Narrow(given) => live.envs.send(&ids, given),
            Numbers::Wide(given) => live.envs.send(&ids, given),
        };
        sent.map_err(|error| exception(py, &error))
    }

    /// Lets the environments `ids` reset, each with its seed where it has one, and returns at once.
    fn send_resets(&self, py: Python<'_>, ids: Vec<usize>, seeds: Vec<Option<u64>>) -> PyResult<()> {
        let mut live = self.live.take(py, "async_reset")?;
        live.envs.send_resets(&ids, &seeds).map_err(|error| exception(py, &error))
    }

    /// Waits for the `count` environments that finish first: what they yield, and their indices as `env_id` in the infos.
    fn recv<'py>(&self, py: Python<'py>, count: usize, form: Form<'py>) -> PyResult<Stepped<'py>> {
        let mut live = self.live.take(py, "recv")?;
        let mut ids = vec![0; count];
        let mut rows = form.rows(py, [count, live.envs.observation_len()])?;
        let (taken, places) = (rows.numbers()?, ids.as_mut_slice());
        let outcome = live.released(py, |envs| match taken {
            NumbersMut::Narrow(rows) => envs.receive(places, rows),
            NumbersMut::Wide(rows) => envs.receive(places, rows),
        });
        outcome.map_err(|error| exception(py, &error))?;
        let stepped = self.stepped(py, &mut live.envs, &ids, rows, &form)?;
        stepped.4.set_item("env_id", vector(py, ids.iter().map(|&id| id as i64)))?;
        Ok(stepped)
    }

    /// How many environments were sent and not received.
    fn under_way(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.live.take(py, "under_way")?.envs.under_way())
    }

    /// Images of all environments, with their masks.
    fn visual_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let mut live = self.live.take(py, "get_exteroception")?;
        visual_dict(py, &mut live.envs, |error| exception(py, error))
    }

    /// A copy of one environment, which goes on by itself.
    fn copy(&self, py: Python<'_>, index: usize, model: &PyEnv) -> PyResult<PyEnv> {
        let live = self.live.take(py, "call")?;
        let env = self.at(&live.envs, index)?.fork().map_err(|error| exception(py, &error))?;
        Ok(model.like(py, env))
    }

    /// Another batch in the same state, which goes on by itself.
    fn fork(&self, py: Python<'_>, like: &PyEnv, threads: usize) -> PyResult<Self> {
        let live = self.live.take(py, "copy")?;
        let raise = |error: EnvError| exception(py, &error);
        live.envs.check_at_home().map_err(raise)?;
        let envs = live.envs.fork(threads).map_err(raise)?;
        let env = like.copy(py)?;
        let (keys, names) = (Keys::of(py, &env), Names::of(py, &env));
        let live = Turns::of(Live { envs, released: Duration::ZERO });
        Ok(PyVecEnv { live, keys, names, count: self.count, autoreset: self.autoreset })
    }

    /// Takes over the state of one environment.
    fn set_world(&self, py: Python<'_>, index: usize, state: &Bound<'_, PyDict>) -> PyResult<()> {
        let mut live = self.live.take(py, "set_env_state")?;
        let world = crate::world::read(self.at(&live.envs, index)?, &self.names.own, state)?;
        let env = live.envs.env_mut(index).ok_or_else(|| under_way(index))?;
        py.detach(|| env.set_world(&world).map(|_| ())).map_err(|error| exception(py, &error))
    }

    /// Restarts the draws of one environment.
    fn seed(&self, py: Python<'_>, index: usize, seed: u64) -> PyResult<()> {
        let mut live = self.live.take(py, "seed")?;
        self.at(&live.envs, index)?;
        live.envs.env_mut(index).ok_or_else(|| under_way(index))?.seed(seed);
        Ok(())
    }

    /// Seconds in which steps and resets had released the interpreter's lock.
    fn released_time(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.live.take(py, "released_time")?.released.as_secs_f64())
    }

    /// Frees the environments, once orders in progress are done; again, nothing.
    fn close(&self, py: Python<'_>) -> PyResult<bool> {
        let closed = self.live.close()?;
        Ok(py.detach(|| closed.map(drop).is_some()))
    }
}

impl PyVecEnv {
    fn infos<'py>(
        &self,
        py: Python<'py>,
        envs: &mut VecEnv,
        ids: &[usize],
        told: Option<&[bool]>,
        form: &Form<'py>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let level = Level::read(&form.infos)?;
        let dict = infos(py, envs, &self.keys, ids, told, level)?;
        let mask = || PyArray1::from_vec(py, told.map_or_else(|| vec![true; ids.len()], <[bool]>::to_vec));
        if level == Level::Full {
            dict.set_item("state", states(py, envs, &self.names, ids)?)?;
            dict.set_item("_state", mask())?;
        }
        if form.exteroception {
            dict.set_item("visual_dict", visual_dict(py, envs, |error| exception(py, error))?)?;
            dict.set_item("_visual_dict", mask())?;
        }
        Ok(dict)
    }

    fn stepped<'py>(
        &self,
        py: Python<'py>,
        envs: &mut VecEnv,
        ids: &[usize],
        rows: Rows<'py>,
        form: &Form<'py>,
    ) -> PyResult<Stepped<'py>> {
        let records: Vec<_> = ids.iter().map(|&id| envs.records()[id]).collect();
        let rewards = vector(py, records.iter().map(|step| step.reward));
        let terminated = vector(py, records.iter().map(|step| step.terminated));
        let truncated = vector(py, records.iter().map(|step| step.truncated));
        Ok((rows.into_array(), rewards, terminated, truncated, self.infos(py, envs, ids, None, form)?))
    }

    /// Fails where nothing resets environments, and the caller has not.
    fn check_going_on(&self, py: Python<'_>, envs: &VecEnv) -> PyResult<()> {
        if self.autoreset != Autoreset::Disabled || envs.under_way() > 0 {
            return Ok(());
        }
        match envs.records().iter().position(|step| step.ended) {
            None => Ok(()),
            Some(index) => {
                Err(exception(py, &EnvError::InBatch { index, error: EnvError::NeedsReset.into() }))
            }
        }
    }

    fn at<'a>(&self, envs: &'a VecEnv, index: usize) -> PyResult<&'a env::Env> {
        if index >= self.count {
            return Err(PyIndexError::new_err(format!(
                "there is no environment {index}: there are {}",
                self.count
            )));
        }
        envs.env(index).ok_or_else(|| under_way(index))
    }
}

fn under_way(index: usize) -> PyErr {
    PyRuntimeError::new_err(format!("environment {index} is still under way: receive it first"))
}

impl Live {
    /// Does something without the interpreter's lock.
    fn released<T: Send>(&mut self, py: Python<'_>, run: impl FnOnce(&mut VecEnv) -> T + Send) -> T {
        let Live { envs, released } = self;
        py.detach(|| {
            let began = Instant::now();
            let outcome = run(envs);
            *released += began.elapsed();
            outcome
        })
    }
}

impl<'py> Form<'py> {
    fn rows(&self, py: Python<'py>, shape: [usize; 2]) -> PyResult<Rows<'py>> {
        match &self.out {
            Some(out) => Rows::of(out, self.narrow, shape),
            None => Rows::new(py, self.narrow, shape),
        }
    }
}
