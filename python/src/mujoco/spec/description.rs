//! Texts read into elements for Python, and trees of Python compiled and written.

use super::super::load::Layered;
use super::super::model::CompiledModel;
use super::origin::Origin;
use super::show;
use super::take::Tree;
use super::value::{Outline, outline, shown, take};
use mjcf::Loader;
use mjcf::Parsed;
use mjcf::diagnostic::{Diagnostics, Sources};
use mjcf::edit::{self, Authored};
use mjcf::spec::{
    Actuator, Body, Camera, Compiler, Equality, Exclude, Flex, Frame, Geom, Hfield, Joint, Key,
    LengthRangeOptions, Light, Material, Mesh, Numeric, Pair, PluginInstance, Sensor, Site, Size, Skin, Spec,
    StatisticOverride, Tendon, Text, Texture, Tuple,
};
use physics::model::{Disable, Enable};
use physics::table::Slice;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// A tree of Python: elements by kind, the descriptions they were made in with their settings, sizes and statistics, options.
type Parts<'py> = (
    Bound<'py, PyDict>,
    Vec<(PyRef<'py, Description>, Bound<'py, PyDict>)>,
    Bound<'py, PyDict>,
    HashMap<String, HashMap<String, Vec<f64>>>,
);

/// Settings that a text gives.
type Given = (BTreeSet<(String, String)>, i32, i32, i32);

/// A default class: its name, and elements by kind.
type Class<'py> = (String, HashMap<&'static str, Bound<'py, PyDict>>);

/// Numbers of settings by group and name.
type Groups = HashMap<String, HashMap<&'static str, Vec<f64>>>;

/// What a tree of Python keeps of the text it was read from.
#[pyclass(frozen, module = "robohive._core.mujoco")]
pub struct Description {
    origin: Origin,
    /// Settings that the text gives.
    authored: Authored,
    sources: Sources,
    /// What was read, until Python has it.
    spec: Option<Spec>,
}

#[pymethods]
impl Description {
    /// Of no text.
    #[new]
    fn new() -> Self {
        Description {
            origin: Origin::default(),
            authored: Authored::default(),
            sources: Sources::default(),
            spec: None,
        }
    }

    /// Of the file `path`; with what was ignored or assumed.
    #[staticmethod]
    fn of_path(
        py: Python<'_>,
        path: &str,
        assets: HashMap<String, Vec<u8>>,
    ) -> PyResult<(Self, Vec<String>)> {
        Self::read(py.detach(|| Loader::default().files(Layered::new(assets)).parse(path)))
    }

    /// Of a text; with what was ignored or assumed.
    #[staticmethod]
    fn of_text(
        py: Python<'_>,
        text: &str,
        assets: HashMap<String, Vec<u8>>,
    ) -> PyResult<(Self, Vec<String>)> {
        Self::read(py.detach(|| Loader::default().files(Layered::new(assets)).parse_str(text)))
    }

    /// Folder of the text, with its closing slash.
    #[getter]
    fn folder(&self) -> &str {
        &self.origin.folder
    }

