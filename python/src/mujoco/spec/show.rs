//! The elements of a `Spec` for Python, kind by kind in the order of their ids.

use super::value::shown;
use super::{deformable, parts};
use mjcf::diagnostic::Loc;
use mjcf::spec::{Body, Class, Fields, Frame, KeptKey, Key, Pair, SOLIMP, SOLREF, Spec};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::collections::{BTreeMap, HashMap};

/// The elements of one kind: attributes, number of the body, number of the frame, text and offset in it.
pub type Row<'py> = (Bound<'py, PyDict>, i64, i64, u32, u32);

/// What is gathered while the tree is walked.
struct Rows<'py> {
    all: Bound<'py, PyDict>,
    /// The body of each frame, -1 until it is known.
    holders: Vec<i64>,
    /// The number of the body that begins at a place.
    places: BTreeMap<Loc, i64>,
}

fn number(index: Option<usize>) -> i64 {
    index.map_or(-1, |index| index as i64)
}

impl<'py> Rows<'py> {
    fn push(
        &self,
        kind: &str,
        values: Bound<'py, PyDict>,
        body: i64,
        frame: Option<usize>,
        loc: Loc,
    ) -> PyResult<()> {
        let list = match self.all.get_item(kind)? {
            Some(list) => list,
            None => {
                self.all.set_item(kind, PyList::empty(self.all.py()))?;
                self.all.get_item(kind)?.unwrap_or_else(|| PyList::empty(self.all.py()).into_any())
            }
        };
        let row: Row<'py> = (values, body, number(frame), loc.file, loc.offset);
        list.cast::<PyList>()?.append(row)
    }

    /// A frame that holds something of a body stands in that body.
    fn hold(&mut self, frame: Option<usize>, body: i64, frames: &[Frame]) {
        let mut next = frame;
        while let Some(frame) = next.filter(|&frame| self.holders[frame] < 0) {
            self.holders[frame] = body;
            next = frames[frame].parent;
        }
    }

    fn body(&mut self, body: &Body, parent: i64, frames: &[Frame], count: &mut i64) -> PyResult<()> {
        let (py, own) = (self.all.py(), *count);
        *count += 1;
        let values = shown(py, body)?;
        values.set_item("alt", parts::orientation(body.alt))?;
        parts::show_inertial(py, body, &values)?;
        values.set_item("_shares", parts::shares(&body.keyed))?;
        deformable::show_use(body.plugin.as_ref(), &values)?;
        self.push("body", values, parent, body.frame, body.loc)?;
        self.places.entry(body.loc).or_insert(own);
        self.hold(body.frame, parent, frames);
        macro_rules! posed {
            ($($kind:literal $list:ident $($alt:ident)? $(| $plugin:ident)?;)*) => {
                $(for element in &body.$list {
                    let values = shown(py, element)?;
                    $(values.set_item("alt", parts::orientation(element.$alt))?;)?
                    $(deformable::show_use(element.$plugin.as_ref(), &values)?;)?
                    self.push($kind, values, own, element.frame, element.loc)?;
                    self.hold(element.frame, own, frames);
                })*
            };
        }
        for joint in &body.joints {
            let values = shown(py, joint)?;
            values.set_item("_shares", parts::shares(&joint.keyed))?;
            self.push("joint", values, own, joint.frame, joint.loc)?;
            self.hold(joint.frame, own, frames);
        }
        posed!("geom" geoms alt | plugin; "site" sites alt; "camera" cameras alt; "light" lights;);
        body.bodies.iter().try_for_each(|child| self.body(child, own, frames, count))
    }

    /// Frames come after the tree, which says what body each stands in.
    fn frames(&self, frames: &[Frame]) -> PyResult<()> {
        for (index, frame) in frames.iter().enumerate() {
            let values = shown(self.all.py(), frame)?;
            values.set_item("alt", parts::orientation(frame.alt))?;
            let known = Some(self.holders[index]).filter(|&body| body >= 0);
            let body = known.or_else(|| self.places.get(&frame.holder).copied()).unwrap_or(0);
            self.push("frame", values, body, frame.parent, frame.loc)?;
        }
        Ok(())
    }

    fn plain(&self, kind: &str, element: &dyn Fields, loc: Loc) -> PyResult<()> {
        self.push(kind, shown(self.all.py(), element)?, -1, None, loc)
    }
}

/// A pair with the numbers that hold where the text is silent.
pub fn completed(pair: &Pair) -> Pair {
    Pair {
        condim: pair.condim.or(Some(3)),
        solref: pair.solref.or(Some(SOLREF)),
        solreffriction: pair.solreffriction.or(Some([0.0; 2])),
        solimp: pair.solimp.or(Some(SOLIMP)),
        margin: pair.margin.or(Some(0.0)),
        gap: pair.gap.or(Some(0.0)),
        adhesion: pair.adhesion.or(Some(0.0)),
        friction: pair.friction.or(Some([1.0, 1.0, 0.005, 0.0001, 0.0001])),
        ..pair.clone()
    }
}

