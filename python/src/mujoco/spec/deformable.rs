//! Bones of skins, plugins of elements and the plugins that a description declares, on their way to Python and back.

use super::parts::required;
use mjcf::diagnostic::Loc;
use mjcf::spec::{Bone, Extension, PluginInstance, PluginUse, Skin};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The plugin of an element: name of the plugin, name of the instance, attributes.
type Use = (String, String, Vec<(String, String)>);

/// Adds the bones of a skin to its attributes: names of bodies, poses, vertices and weights.
pub fn show_bones<'py>(py: Python<'py>, skin: &Skin, all: &Bound<'py, PyDict>) -> PyResult<()> {
    let bones = &skin.bones;
    let flat = |of: fn(&Bone) -> &[f32]| -> Vec<f32> { bones.iter().flat_map(of).copied().collect() };
    all.set_item("file", &skin.path)?;
    all.set_item("bodyname", bones.iter().map(|bone| bone.body.as_str()).collect::<Vec<_>>())?;
    all.set_item("bindpos", PyArray1::from_vec(py, flat(|bone| &bone.bindpos)))?;
    all.set_item("bindquat", PyArray1::from_vec(py, flat(|bone| &bone.bindquat)))?;
    all.set_item("vertid", bones.iter().map(|bone| bone.vertid.clone()).collect::<Vec<_>>())?;
    all.set_item("vertweight", bones.iter().map(|bone| bone.vertweight.clone()).collect::<Vec<_>>())
}

/// The bones of a skin of Python.
///
/// # Errors
/// A `ValueError` where the lists are not of as many bones.
pub fn take_bones(values: &Bound<'_, PyDict>, loc: Loc) -> PyResult<Vec<Bone>> {
    let bodies: Vec<String> = required(values, "bodyname")?.extract()?;
    let (pos, quat): (Vec<f32>, Vec<f32>) =
        (required(values, "bindpos")?.extract()?, required(values, "bindquat")?.extract()?);
    let vertid: Vec<Vec<i32>> = required(values, "vertid")?.extract()?;
    let vertweight: Vec<Vec<f32>> = required(values, "vertweight")?.extract()?;
    let (pos, quat) = (pos.as_chunks::<3>(), quat.as_chunks::<4>());
    let whole = pos.1.is_empty() && quat.1.is_empty();
    let counts = [pos.0.len(), quat.0.len(), vertid.len(), vertweight.len()];
    if !whole || counts.iter().any(|&count| count != bodies.len()) {
        return Err(PyValueError::new_err(format!(
            "a skin has {} names of bodies, {} positions, {} orientations, {} lists of vertices and {} of weights; it needs as many",
            bodies.len(),
            counts[0],
            counts[1],
            counts[2],
            counts[3],
        )));
    }
    let poses = pos.0.iter().zip(quat.0);
    let moved = vertid.into_iter().zip(vertweight);
    let bones = bodies.into_iter().zip(poses).zip(moved);
    Ok(bones
        .map(|((body, (bindpos, bindquat)), (vertid, vertweight))| Bone {
            loc,
            body,
            bindpos: *bindpos,
            bindquat: *bindquat,
            vertid,
            vertweight,
        })
        .collect())
}

/// Adds the plugin of an element to its attributes.
pub fn show_use(used: Option<&PluginUse>, all: &Bound<'_, PyDict>) -> PyResult<()> {
    let shown = used.map(|used| (&used.plugin, &used.instance, used.config.clone()));
    all.set_item("_plugin", shown)
}

/// The plugin of an element of Python.
pub fn take_use(values: &Bound<'_, PyDict>, loc: Loc) -> PyResult<Option<PluginUse>> {
    let Some(item) = values.get_item("_plugin")? else { return Ok(None) };
    let used: Option<Use> = item.extract()?;
    Ok(used.map(|(plugin, instance, config)| PluginUse {
        loc,
        plugin,
        instance,
        config,
        ..PluginUse::default()
    }))
}

/// A plugin that a description of Python may use.
pub fn take_extension(values: &Bound<'_, PyDict>, loc: Loc) -> PyResult<Extension> {
    Ok(Extension { name: required(values, "name")?.extract()?, loc })
}

/// An instance that elements refer to by name.
pub fn take_instance(values: &Bound<'_, PyDict>, loc: Loc) -> PyResult<PluginInstance> {
    Ok(PluginInstance {
        name: required(values, "name")?.extract()?,
        loc,
        plugin: required(values, "plugin_name")?.extract()?,
        config: required(values, "_config")?.extract()?,
        expanded: required(values, "expanded")?.is_truthy()?,
    })
}