    /// All elements by kind, each with body, frame, text and offset in it.
    fn elements<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        show::elements(py, self.spec.as_ref().unwrap_or(&Spec::default()))
    }

    /// The settings of the compiler, of length ranges, sizes and statistics, by group.
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<HashMap<&'static str, Bound<'py, PyDict>>> {
        let fresh = Spec::default();
        let spec = self.spec.as_ref().unwrap_or(&fresh);
        let general = shown(py, &spec.size)?;
        general.set_item("modelname", &spec.modelname)?;
        Ok(HashMap::from([
            ("compiler", shown(py, &spec.compiler)?),
            ("lengthrange", shown(py, &spec.compiler.lengthrange)?),
            ("general", general),
            ("stat", shown(py, &spec.stat)?),
        ]))
    }

    /// Default classes: name and, by kind, the elements that new ones start from.
    fn classes<'py>(&self, py: Python<'py>) -> PyResult<Vec<Class<'py>>> {
        let fresh = Spec::default();
        let classes = &self.spec.as_ref().unwrap_or(&fresh).classes;
        let mut all = Vec::new();
        for name in classes.names() {
            let Some(class) = classes.get(name) else { continue };
            all.push((name.to_owned(), show::class(py, class)?));
        }
        Ok(all)
    }

    /// Settings of `option` and of the groups of `visual`, as numbers.
    fn options(&self) -> Groups {
        groups(self.spec.as_ref().unwrap_or(&Spec::default()))
    }

    /// Settings that the text gives: elements with attributes, disable flags, enable flags, actuator groups.
    fn given(&self) -> Given {
        let Authored { values, disableflags, enableflags, disableactuator } = self.authored.clone();
        (values, disableflags.bits(), enableflags.bits(), disableactuator)
    }

    /// The model of a tree that began as this description, and what was ignored or assumed. `pixels` are the textures whose
    /// files in `assets` hold pixels that the program gave.
    fn compile(
        &self,
        py: Python<'_>,
        tree: Parts<'_>,
        assets: HashMap<String, Vec<u8>>,
        pixels: Vec<usize>,
    ) -> PyResult<(CompiledModel, Vec<String>)> {
        let spec = spec_of(tree)?;
        let found = py.detach(|| spec.compile(&Layered::new(assets), &self.sources));
        let mut loaded = found.map_err(|found| refused(&found))?;
        // Pixels that a program gives have the colour space that it says, where the header of a file would say it.
        for texture in pixels {
            let Some(said) = spec.textures.get(texture).map(|texture| texture.colorspace.code()) else {
                continue;
            };
            let written = loaded.model.overwrite(|draft| {
                draft.tex_colorspace.iter_mut().skip(texture).take(1).for_each(|space| *space = said);
            });
            written.map_err(|error| PyValueError::new_err(error.to_string()))?;
        }
        let warnings = loaded.warnings.iter().map(ToString::to_string).collect();
        Ok((CompiledModel { model: Arc::new(loaded.model) }, warnings))
    }

    /// A tree that began as this description, as MJCF; `model` is compiled of the same tree.
    fn write(&self, py: Python<'_>, tree: Parts<'_>, model: &CompiledModel) -> PyResult<String> {
        let mut spec = spec_of(tree)?;
        let written = py.detach(|| {
            spec.settle_keys(&model.model);
            spec.to_xml()
        });
        written.map_err(|found| refused(&found))
    }

    /// The tree's options and sizes after one of another tree is attached to it, and the differences that were settled;
    /// `given` is what `given` shows of both.
    #[staticmethod]
    fn settle<'py>(
        py: Python<'py>,
        tree: Parts<'_>,
        child: Parts<'_>,
        given: [Given; 2],
    ) -> PyResult<(Groups, Bound<'py, PyDict>, Vec<String>)> {
        let (mut parent, child) = (spec_of(tree)?, spec_of(child)?);
        let authored = given.map(|(values, off, on, disableactuator)| Authored {
            values,
            disableflags: Disable::from_bits(off),
            enableflags: Enable::from_bits(on),
            disableactuator,
        });
        let settled = edit::settle(&mut parent, &child, authored.each_ref());
        let differences = settled.map_err(|found| refused(&found))?;
        Ok((groups(&parent), shown(py, &parent.size)?, differences))
    }

    /// The share of each element in the keyframes of a tree: of bodies, joints and actuators, in order.
    #[staticmethod]
    fn spread(tree: Parts<'_>) -> PyResult<[Vec<Vec<super::parts::Share>>; 3]> {
        let mut spec = spec_of(tree)?;
        edit::spread_keys(&mut spec).map_err(|found| refused(&found))?;
        let bodies: Vec<&Body> = spec.bodies().collect();
        let joints = bodies.iter().flat_map(|body| &body.joints);
        Ok([
            bodies.iter().map(|body| super::parts::shares(&body.keyed)).collect(),
            joints.map(|joint| super::parts::shares(&joint.keyed)).collect(),
            spec.actuators.iter().map(|actuator| super::parts::shares(&actuator.keyed)).collect(),
        ])
    }
}

