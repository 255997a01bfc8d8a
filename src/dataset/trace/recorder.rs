//! Recording episodes as they run.

use super::column::Column;
use super::error::TraceError;
use super::layout::Layout;
use super::precision::Precision;
use super::routes::{Router, Rows, Translation, check_key};
use crate::hdf5::append::Appender;
use crate::hdf5::encode::{self, Element, WRITER};
use crate::hdf5::file::Hdf5Reader;
use crate::hdf5::filter::Packer;
use crate::npy::{Array, Dtype, Scalar, Values};
use crate::npz::NpzWriter;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// A recording that is being written: `.h5`, or a numpy archive, `.npz`, with `/` in its names.
///
/// An `.h5` file can be opened at every moment and holds the trials that were finished, whatever ends the process. A
/// numpy archive is complete after [`Recorder::close`] only.
pub struct Recorder {
    path: PathBuf,
    out: Out,
    translation: Translation,
    precision: Precision,
    names: HashSet<String>,
    unmapped: BTreeSet<String>,
}

enum Out {
    Hdf5(Box<(Appender, Packer)>),
    Npz(Box<NpzWriter<BufWriter<File>>>),
}

/// An episode that is being recorded. What is dropped without [`Trial::finish`] is not kept.
pub struct Trial<'a> {
    recorder: &'a mut Recorder,
    name: String,
    /// End of the file before the trial.
    start: u64,
    router: Router,
    /// Whole datasets, which have no rows.
    values: Vec<(String, Value)>,
    attributes: Vec<(String, i64)>,
    scratch: Vec<u8>,
}

enum Value {
    Array(Array),
    /// Rows, not one for each step of the trial.
    Series(Array),
    Text {
        shape: Vec<usize>,
        texts: Vec<String>,
    },
    /// A group without members.
    Group,
}

/// True for the name of a numpy archive.
pub fn is_npz(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("npz"))
}

impl Recorder {
    /// Makes a recording, replacing what was at `path`. Rows are given under RoboHive's names; in RoboSet's layout they are
    /// kept under its own, and those without a place there are in [`Recorder::unmapped`].
    ///
    /// # Errors
    /// The file cannot be written, or another process is writing it.
    pub fn create(path: &Path, layout: Layout, precision: Precision) -> Result<Self, TraceError> {
        Self::create_with(path, layout, precision, &[])
    }

    /// [`Recorder::create`], with attributes of the file: names and texts, such as the environment's.
    ///
    /// # Errors
    /// As [`Recorder::create`].
    pub fn create_with(
        path: &Path,
        layout: Layout,
        precision: Precision,
        attributes: &[(&str, &str)],
    ) -> Result<Self, TraceError> {
        let translation = match layout {
            Layout::RoboHive => Translation::None,
            Layout::RoboSet => Translation::ToRoboSet,
        };
        Self::translating(path, translation, precision, attributes)
    }

    /// A recording whose rows are given under names of another layout.
    pub(super) fn translating(
        path: &Path,
        translation: Translation,
        precision: Precision,
        attributes: &[(&str, &str)],
    ) -> Result<Self, TraceError> {
        let fail = |e| TraceError::new(path, "", e);
        let out = if is_npz(path) {
            Out::Npz(Box::new(NpzWriter::create(path).map_err(fail)?))
        } else {
            let writer = (WRITER, concat!("robohive ", env!("CARGO_PKG_VERSION")));
            let attributes = attributes.iter().filter(|(name, _)| *name != WRITER);
            let owned: Vec<(String, String)> = [&writer]
                .into_iter()
                .chain(attributes)
                .map(|&(name, text)| (name.to_owned(), text.to_owned()))
                .collect();
            Out::Hdf5(Box::new((Appender::create(path, &owned).map_err(fail)?, Packer::default())))
        };
        let (names, unmapped) = (HashSet::new(), BTreeSet::new());
        Ok(Recorder { path: path.to_owned(), out, translation, precision, names, unmapped })
    }