/// All elements by kind.
pub fn elements<'py>(py: Python<'py>, spec: &Spec) -> PyResult<Bound<'py, PyDict>> {
    let mut rows =
        Rows { all: PyDict::new(py), holders: vec![-1; spec.frames.len()], places: BTreeMap::new() };
    rows.body(&spec.world, -1, &spec.frames, &mut 0)?;
    rows.frames(&spec.frames)?;
    macro_rules! lists {
        ($($kind:literal $list:ident)*) => {
            $(spec.$list.iter().try_for_each(|element| rows.plain($kind, element, element.loc))?;)*
        };
    }
    for mesh in &spec.meshes {
        let values = shown(py, mesh)?;
        values.set_item("file", &mesh.path)?;
        deformable::show_use(mesh.plugin.as_ref(), &values)?;
        rows.push("mesh", values, -1, None, mesh.loc)?;
    }
    for hfield in &spec.hfields {
        let values = shown(py, hfield)?;
        values.set_item("file", &hfield.path)?;
        rows.push("hfield", values, -1, None, hfield.loc)?;
    }
    for texture in &spec.textures {
        let values = shown(py, texture)?;
        values.set_item("file", &texture.path)?;
        values.set_item("cubefiles", &texture.cubepaths)?;
        rows.push("texture", values, -1, None, texture.loc)?;
    }
    lists!("material" materials "exclude" excludes "equality" equalities "numeric" numerics "text" texts);
    extended(py, spec, &rows)?;
    for sensor in &spec.sensors {
        let values = shown(py, sensor)?;
        deformable::show_use(sensor.plugin.as_ref(), &values)?;
        rows.push("sensor", values, -1, None, sensor.loc)?;
    }
    spec.pairs.iter().try_for_each(|pair| rows.plain("pair", &completed(pair), pair.loc))?;
    for tendon in &spec.tendons {
        let values = shown(py, tendon)?;
        values.set_item("_steps", parts::path(tendon))?;
        rows.push("tendon", values, -1, None, tendon.loc)?;
    }
    for actuator in &spec.actuators {
        let values = shown(py, actuator)?;
        values.set_item("_shares", parts::shares(&actuator.keyed))?;
        deformable::show_use(actuator.plugin.as_ref(), &values)?;
        rows.push("actuator", values, -1, None, actuator.loc)?;
    }
    for tuple in &spec.tuples {
        let values = shown(py, tuple)?;
        parts::show_entries(py, tuple, &values)?;
        rows.push("tuple", values, -1, None, tuple.loc)?;
    }
    spec.keys.iter().try_for_each(|key| rows.plain("key", key, key.loc))?;
    for KeptKey { name, loc, time, .. } in &spec.kept_keys {
        let values = shown(py, &Key { name: name.clone(), time: *time, ..Key::default() })?;
        values.set_item("_kept", true)?;
        rows.push("key", values, -1, None, *loc)?;
    }
    Ok(rows.all)
}

/// Flexes, skins, and plugins with their instances.
fn extended<'py>(py: Python<'py>, spec: &Spec, rows: &Rows<'py>) -> PyResult<()> {
    for flex in &spec.flexes {
        let values = shown(py, flex)?;
        values.set_item("_empty_cells", &flex.empty_cells)?;
        rows.push("flex", values, -1, None, flex.loc)?;
    }
    for skin in &spec.skins {
        let values = shown(py, skin)?;
        deformable::show_bones(py, skin, &values)?;
        rows.push("skin", values, -1, None, skin.loc)?;
    }
    for instance in &spec.plugins {
        let values = shown(py, instance)?;
        values.set_item("plugin_name", &instance.plugin)?;
        values.set_item("_config", instance.config.clone())?;
        rows.push("plugin", values, -1, None, instance.loc)?;
    }
    spec.extensions.iter().try_for_each(|extension| rows.plain("extension", extension, extension.loc))
}

/// The elements of a class by kind.
pub fn class<'py>(py: Python<'py>, class: &Class) -> PyResult<HashMap<&'static str, Bound<'py, PyDict>>> {
    let mut all = HashMap::new();
    macro_rules! kinds {
        ($($kind:ident)*) => { $(all.insert(stringify!($kind), shown(py, &class.$kind)?);)* };
    }
    kinds!(joint geom site camera light mesh material equality tendon actuator);
    all.insert("pair", shown(py, &completed(&class.pair))?);
    Ok(all)
}