impl Description {
    fn read(parsed: Result<Parsed, Diagnostics>) -> PyResult<(Self, Vec<String>)> {
        let Parsed { spec, authored, sources, warnings, .. } = parsed.map_err(|found| refused(&found))?;
        let origin = Origin::of(&spec, sources.folder());
        let warnings = warnings.iter().map(ToString::to_string).collect();
        Ok((Description { origin, authored, sources, spec: Some(spec) }, warnings))
    }
}

fn groups(spec: &Spec) -> Groups {
    let mut all = Groups::new();
    let mut put = |group: String, name: &'static str, values: Slice<'_>| {
        all.entry(group).or_default().insert(name, values.to_f64());
    };
    spec.option.visit(&mut |name, values| put("opt".into(), name, values));
    spec.visual.visit(&mut |group, name, values| put(format!("vis.{group}"), name, values));
    all
}

fn spec_of((elements, origins, general, options): Parts<'_>) -> PyResult<Spec> {
    let origins = origins.iter().map(|(description, settings)| (&description.origin, settings)).collect();
    Tree { elements: &elements, origins, general: &general, options }.spec()
}

fn refused(found: &Diagnostics) -> PyErr {
    PyValueError::new_err(found.to_string())
}

/// Attributes of every kind of element and group of settings: name, form, enumeration, length, default.
#[pyfunction]
pub fn spec_forms(py: Python<'_>) -> PyResult<HashMap<&'static str, Vec<Outline<'_>>>> {
    let mut all = HashMap::new();
    macro_rules! kinds {
        ($($kind:literal $element:expr;)*) => { $(all.insert($kind, outline(py, &$element)?);)* };
    }
    kinds! {
        "body" Body::default();
        "frame" Frame::default();
        "joint" Joint::default();
        "geom" Geom::default();
        "site" Site::default();
        "camera" Camera::default();
        "light" Light::default();
        "mesh" Mesh::default();
        "hfield" Hfield::default();
        "texture" Texture::default();
        "material" Material::default();
        "pair" show::completed(&Pair::default());
        "exclude" Exclude::default();
        "flex" Flex::default();
        "skin" Skin::default();
        "plugin" PluginInstance::default();
        "equality" Equality::default();
        "tendon" Tendon::default();
        "actuator" Actuator::default();
        "sensor" Sensor::default();
        "numeric" Numeric::default();
        "text" Text::default();
        "tuple" Tuple::default();
        "key" Key::default();
        "compiler" Compiler::default();
        "lengthrange" LengthRangeOptions::default();
        "size" Size::default();
        "stat" StatisticOverride::default();
    }
    Ok(all)
}

/// The attributes of an actuator after a shortcut of MJCF with these attributes is applied to it.
#[pyfunction]
pub fn actuator_shortcut<'py>(
    py: Python<'py>,
    values: &Bound<'py, PyDict>,
    tag: &str,
    attributes: Vec<(String, String)>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut actuator = Actuator::default();
    take(values, &mut actuator)?;
    let attributes: Vec<(&str, &str)> = attributes.iter().map(|(name, value)| (&**name, &**value)).collect();
    edit::set_shortcut(&mut actuator, tag, &attributes).map_err(|found| refused(&found))?;
    shown(py, &actuator)
}

/// The quaternion of an orientation: unit of angles, order of Euler angles, code and numbers.
#[pyfunction]
pub fn orientation(degree: bool, sequence: [u8; 3], alt: &Bound<'_, PyDict>) -> PyResult<[f64; 4]> {
    let settings = Compiler { degree, eulerseq: sequence, ..Compiler::default() };
    let alt = super::parts::take_orientation(alt, "alt")?;
    settings.quaternion([1.0, 0.0, 0.0, 0.0], alt).map_err(|error| PyValueError::new_err(error.to_string()))
}