    /// Goes on with an `.h5` recording that a recorder made: its trials stay.
    ///
    /// # Errors
    /// The file cannot be read or written, another process is writing it, or another program wrote it.
    pub fn append(path: &Path, layout: Layout, precision: Precision) -> Result<Self, TraceError> {
        let names = Hdf5Reader::open(path)?.members("")?.into_iter().map(|(name, _)| name).collect();
        let file = Appender::open(path).map_err(|e| TraceError::new(path, "", e))?;
        let translation = match layout {
            Layout::RoboHive => Translation::None,
            Layout::RoboSet => Translation::ToRoboSet,
        };
        let out = Out::Hdf5(Box::new((file, Packer::default())));
        Ok(Recorder { path: path.to_owned(), out, translation, precision, names, unmapped: BTreeSet::new() })
    }

    /// Begins a trial; RoboHive calls them `Trial0`, `Trial1` …
    ///
    /// # Errors
    /// The name is taken, or cannot be one.
    pub fn begin(&mut self, name: &str) -> Result<Trial<'_>, TraceError> {
        let fail = |message| TraceError::new(&self.path, name, message);
        check_key(name, std::iter::empty()).map_err(fail)?;
        if name.contains('/') {
            return Err(fail("the name of a trial has no /".into()));
        }
        if self.names.contains(name) {
            return Err(fail("the file has this trial already".into()));
        }
        let start = if let Out::Hdf5(out) = &self.out { out.0.end() } else { 0 };
        let router = Router::new(self.translation);
        Ok(Trial {
            recorder: self,
            name: name.to_owned(),
            start,
            router,
            values: Vec::new(),
            attributes: Vec::new(),
            scratch: Vec::new(),
        })
    }

    /// Names of rows that had no place in the layout and were not kept.
    pub fn unmapped(&self) -> impl Iterator<Item = &str> {
        self.unmapped.iter().map(String::as_str)
    }

    /// Completes the file, and waits until the disk has it.
    ///
    /// # Errors
    /// Writing fails.
    pub fn close(self) -> Result<(), TraceError> {
        let closed = match self.out {
            Out::Hdf5(out) => out.0.sync(),
            Out::Npz(writer) => writer.finish(),
        };
        closed.map_err(|e| TraceError::new(&self.path, "", e))
    }
}

