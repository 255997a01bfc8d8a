//! Nodes as a config: which keys there are, which must be, and what their values may be.

use super::devices::{
    ActuatorConfig, CameraConfig, Config, DeviceConfig, HardwareId, Interface, SensorConfig,
};
use super::error::{ConfigError, Source};
use super::node::{Content, Key, Node};
use physics::math::Legible;
use physics::model::Suggestions;
use std::collections::HashSet;

/// Keys of a device; `cams` stands in one of RoboHive's files.
const DEVICE: [&str; 5] = ["interface", "sensor", "actuator", "cam", "cams"];
const SENSOR: [&str; 6] = ["name", "range", "noise", "hdr_id", "scale", "offset"];
const ACTUATOR: [&str; 8] =
    ["name", "pos_range", "vel_range", "effort_range", "mode", "hdr_id", "scale", "offset"];

type Outcome<T> = Result<T, ConfigError>;

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

/// The entries of a table that are not read yet.
struct Fields<'a> {
    source: &'a Source<'a>,
    /// Whose they are, for messages.
    owner: String,
    at: usize,
    entries: Vec<(Key, Node)>,
}

impl<'a> Fields<'a> {
    /// The entries of `node`, which must be a table with no keys but `known`.
    fn new(source: &'a Source<'a>, owner: &str, node: Node, known: &[&'static str]) -> Outcome<Self> {
        let (at, kind) = (node.at, node.kind());
        let Content::Table(entries) = node.content else {
            return Err(source.error(at, format!("{owner} is {kind}, not a table")));
        };
        for (key, _) in &entries {
            if !known.contains(&key.name.as_str()) {
                let near = Suggestions::default().nearest(&key.name, known.iter().copied());
                let hint = near.map_or_else(
                    || format!("it may have {}", known.join(", ")),
                    |near| format!("did you mean '{near}'?"),
                );
                return Err(
                    source.error(key.at, format!("{owner} has an unknown key '{}'; {hint}", key.name))
                );
            }
        }
        Ok(Fields { source, owner: owner.to_owned(), at, entries })
    }

    fn take(&mut self, key: &str) -> Option<Node> {
        let place = self.entries.iter().position(|(found, _)| found.name == key)?;
        Some(self.entries.swap_remove(place).1)
    }

    fn missing(&self, key: &str) -> ConfigError {
        self.source.error(self.at, format!("{} has no '{key}'", self.owner))
    }

    fn wrong(&self, at: usize, key: &str, message: &str) -> ConfigError {
        self.source.error(at, format!("'{key}' of {} {message}", self.owner))
    }

    fn list(&mut self, key: &str) -> Outcome<Vec<Node>> {
        let Some(node) = self.take(key) else { return Ok(Vec::new()) };
        let kind = node.kind();
        match node.content {
            Content::List(items) => Ok(items),
            _ => Err(self.wrong(node.at, key, &format!("is {kind}, not a list"))),
        }
    }

    fn text(&mut self, key: &str) -> Outcome<Option<String>> {
        let Some(node) = self.take(key) else { return Ok(None) };
        let kind = node.kind();
        match node.content {
            Content::Text(text) => Ok(Some(text)),
            _ => Err(self.wrong(node.at, key, &format!("is {kind}, not a text"))),
        }
    }

    /// The name, which from here on says in messages whose fields these are.
    fn name(&mut self) -> Outcome<String> {
        let name = self.text("name")?.ok_or_else(|| self.missing("name"))?;
        self.owner = format!("{} ('{name}')", self.owner);
        Ok(name)
    }

    fn finite(&self, key: &str, node: &Node) -> Outcome<f64> {
        let value = match node.content {
            Content::Integer(value) => value as f64,
            Content::Number(value) => value,
            _ => return Err(self.wrong(node.at, key, &format!("is {}, not a number", node.kind()))),
        };
        if !value.is_finite() {
            return Err(self.wrong(node.at, key, &format!("is {value}; it must be finite")));
        }
        Ok(value)
    }

    fn number(&mut self, key: &str) -> Outcome<Option<f64>> {
        self.take(key).map(|node| self.finite(key, &node)).transpose()
    }

    fn noise(&mut self) -> Outcome<f64> {
        let Some(node) = self.take("noise") else { return Ok(0.0) };
        let noise = self.finite("noise", &node)?;
        if noise < 0.0 {
            return Err(self.wrong(node.at, "noise", "is negative"));
        }
        Ok(noise)
    }

    fn scale(&mut self) -> Outcome<f64> {
        let Some(node) = self.take("scale") else { return Ok(1.0) };
        let scale = self.finite("scale", &node)?;
        if scale == 0.0 {
            return Err(self.wrong(node.at, "scale", "is 0, which nothing can be scaled back from"));
        }
        Ok(scale)
    }

    fn hardware(&mut self, place: usize) -> Outcome<HardwareId> {
        let Some(node) = self.take("hdr_id") else { return Ok(HardwareId::Number(place as i64)) };
        let kind = node.kind();
        match node.content {
            Content::Integer(number) => Ok(HardwareId::Number(number)),
            Content::Text(name) => Ok(HardwareId::Name(name)),
            _ => Err(self.wrong(node.at, "hdr_id", &format!("is {kind}, not a whole number or a name"))),
        }
    }

    fn range(&mut self, key: &str) -> Outcome<Option<[f64; 2]>> {
        let Some(node) = self.take(key) else { return Ok(None) };
        let (at, kind) = (node.at, node.kind());
        let Content::List(items) = node.content else {
            return Err(self.wrong(at, key, &format!("is {kind}, not a pair of numbers")));
        };
        let [low, high] = items.as_slice() else {
            return Err(self.wrong(at, key, &format!("has {} numbers, not 2", items.len())));
        };
        let (low, high) = (self.finite(key, low)?, self.finite(key, high)?);
        if low > high {
            return Err(self.wrong(
                at,
                key,
                &format!("begins at {}, above its end {}", Legible(low), Legible(high)),
            ));
        }
        Ok(Some([low, high]))
    }

    fn required_range(&mut self, key: &str) -> Outcome<[f64; 2]> {
        self.range(key)?.ok_or_else(|| self.missing(key))
    }
}
