//! Infos of a batch in Gymnasium's vector format: under every key an array of all environments, and under `_key` a mask of those
//! that have it.

use env::{Env, Final, Rows, StepRecord, VecEnv, Verdict};
use numpy::ndarray::{ArrayViewD, IxDyn};
use numpy::{Element, PyArray1, PyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

/// How much infos tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// What ends episodes: `final_obs` and `fault`.
    None,
    /// With `time`, `rwd_dense`, `rwd_sparse`, `solved` and `done`; infos of ended episodes in `final_info`.
    Sparse,
    /// With `obs_dict`, `rwd_dict`, `proprio_dict`, `visual_dict` and `state`.
    Full,
}

impl Level {
    /// By name.
    ///
    /// # Errors
    /// There is no such level.
    pub fn read(name: &str) -> PyResult<Self> {
        match name {
            "none" => Ok(Level::None),
            "sparse" => Ok(Level::Sparse),
            "full" => Ok(Level::Full),
            _ => Err(PyValueError::new_err(format!("infos is none, sparse or full, not {name}"))),
        }
    }
}

/// A key, and the key of its mask.
type Key = [Py<PyString>; 2];

/// Keys as strings of Python that are made once.
pub struct Keys {
    rows: Vec<Key>,
    terms: Vec<Key>,
    /// Rows that belong to the proprioception.
    proprio: Option<Vec<usize>>,
    time: Key,
    dense: Key,
    sparse: Key,
    solved: Key,
    done: Key,
    reward: [Key; 4],
}

fn key(py: Python<'_>, name: &str) -> Key {
    [PyString::intern(py, name).unbind(), PyString::intern(py, &format!("_{name}")).unbind()]
}

impl Keys {
    /// Those of environments like `env`.
    pub fn of(py: Python<'_>, env: &Env) -> Self {
        let keys = |rows: &Rows| rows.rows().iter().map(|row| key(py, row.name())).collect();
        let proprio = env.proprio_keys().map(|wanted| {
            let own = |name: &str| name == "time" || wanted.iter().any(|key| key == name);
            (0..env.rows().rows().len()).filter(|&k| own(env.rows().rows()[k].name())).collect()
        });
        Keys {
            rows: keys(env.rows()),
            terms: keys(env.terms()),
            proprio,
            time: key(py, "time"),
            dense: key(py, "rwd_dense"),
            sparse: key(py, "rwd_sparse"),
            solved: key(py, "solved"),
            done: key(py, "done"),
            reward: ["sparse", "solved", "done", "dense"].map(|name| key(py, name)),
        }
    }
}

/// What infos show of one environment.
#[derive(Clone, Copy)]
struct View<'a> {
    time: f64,
    dense: f64,
    verdict: Verdict,
    /// Rows and terms, where infos show these.
    rows: Option<[&'a Rows; 2]>,
}

impl<'a> View<'a> {
    /// The present state: all but the rows from what lies side by side.
    fn present(envs: &'a VecEnv, id: usize, level: Level) -> Self {
        let &StepRecord { time, dense, verdict, .. } = &envs.records()[id];
        let env = if level == Level::Full { envs.env(id) } else { None };
        View { time, dense, verdict, rows: env.map(|env| [env.rows(), env.terms()]) }
    }

    fn ended(last: &'a Final) -> Self {
        let time = last.rows.values()[0];
        View { time, dense: last.dense, verdict: last.verdict, rows: Some([&last.rows, &last.terms]) }
    }
}

/// Rows of the observation dictionary, or terms of the reward.
#[derive(Clone, Copy)]
enum Of {
    Rows,
    Terms,
}

/// A dictionary of batched arrays that is being written.
struct Batch<'a, 'py> {
    py: Python<'py>,
    keys: &'a Keys,
    /// `None` for environments that have no such infos.
    views: Vec<Option<View<'a>>>,
    mask: Bound<'py, PyArray1<bool>>,
}

impl<'a, 'py> Batch<'a, 'py> {
    fn new(py: Python<'py>, keys: &'a Keys, views: Vec<Option<View<'a>>>) -> Self {
        let mask = vector(py, views.iter().map(Option::is_some));
        Batch { py, keys, views, mask }
    }

    fn put(&self, dict: &Bound<'py, PyDict>, key: &Key, value: Bound<'py, PyAny>) -> PyResult<()> {
        dict.set_item(&key[0], value)?;
        dict.set_item(&key[1], &self.mask)
    }

    fn each<T: Element + Default>(&self, value: impl Fn(&View<'a>) -> T) -> Bound<'py, PyAny> {
        let values = self.views.iter().map(|view| view.as_ref().map(&value).unwrap_or_default());
        vector(self.py, values).into_any()
    }

    /// `time`, `rwd_dense`, `rwd_sparse`, `solved`, `done`.
    fn sparse(&self, dict: &Bound<'py, PyDict>) -> PyResult<()> {
        let keys = self.keys;
        self.put(dict, &keys.time, self.each(|view| view.time))?;
        self.put(dict, &keys.dense, self.each(|view| view.dense))?;
        self.put(dict, &keys.sparse, self.each(|view| view.verdict.sparse))?;
        self.put(dict, &keys.solved, self.each(|view| view.verdict.solved))?;
        self.put(dict, &keys.done, self.each(|view| view.verdict.done))
    }

    /// One row of all environments: (environments,) for rows of one value unless `keep_axis`, else (environments x length).
    fn row(&self, index: usize, of: Of, keep_axis: bool) -> PyResult<Bound<'py, PyAny>> {
        let rows = |view: &Option<View<'a>>| view.and_then(|view| view.rows).map(|rows| rows[of as usize]);
        let width = self.views.iter().find_map(rows).map_or(0, |rows| rows.rows()[index].len());
        let mut values = vec![0.0; self.views.len() * width];
        for (place, view) in values.chunks_exact_mut(width.max(1)).zip(&self.views) {
            let row = rows(view).and_then(|rows| rows.iter().nth(index));
            row.into_iter().for_each(|(_, row)| place.copy_from_slice(row));
        }
        let shape = [self.views.len(), width];
        let axes = if width == 1 && !keep_axis { 1 } else { 2 };
        Ok(array(self.py, &shape[..axes], &values)?.into_any())
    }

    fn obs_dict(&self) -> PyResult<Bound<'py, PyAny>> {
        let dict = PyDict::new(self.py);
        for (index, key) in self.keys.rows.iter().enumerate() {
            self.put(&dict, key, self.row(index, Of::Rows, false)?)?;
        }
        Ok(dict.into_any())
    }