impl Trial<'_> {
    fn fail(&self, key: &str, message: impl ToString) -> TraceError {
        TraceError::new(&self.recorder.path, format!("{}/{key}", self.name), message.to_string())
    }

    /// Adds a row under a name such as `env_infos/obs_dict/qp`: its shape, empty for a scalar, and its scalars, row-major.
    /// All rows of a name have the same shape and type; at the end all names must have equally many rows.
    ///
    /// # Errors
    /// Shape or type differ from earlier rows, a number does not fit the precision, or writing fails.
    pub fn push<T: Scalar>(&mut self, key: &str, shape: &[usize], row: &[T]) -> Result<(), TraceError> {
        if shape.iter().product::<usize>() != row.len() {
            return Err(self.fail(key, format!("{} scalars do not fill a row of shape {shape:?}", row.len())));
        }
        let precision = self.recorder.precision;
        self.scratch.clear();
        precision.put(row, &mut self.scratch).map_err(|message| self.fail(key, message))?;
        self.route(key, precision.kept(T::DTYPE), shape, 1)
    }

    /// Adds all rows of an array, whose first axis counts them.
    ///
    /// # Errors
    /// As [`Trial::push`]; the array is a scalar.
    pub fn push_rows(&mut self, key: &str, array: &Array) -> Result<(), TraceError> {
        let Some((&rows, shape)) = array.shape.split_first() else {
            return Err(self.fail(key, "a scalar has no rows"));
        };
        let precision = self.recorder.precision;
        self.scratch.clear();
        let put = precision.put_values(&array.values, &mut self.scratch);
        put.map_err(|message| self.fail(key, message))?;
        self.route(key, precision.kept(array.values.dtype()), shape, rows)
    }

    /// Sends the rows in `scratch` to their columns, and complete chunks to the file.
    fn route(&mut self, key: &str, dtype: Dtype, row: &[usize], count: usize) -> Result<(), TraceError> {
        let rows = Rows { dtype, row, count, bytes: &self.scratch };
        let pushed = self.router.push(key, rows);
        pushed.map_err(|message| self.fail(key, message))?;
        let Out::Hdf5(out) = &mut self.recorder.out else { return Ok(()) };
        let (file, packer) = &mut **out;
        let flushed = self.router.columns.iter_mut().try_for_each(|column| column.flush(file, packer));
        flushed.map_err(|e| self.fail(key, e))
    }

    /// Sets a dataset that has no rows, such as `user_cmt`. Integers, which may be seeds, keep all their bits at every
    /// precision.
    ///
    /// # Errors
    /// The name is taken, or a number does not fit the precision.
    pub fn set(&mut self, key: &str, array: &Array) -> Result<(), TraceError> {
        let reducible = matches!(array.values.dtype(), Dtype::F16 | Dtype::F32 | Dtype::F64);
        let precision = if reducible { self.recorder.precision } else { Precision::Full };
        let mut bytes = Vec::new();
        precision.put_values(&array.values, &mut bytes).map_err(|message| self.fail(key, message))?;
        let values = Values::from_bytes(precision.kept(array.values.dtype()), &bytes);
        self.keep(key, Value::Array(Array { shape: array.shape.clone(), values }))
    }

    /// Sets a dataset of rows. It may have more or fewer rows than the other names; all its bits are kept.
    ///
    /// # Errors
    /// The name is taken, or the array is a scalar.
    pub fn set_series(&mut self, key: &str, array: Array) -> Result<(), TraceError> {
        if array.shape.is_empty() {
            return Err(self.fail(key, "a scalar has no rows"));
        }
        self.keep(key, Value::Series(array))
    }

    /// Sets a group without members.
    ///
    /// # Errors
    /// The name is taken.
    pub fn set_group(&mut self, key: &str) -> Result<(), TraceError> {
        self.keep(key, Value::Group)
    }

    /// Sets an attribute of the trial's group.
    ///
    /// # Errors
    /// The trial has this attribute, or the file is a numpy archive.
    pub fn set_attribute(&mut self, name: &str, value: i64) -> Result<(), TraceError> {
        if matches!(self.recorder.out, Out::Npz(_)) {
            return Err(self.fail("", "numpy archives hold no attributes"));
        }
        if self.attributes.iter().any(|(other, _)| other == name) {
            return Err(self.fail("", format!("the trial has attribute {name:?} already")));
        }
        self.attributes.push((name.to_owned(), value));
        Ok(())
    }

    /// Sets a dataset of texts, such as `config/task`; an empty shape is one text.
    ///
    /// # Errors
    /// The name is taken, the texts do not fill the shape, or the file is a numpy archive.
    pub fn set_text(&mut self, key: &str, shape: &[usize], texts: &[String]) -> Result<(), TraceError> {
        if matches!(self.recorder.out, Out::Npz(_)) {
            return Err(self.fail(key, "numpy archives hold no texts"));
        }
        if shape.iter().product::<usize>() != texts.len() {
            return Err(self.fail(key, format!("{} texts do not fill shape {shape:?}", texts.len())));
        }
        self.keep(key, Value::Text { shape: shape.to_vec(), texts: texts.to_vec() })
    }

    fn keep(&mut self, key: &str, value: Value) -> Result<(), TraceError> {
        let routes = self.router.translation().routes(key, &[]);
        let whole: Vec<String> = routes
            .into_iter()
            .filter_map(|route| if let super::layout::Route::Whole(to) = route { Some(to) } else { None })
            .collect();
        let [to] = &whole[..] else {
            self.router.unmapped.insert(key.to_owned());
            return Ok(());
        };
        let taken = self.values.iter().map(|(key, _)| &key[..]);
        let columns = self.router.columns.iter().map(|column| &column.key[..]);
        check_key(to, taken.chain(columns)).map_err(|message| self.fail(key, message))?;
        self.values.push((to.clone(), value));
        Ok(())
    }

    /// Completes the trial. When this returns, an `.h5` file holds it, whatever ends the process.
    ///
    /// # Errors
    /// Names have different numbers of rows, or writing fails; the file is as before.
    pub fn finish(mut self) -> Result<(), TraceError> {
        self.router.check().map_err(|(key, message)| self.fail(&key, message))?;
        let keys: Vec<String> = self.router.columns.iter().map(|column| column.key.clone()).collect();
        for (key, _) in &self.values {
            check_key(key, keys.iter().map(String::as_str)).map_err(|message| self.fail(key, message))?;
        }
        let columns = std::mem::take(&mut self.router.columns);
        let values = std::mem::take(&mut self.values);
        let attributes = std::mem::take(&mut self.attributes);
        let written = match &mut self.recorder.out {
            Out::Hdf5(out) => {
                let (file, packer) = &mut **out;
                write_objects(file, packer, columns, values).and_then(|objects| {
                    let members: Vec<(&str, u64)> = objects.iter().map(|(key, at)| (&key[..], *at)).collect();
                    let group = write_group(file, &members, &attributes)?;
                    file.publish(&self.name, group)
                })
            }
            Out::Npz(writer) => write_npz(writer, &self.name, columns, values),
        };
        written.map_err(|e| TraceError::new(&self.recorder.path, &self.name[..], e))?;
        if let Out::Hdf5(out) = &self.recorder.out {
            self.start = out.0.end();
        }
        self.recorder.unmapped.append(&mut self.router.unmapped);
        self.recorder.names.insert(self.name.clone());
        Ok(())
    }
}

