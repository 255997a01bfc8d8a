//! Sensors.

use physics::model::{ObjType, SensorType};

use super::plugin;
use super::rows::put_some;
use super::settings::object_word;
use super::text::element;
use crate::schema::Words;
use crate::schema::sensor::{CONTACT_DATA, MEASUREMENTS, PLUGIN_ROWS, RAY_DATA, USER_DATA, blocks};
use crate::spec::{PluginUse, Sensor, Spec};
use crate::xml::Element;

pub(super) fn sensors(spec: &Spec) -> Element {
    let mut out = element("sensor");
    out.children.extend(spec.sensors.iter().filter_map(sensor));
    out
}

pub(super) fn sensor(sensor: &Sensor) -> Option<Element> {
    if let Some(used) = &sensor.plugin {
        return Some(of_plugin(sensor, used));
    }
    let simple = MEASUREMENTS.iter().find(|m| m.kind == sensor.kind)?;
    let mut out = element(simple.element.tag);
    let mut base = Sensor { kind: sensor.kind, objtype: simple.target, ..Sensor::default() };
    if sensor.kind == SensorType::Contact {
        base.intprm[2] = 1;
    }
    let wanted = |name: &str| is_wanted(sensor, name);
    for block in blocks(simple.kind, simple.target) {
        put_some(&mut out, block, sensor, &base, &wanted);
    }
    let data = match sensor.kind {
        SensorType::Rangefinder => data_words(sensor.intprm[0], RAY_DATA),
        SensorType::Contact => data_words(sensor.intprm[0], CONTACT_DATA),
        _ => String::new(),
    };
    if !data.is_empty() {
        out.put("data", data);
    }
    if sensor.kind == SensorType::User && !sensor.objname.is_empty() {
        out.put("objtype", object_word(sensor.objtype));
    }
    Some(out)
}

fn of_plugin(sensor: &Sensor, used: &PluginUse) -> Element {
    let mut out = element("plugin");
    let base = Sensor::default();
    put_some(&mut out, &PLUGIN_ROWS, sensor, &base, &|_| true);
    for (kind, name, object) in [
        ("objtype", "objname", (sensor.objtype, &sensor.objname)),
        ("reftype", "refname", (sensor.reftype, &sensor.refname)),
    ] {
        if !object.1.is_empty() {
            out.put(kind, object_word(object.0));
            out.put(name, object.1);
        }
    }
    put_some(&mut out, &USER_DATA, sensor, &base, &|_| true);
    plugin::put_use(&mut out, used);
    out
}

/// Whether an attribute names an object of the kind that the sensor measures.
fn is_wanted(sensor: &Sensor, name: &str) -> bool {
    let measured = |kind| sensor.objtype == kind && !sensor.objname.is_empty();
    let against = |kind| sensor.reftype == kind && !sensor.refname.is_empty();
    match (sensor.kind, name) {
        (SensorType::Rangefinder | SensorType::Contact, "site") => measured(ObjType::Site),
        (SensorType::Rangefinder, "camera") => measured(ObjType::Camera),
        (_, "geom1") => measured(ObjType::Geom),
        (_, "body1") => measured(ObjType::Body),
        (_, "subtree1") => measured(ObjType::Xbody),
        (_, "geom2") => against(ObjType::Geom),
        (_, "body2") => against(ObjType::Body),
        (_, "subtree2") => against(ObjType::Xbody),
        _ => true,
    }
}

/// The words of the bits; empty for the first alone, which is what silence means.
fn data_words(bits: i32, list: Words) -> String {
    let set = list.iter().filter(|(_, bit)| bits >> bit & 1 == 1 && bits != 1);
    set.map(|(word, _)| *word).collect::<Vec<_>>().join(" ")
}
