//! A config's names as places in a model's arrays.

use crate::compat::Compat;
use crate::config::{ActuatorConfig, Config, DeviceConfig, SensorConfig};
use crate::error::{Part, RobotError};
use physics::Model;
use physics::elements::{ActuatorId, Element, SensorId};
use physics::model::{JointType, ObjType, SensorType, Suggestions, TrnType};
use std::ops::Range;

/// Name of the one device of a robot without config.
const DEFAULT_DEVICE: &str = "default_robot";

/// Where a reading belongs in the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// In `qpos`.
    Position(usize),
    /// In `qvel`.
    Velocity(usize),
}

/// A sensor of the config in a model.
#[derive(Clone, Debug)]
pub(crate) struct Sensor {
    pub(crate) config: SensorConfig,
    /// Where `sensordata` has its value.
    pub(crate) source: usize,
    pub(crate) target: Target,
    /// Whether the hardware has it.
    pub(crate) on_hardware: bool,
}

/// An actuator of the config in a model.
#[derive(Clone, Debug)]
pub(crate) struct Actuator {
    pub(crate) config: ActuatorConfig,
    /// Its number among the model's actuators.
    pub(crate) id: usize,
    /// Its place in `ctrl` and in actions.
    pub(crate) control: usize,
    /// Where `qpos` has the position that it moves.
    pub(crate) position: usize,
}

/// A device: which of the robot's sensors and actuators are its own.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) name: String,
    pub(crate) sensors: Range<usize>,
    pub(crate) actuators: Range<usize>,
}

/// Everything that a config names, found in a model.
#[derive(Clone, Debug, Default)]
pub(crate) struct Binding {
    pub(crate) devices: Vec<Group>,
    pub(crate) sensors: Vec<Sensor>,
    pub(crate) actuators: Vec<Actuator>,
    /// Controls that no actuator of the config has.
    pub(crate) unlisted: Vec<usize>,
    /// Numbers in `ctrl` and `sensordata`.
    lengths: [usize; 2],
}

impl Binding {
    /// Finds the names of `config` in `model`.
    ///
    /// # Errors
    /// Names that the model does not have, elements that are of another kind than a robot uses.
    pub(crate) fn new(model: &Model, config: &Config, compat: Compat) -> Result<Binding, RobotError> {
        check_names(model, config)?;
        let mut binding = Binding { lengths: [model.nu, model.nsensordata], ..Binding::default() };
        for device in &config.devices {
            let (sensors, actuators) = (binding.sensors.len(), binding.actuators.len());
            for row in &device.sensors {
                binding.sensors.push(sensor(model, device, row, compat)?);
            }
            for row in &device.actuators {
                binding.actuators.push(actuator(model, device, row, compat)?);
            }
            binding.devices.push(Group {
                name: device.name.clone(),
                sensors: sensors..binding.sensors.len(),
                actuators: actuators..binding.actuators.len(),
            });
        }
        let listed = |control: &usize| binding.actuators.iter().any(|actuator| actuator.control == *control);
        binding.unlisted = (0..model.nu).filter(|control| !listed(control)).collect();
        Ok(binding)
    }

    /// All actuators of the model and its whole state as one device.
    pub(crate) fn of_everything(model: &Model) -> Binding {
        let values = model.nq + model.nv + model.na;
        let device = Group { name: DEFAULT_DEVICE.to_owned(), sensors: 0..values, actuators: 0..0 };
        Binding {
            devices: vec![device],
            unlisted: (0..model.nu).collect(),
            lengths: [model.nu, model.nsensordata],
            ..Binding::default()
        }
    }

    /// Numbers that the model has of sensors or actuators.
    pub(crate) fn length(&self, part: Part) -> usize {
        match part {
            Part::Actuator => self.lengths[0],
            Part::Sensor => self.lengths[1],
        }
    }
}

/// Names of sensors and actuators that the model does not have.
fn check_names(model: &Model, config: &Config) -> Result<(), RobotError> {
    let rows = config.devices.iter().flat_map(|device| {
        let sensors = device.sensors.iter().map(|row| (Part::Sensor, row.name.as_str()));
        let actuators = device.actuators.iter().map(|row| (Part::Actuator, row.name.as_str()));
        sensors.chain(actuators).map(move |(part, name)| (device, part, name))
    });
    let unknown = |(_, part, name): &(&DeviceConfig, Part, &str)| {
        // A component of a pose is named after its sensor.
        let whole = name.split_once('[').filter(|_| *part == Part::Sensor).map_or(*name, |(whole, _)| whole);
        model.id_of(kind(*part), name).is_none() && model.id_of(kind(*part), whole).is_none()
    };
    let Some((device, part, name)) = rows.clone().find(|row| unknown(row)) else { return Ok(()) };
    let names = (0..count(model, part)).map(|id| model.name_of(kind(part), id));
    Err(RobotError::UnknownName {
        device: device.name.clone(),
        part,
        name: name.to_owned(),
        nearest: Suggestions::default().nearest(name, names).map(str::to_owned),
        missing: rows.clone().filter(|row| unknown(row)).count(),
        total: rows.count(),
    })
}

