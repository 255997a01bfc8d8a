//! A config as TOML text.

use super::devices::{ActuatorConfig, CameraConfig, Config, DeviceConfig, HardwareId, SensorConfig};
use super::value::Value;
use std::collections::BTreeMap;
use std::fmt::Write;

/// One `[[device]]` for each device, one line for each sensor, actuator and camera.
pub(super) fn text(config: &Config) -> String {
    config.devices.iter().map(device).collect::<Vec<_>>().join("\n")
}

fn device(device: &DeviceConfig) -> String {
    let mut out = format!("[[device]]\nname = {}\n", quoted(&device.name));
    let kind = device.interface.kind.as_ref().map(|kind| ("type".to_owned(), Value::Text(kind.clone())));
    let interface: BTreeMap<_, _> = device.interface.parameters.clone().into_iter().chain(kind).collect();
    if !interface.is_empty() {
        out += &format!("interface = {}\n", value(&Value::Table(interface)));
    }
    out += &rows("sensor", device.sensors.iter().map(sensor));
    out += &rows("actuator", device.actuators.iter().map(actuator));
    out += &rows("cam", device.cameras.iter().map(camera));
    out
}

fn rows(key: &str, rows: impl ExactSizeIterator<Item = String>) -> String {
    if rows.len() == 0 {
        return String::new();
    }
    let lines: String = rows.map(|row| format!("    {{ {row} }},\n")).collect();
    format!("{key} = [\n{lines}]\n")
}

fn sensor(s: &SensorConfig) -> String {
    let link = link(&s.hardware, s.scale, s.offset);
    format!("name = {}, range = {}, noise = {:?}, {link}", quoted(&s.name), pair(s.range), s.noise)
}

fn camera(c: &CameraConfig) -> String {
    let link = link(&c.hardware, c.scale, c.offset);
    format!("name = {}, range = {}, noise = {:?}, {link}", quoted(&c.name), pair(c.range), c.noise)
}

fn actuator(a: &ActuatorConfig) -> String {
    let mut out = format!(
        "name = {}, pos_range = {}, vel_range = {}",
        quoted(&a.name),
        pair(a.position_range),
        pair(a.velocity_range)
    );
    if let Some(range) = a.effort_range {
        out += &format!(", effort_range = {}", pair(range));
    }
    if let Some(mode) = &a.mode {
        out += &format!(", mode = {}", quoted(mode));
    }
    format!("{out}, {}", link(&a.hardware, a.scale, a.offset))
}

fn link(hardware: &HardwareId, scale: f64, offset: f64) -> String {
    let id = match hardware {
        HardwareId::Number(number) => number.to_string(),
        HardwareId::Name(name) => quoted(name),
    };
    format!("hdr_id = {id}, scale = {scale:?}, offset = {offset:?}")
}

fn pair([low, high]: [f64; 2]) -> String {
    format!("[{low:?}, {high:?}]")
}

fn value(v: &Value) -> String {
    match v {
        Value::None => String::new(),
        Value::Bool(value) => value.to_string(),
        Value::Integer(value) => value.to_string(),
        // Rust's digits of a float are TOML's, but for `NaN`.
        Value::Number(value) => format!("{value:?}").to_lowercase(),
        Value::Text(text) => quoted(text),
        Value::List(items) => {
            let items: Vec<_> = items.iter().filter(|item| **item != Value::None).map(value).collect();
            format!("[{}]", items.join(", "))
        }
        Value::Table(entries) => {
            let entries = entries.iter().filter(|(_, item)| **item != Value::None);
            let entries: Vec<_> =
                entries.map(|(key, item)| format!("{} = {}", quoted(key), value(item))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}

/// A basic string of TOML.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out += "\\\"",
            '\\' => out += "\\\\",
            '\n' => out += "\\n",
            '\t' => out += "\\t",
            c if c.is_control() => write!(out, "\\U{:08X}", u32::from(c)).unwrap_or_default(),
            c => out.push(c),
        }
    }
    out + "\""
}
