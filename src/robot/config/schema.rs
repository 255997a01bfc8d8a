//! Nodes as a config: which keys there are, which must be, and what their values may be.

use super::devices::{ActuatorConfig, CameraConfig, Config, DeviceConfig, Interface, SensorConfig};
use super::error::Source;
use super::fields::{Fields, Outcome};
use super::node::{Content, Node};
use std::collections::HashSet;

/// Keys of a device; `cams` stands in one of RoboHive's files.
const DEVICE: [&str; 5] = ["interface", "sensor", "actuator", "cam", "cams"];
const SENSOR: [&str; 6] = ["name", "range", "noise", "hdr_id", "scale", "offset"];
const ACTUATOR: [&str; 8] =
    ["name", "pos_range", "vel_range", "effort_range", "mode", "hdr_id", "scale", "offset"];

/// `{name: device, …}`.
pub(super) fn named_devices(source: &Source, root: Node) -> Outcome<Config> {
    let kind = root.kind();
    let Content::Table(entries) = root.content else {
        return Err(source.error(root.at, format!("a config is a table of devices, this is {kind}")));
    };
    let devices = entries
        .into_iter()
        .map(|(key, value)| {
            let fields = Fields::new(source, &format!("device '{}'", key.name), value, &DEVICE)?;
            device(key.name, fields)
        })
        .collect::<Outcome<Vec<_>>>()?;
    some(source, root.at, devices)
}

/// `{device: [{name: …}, …]}`.
pub(super) fn listed_devices(source: &Source, root: Node) -> Outcome<Config> {
    let at = root.at;
    let mut top = Fields::new(source, "the config", root, &["device"])?;
    let (mut devices, mut names) = (Vec::new(), HashSet::new());
    for node in top.list("device")? {
        let at = node.at;
        let keys: Vec<_> = DEVICE.iter().chain(&["name"]).copied().collect();
        let mut fields = Fields::new(source, "a device", node, &keys)?;
        let name = fields.text("name")?.ok_or_else(|| fields.missing("name"))?;
        if !names.insert(name.clone()) {
            return Err(source.error(at, format!("the device '{name}' a second time")));
        }
        fields.owner = format!("device '{name}'");
        devices.push(device(name, fields)?);
    }
    some(source, at, devices)
}

/// A config with devices: a robot without any would neither act nor sense.
fn some(source: &Source, at: usize, devices: Vec<DeviceConfig>) -> Outcome<Config> {
    if devices.is_empty() {
        return Err(source
            .error(at, "the config has no device; a robot without config has every sensor and actuator"));
    }
    Ok(Config { devices })
}

fn device(name: String, mut fields: Fields) -> Outcome<DeviceConfig> {
    let source = fields.source;
    let interface = fields.take("interface").map(|node| interface(source, node)).transpose()?;
    let sensors = fields.list("sensor")?.into_iter().enumerate();
    let actuators = fields.list("actuator")?.into_iter().enumerate();
    let mut cameras = fields.list("cam")?;
    cameras.extend(fields.list("cams")?);
    let of = |what: &str, place: usize| format!("{what} {} of device '{name}'", place + 1);
    Ok(DeviceConfig {
        interface: interface.unwrap_or_default(),
        sensors: sensors
            .map(|(i, node)| sensor(Fields::new(source, &of("sensor", i), node, &SENSOR)?, i))
            .collect::<Outcome<_>>()?,
        actuators: actuators
            .map(|(i, node)| actuator(Fields::new(source, &of("actuator", i), node, &ACTUATOR)?, i))
            .collect::<Outcome<_>>()?,
        cameras: cameras
            .into_iter()
            .enumerate()
            .map(|(i, node)| camera(Fields::new(source, &of("camera", i), node, &SENSOR)?, i))
            .collect::<Outcome<_>>()?,
        name,
    })
}

fn interface(source: &Source, node: Node) -> Outcome<Interface> {
    let kind = node.kind();
    let Content::Table(entries) = node.content else {
        return Err(source.error(node.at, format!("an interface is a table, this is {kind}")));
    };
    let mut interface = Interface::default();
    for (key, value) in entries {
        if key.name == "type" {
            let at = value.at;
            let Content::Text(kind) = value.content else {
                return Err(source.error(at, "the type of an interface is a text"));
            };
            interface.kind = Some(kind);
        } else {
            interface.parameters.insert(key.name, value.into_value());
        }
    }
    Ok(interface)
}

fn sensor(mut fields: Fields, place: usize) -> Outcome<SensorConfig> {
    Ok(SensorConfig {
        name: fields.name()?,
        range: fields.required_range("range")?,
        noise: fields.noise()?,
        hardware: fields.hardware(place)?,
        scale: fields.scale()?,
        offset: fields.number("offset")?.unwrap_or(0.0),
    })
}

fn camera(fields: Fields, place: usize) -> Outcome<CameraConfig> {
    let SensorConfig { name, range, noise, hardware, scale, offset } = sensor(fields, place)?;
    Ok(CameraConfig { name, range, noise, hardware, scale, offset })
}

fn actuator(mut fields: Fields, place: usize) -> Outcome<ActuatorConfig> {
    Ok(ActuatorConfig {
        name: fields.name()?,
        position_range: fields.required_range("pos_range")?,
        velocity_range: fields.required_range("vel_range")?,
        effort_range: fields.range("effort_range")?,
        mode: fields.text("mode")?,
        hardware: fields.hardware(place)?,
        scale: fields.scale()?,
        offset: fields.number("offset")?.unwrap_or(0.0),
    })
}