impl Drop for Trial<'_> {
    fn drop(&mut self) {
        if let Out::Hdf5(out) = &mut self.recorder.out {
            out.0.forget(self.start);
        }
    }
}

fn write_npz(
    writer: &mut NpzWriter<BufWriter<File>>,
    trial: &str,
    columns: Vec<Column>,
    values: Vec<(String, Value)>,
) -> std::io::Result<()> {
    for column in columns {
        let name = format!("{trial}/{}", column.key);
        let shape = [&[column.rows], &column.row[..]].concat();
        let values = Values::from_bytes(column.dtype, &column.into_bytes());
        writer.add(&name, &Array { shape, values })?;
    }
    for (key, value) in values {
        if let Value::Array(array) | Value::Series(array) = value {
            writer.add(&format!("{trial}/{key}"), &array)?;
        }
    }
    Ok(())
}

/// Writes the datasets of a trial: their keys, and where their headers are.
fn write_objects(
    file: &mut Appender,
    packer: &mut Packer,
    columns: Vec<Column>,
    values: Vec<(String, Value)>,
) -> std::io::Result<Vec<(String, u64)>> {
    let mut objects = Vec::new();
    for column in columns {
        objects.push((column.key.clone(), column.finish(file, packer)?));
    }
    for (key, value) in values {
        let address = match value {
            Value::Group => write_group(file, &[], &[])?,
            Value::Series(Array { shape, values }) => {
                let mut column = Column::new(key.clone(), values.dtype(), shape[1..].to_vec());
                let mut bytes = Vec::new();
                values.put_bytes(&mut bytes);
                column.hold(shape[0], &bytes);
                column.flush(file, packer)?;
                column.finish(file, packer)?
            }
            Value::Array(Array { shape, values }) => {
                let mut bytes = Vec::new();
                values.put_bytes(&mut bytes);
                write_whole(file, Element::Number(values.dtype()), &shape, &bytes)?
            }
            Value::Text { shape, texts } => {
                let width = texts.iter().map(String::len).max().unwrap_or(0).max(1);
                let mut bytes = Vec::new();
                for text in &texts {
                    bytes.extend(text.bytes());
                    bytes.resize(bytes.len() + width - text.len(), 0);
                }
                write_whole(file, Element::Text(width as u32), &shape, &bytes)?
            }
        };
        objects.push((key, address));
    }
    Ok(objects)
}

/// Writes a dataset whose scalars stand together.
fn write_whole(file: &mut Appender, element: Element, shape: &[usize], bytes: &[u8]) -> std::io::Result<u64> {
    let address = file.write(bytes)?;
    file.write(&encode::whole_dataset(element, shape, address))
}

/// Writes a group of objects, whose paths may lead through groups inside of it.
fn write_group(
    file: &mut Appender,
    objects: &[(&str, u64)],
    attributes: &[(String, i64)],
) -> std::io::Result<u64> {
    let mut links = encode::group_info();
    for (name, value) in attributes {
        links.extend(encode::integer_attribute(name, *value));
    }
    let mut inner: BTreeMap<&str, Vec<(&str, u64)>> = BTreeMap::new();
    for &(path, address) in objects {
        match path.split_once('/') {
            Some((group, rest)) => inner.entry(group).or_default().push((rest, address)),
            None => links.extend(encode::link(path, address)),
        }
    }
    for (name, objects) in inner {
        let address = write_group(file, &objects, &[])?;
        links.extend(encode::link(name, address));
    }
    file.write(&encode::object_header(&links))
}