fn kind(part: Part) -> ObjType {
    match part {
        Part::Sensor => SensorId::KIND,
        Part::Actuator => ActuatorId::KIND,
    }
}

fn count(model: &Model, part: Part) -> usize {
    match part {
        Part::Sensor => SensorId::count(model),
        Part::Actuator => ActuatorId::count(model),
    }
}

/// The number of an element whose name was checked.
fn id(model: &Model, device: &DeviceConfig, part: Part, name: &str) -> Result<usize, RobotError> {
    model
        .id_of(kind(part), name)
        .ok_or_else(|| unsupported(device, part, name, "is not in the model".to_owned()))
}

fn unsupported(device: &DeviceConfig, part: Part, name: &str, reason: String) -> RobotError {
    RobotError::Unsupported { device: device.name.clone(), part, name: name.to_owned(), reason }
}

/// Where `qpos` has the free joint of the body that a sensor called `name` of kind `framepos` or `framequat` is on; `None` for
/// other sensors.
pub fn free_joint(model: &Model, name: &str) -> Option<usize> {
    let id = model.sensor(name)?.index();
    let pose = [SensorType::Framepos, SensorType::Framequat].map(Some);
    let body = model.sensor_objid[id];
    let on_body = model.sensor_objtype[id] == ObjType::Xbody as i32 && model.sensor_refid[id] < 0;
    let body = usize::try_from(body)
        .ok()
        .filter(|_| on_body && pose.contains(&SensorType::from_code(model.sensor_type[id])))?;
    let joint = usize::try_from(model.body_jntadr[body]).ok()?;
    (model.jnt_type[joint] == JointType::Free as i32).then(|| model.jnt_qposadr[joint] as usize)
}

/// The component of a pose that `name[k]` names: the sensor's name, its number among its values, and where `qpos` has it.
fn component(model: &Model, row: &SensorConfig) -> Option<(usize, usize, usize)> {
    let (name, rest) = row.name.split_once('[')?;
    let k: usize = rest.strip_suffix(']')?.parse().ok()?;
    let id = model.sensor(name)?.index();
    let address = free_joint(model, name)?;
    let (first, count) = match SensorType::from_code(model.sensor_type[id]) {
        Some(SensorType::Framepos) => (address, 3),
        _ => (address + 3, 4),
    };
    (k < count).then_some((id, k, first + k))
}

fn sensor(
    model: &Model,
    device: &DeviceConfig,
    row: &SensorConfig,
    compat: Compat,
) -> Result<Sensor, RobotError> {
    let on_hardware = device.has(&row.hardware);
    if let Some((id, k, address)) = component(model, row) {
        let source = model.sensor_adr[id] as usize + k;
        let target = Target::Position(address);
        return Ok(Sensor { config: row.clone(), source, target, on_hardware });
    }
    let id = id(model, device, Part::Sensor, &row.name)?;
    let joint = model.sensor_objid[id].max(0) as usize;
    let target = match SensorType::from_code(model.sensor_type[id]) {
        Some(SensorType::Jointpos) => Target::Position(model.jnt_qposadr[joint] as usize),
        Some(SensorType::Jointvel) => Target::Velocity(model.jnt_dofadr[joint] as usize),
        other => {
            let found = other.map_or_else(|| "unknown".to_owned(), |kind| format!("{kind:?}").to_lowercase());
            let reason = format!(
                "is of kind {found}; a robot reads jointpos, jointvel, and components of framepos and framequat of a body with a free joint, as name[0]"
            );
            return Err(unsupported(device, Part::Sensor, &row.name, reason));
        }
    };
    let source = match compat {
        Compat::Fixed => model.sensor_adr[id] as usize,
        // Sensors have at least one value each, so that there is one at this place.
        Compat::RoboHive07 => id,
    };
    Ok(Sensor { config: row.clone(), source, target, on_hardware })
}

fn actuator(
    model: &Model,
    device: &DeviceConfig,
    row: &ActuatorConfig,
    compat: Compat,
) -> Result<Actuator, RobotError> {
    let id = id(model, device, Part::Actuator, &row.name)?;
    let wrong = |reason: String| Err(unsupported(device, Part::Actuator, &row.name, reason));
    let transmission = TrnType::from_code(model.actuator_trntype[id]);
    if transmission != Some(TrnType::Joint) {
        let found = transmission.map_or_else(|| "unknown".to_owned(), |t| format!("{t:?}").to_lowercase());
        return wrong(format!("pulls on something of kind {found}; a robot commands actuators of joints"));
    }
    if model.actuator_ctrlnum[id] != 1 {
        return wrong(format!("has {} controls; a robot commands one", model.actuator_ctrlnum[id]));
    }
    let joint = model.actuator_trnid[id][0] as usize;
    let position = match compat {
        Compat::Fixed => model.jnt_qposadr[joint],
        Compat::RoboHive07 => model.jnt_dofadr[joint],
    };
    let control = model.actuator_ctrladr[id] as usize;
    Ok(Actuator { config: row.clone(), id, control, position: position as usize })
}

impl Actuator {
    /// Limits of the commanded position.
    pub(crate) fn position_range(&self) -> [f64; 2] {
        self.config.position_range
    }
}