    fn rwd_dict(&self) -> PyResult<Bound<'py, PyAny>> {
        let dict = PyDict::new(self.py);
        for (index, key) in self.keys.terms.iter().enumerate() {
            self.put(&dict, key, self.row(index, Of::Terms, false)?)?;
        }
        let [sparse, solved, done, dense] = &self.keys.reward;
        self.put(&dict, sparse, self.each(|view| view.verdict.sparse))?;
        self.put(&dict, solved, self.each(|view| view.verdict.solved))?;
        self.put(&dict, done, self.each(|view| view.verdict.done))?;
        self.put(&dict, dense, self.each(|view| view.dense))?;
        Ok(dict.into_any())
    }

    fn proprio_dict(&self) -> PyResult<Bound<'py, PyAny>> {
        let Some(rows) = &self.keys.proprio else {
            return objects(self.py, self.views.iter().map(|_| None::<()>));
        };
        let dict = PyDict::new(self.py);
        for &index in rows {
            self.put(&dict, &self.keys.rows[index], self.row(index, Of::Rows, true)?)?;
        }
        Ok(dict.into_any())
    }

    fn write(&self, dict: &Bound<'py, PyDict>, level: Level) -> PyResult<()> {
        if level != Level::None {
            self.sparse(dict)?;
        }
        if level == Level::Full {
            let py = self.py;
            self.put(dict, &key(py, "obs_dict"), self.obs_dict()?)?;
            self.put(dict, &key(py, "rwd_dict"), self.rwd_dict()?)?;
            self.put(dict, &key(py, "proprio_dict"), self.proprio_dict()?)?;
        }
        Ok(())
    }
}

/// Infos of the environments `ids`; an environment whose flag in `told` is not set has no infos.
pub fn infos<'py>(
    py: Python<'py>,
    envs: &VecEnv,
    keys: &Keys,
    ids: &[usize],
    told: Option<&[bool]>,
    level: Level,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    if level != Level::None {
        let view = |(place, &id): (usize, &usize)| {
            let wanted = told.is_none_or(|told| told[place]);
            wanted.then(|| View::present(envs, id, level))
        };
        let views = ids.iter().enumerate().map(view).collect();
        Batch::new(py, keys, views).write(&dict, level)?;
    }
    ends(&dict, envs, keys, ids, level)?;
    Ok(dict)
}

/// What the last step ended with: `final_obs` and `final_info` where it has reset, and `fault` where physics refused it.
fn ends(dict: &Bound<'_, PyDict>, envs: &VecEnv, keys: &Keys, ids: &[usize], level: Level) -> PyResult<()> {
    let py = dict.py();
    if ids.iter().any(|&id| envs.records()[id].replaced) {
        let lasts: Vec<_> = ids.iter().map(|&id| envs.last(id)).collect();
        let observations =
            lasts.iter().map(|last| last.map(|last| PyArray1::from_slice(py, &last.observation)));
        let ended = Batch::new(py, keys, lasts.iter().map(|last| last.map(View::ended)).collect());
        ended.put(dict, &key(py, "final_obs"), objects(py, observations)?)?;
        if level != Level::None {
            let inner = PyDict::new(py);
            ended.write(&inner, level)?;
            ended.put(dict, &key(py, "final_info"), inner.into_any())?;
        }
    }
    let fault = |&id: &usize| envs.last_step(id).fault.as_ref().map(ToString::to_string);
    if ids.iter().any(|&id| envs.records()[id].faulty) {
        let faults: Vec<_> = ids.iter().map(fault).collect();
        let mask = vector(py, faults.iter().map(Option::is_some));
        dict.set_item("_fault", mask)?;
        dict.set_item("fault", objects(py, faults.into_iter())?)?;
    }
    Ok(())
}

/// A new array of these values.
pub fn vector<'py, T: Element>(py: Python<'py>, values: impl Iterator<Item = T>) -> Bound<'py, PyArray1<T>> {
    // From a slice: the array of an iterator is first made too long, and then cut.
    PyArray1::from_slice(py, &values.collect::<Vec<_>>())
}

/// An array of Python's objects, `None` if there is none.
pub fn objects<'py, T: IntoPyObject<'py>>(
    py: Python<'py>,
    items: impl ExactSizeIterator<Item = Option<T>>,
) -> PyResult<Bound<'py, PyAny>> {
    let array = py.import("numpy")?.call_method1("empty", (items.len(), "object"))?;
    for (index, item) in items.enumerate() {
        array.set_item(index, item)?;
    }
    Ok(array)
}

/// A new array of this shape with these values.
///
/// # Errors
/// The shape holds another number of values.
pub fn array<'py, T: Element>(
    py: Python<'py>,
    shape: &[usize],
    values: &[T],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let view = ArrayViewD::from_shape(IxDyn(shape), values)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(PyArrayDyn::from_array(py, &view))
}
