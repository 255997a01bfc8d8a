//! The devices of a robot's config, on one plant.

use crate::bench::{Bench, Carries, LinkId};
use crate::chain::{Bus, Member, servos_of};
use crate::franka::{Arm, Hand};
use crate::optitrack::Tracker;
use crate::plant::{Plant, PlantError};
use crate::robotiq::{Gateway, Gripper, Rtu};
use crate::{dynamixel, feetech};
use protocol::dynamixel::v1;
use protocol::franka::Version;
use protocol::optitrack::natnet;
use protocol::robotiq::{ADDRESS, STROKE};
use robot::{Config, DeviceConfig, Value};

/// Where a driver finds a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outlet {
    /// A serial port.
    Serial,
    /// A server for connections, at this port.
    Tcp(u16),
    /// Datagrams from or to this port.
    Udp(u16),
}

/// A device of the config that is simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Rigged {
    /// Its name in the config.
    pub device: String,
    /// Type of its interface.
    pub kind: String,
    /// The key of the interface that says where it is: of a serial port `name`.
    pub key: &'static str,
    /// Where the config has it: a serial port, or a host.
    pub address: String,
    /// Its links.
    pub links: Vec<(Outlet, LinkId)>,
}

/// Puts a device of a config on a bench. Links take no time where told so, and as long as real ones otherwise.
type Maker = fn(&DeviceConfig, &mut Bench, bool) -> Result<Vec<(Outlet, LinkId)>, PlantError>;

/// Type of interface, the key that says where the device is, and what makes it.
const MAKERS: [(&str, &str, Maker); 5] = [
    ("dynamixel", "name", dynamixels),
    ("feetech", "name", feetechs),
    ("franka", "ip_address", franka),
    ("optitrack", "server_name", tracker),
    ("robotiq", "name", gripper),
];

/// The key that says where a gripper's gateway is.
const GATEWAY: &str = "ip_address";
/// The port of the gateway on the controller of a Universal Robots arm.
const GATEWAY_PORT: u16 = 63_352;

/// Largest width of the Franka Hand \[m\].
const HAND: f64 = 0.08;

/// Types of interface that can be simulated.
pub fn kinds() -> impl Iterator<Item = &'static str> {
    MAKERS.iter().map(|(kind, _, _)| *kind)
}

/// Puts the devices of `config` that can be simulated on a bench, each moving and measuring what the config says. Links take
/// no time when `at_once`, and as long as the real ones otherwise. Joints that the model has outside the ranges of their
/// actuators begin in the middle of them.
///
/// # Errors
/// Devices that name what the plant does not have; a config without any device that can be simulated.
pub fn rig(config: &Config, mut plant: Plant, at_once: bool) -> Result<(Bench, Vec<Rigged>), PlantError> {
    let begin = plant.within(config.devices.iter().flat_map(|device| &device.actuators))?;
    plant
        .place(&begin, &vec![0.0; plant.data().state.qvel.len()])
        .map_err(|error| PlantError::new(error.to_string()))?;
    let mut bench = Bench::new(plant);
    let mut rigged = Vec::new();
    for device in config.devices.iter().map(robot::DeviceConfig::on_hardware) {
        let device = &device;
        let Some((kind, key, _)) = maker(device) else { continue };
        if device.sensors.is_empty() && device.actuators.is_empty() {
            continue;
        }
        let key = if behind_gateway(device) { GATEWAY } else { key };
        let address = text(device, key).unwrap_or(&device.name).to_owned();
        let links = connect(device, &mut bench, at_once)?;
        rigged.push(Rigged { device: device.name.clone(), kind: (*kind).to_owned(), key, address, links });
    }
    if rigged.is_empty() {
        let kinds: Vec<_> = kinds().collect();
        let named = |device: &DeviceConfig| {
            let kind = device.interface.kind.as_deref().unwrap_or("none");
            format!("'{kind}' of device '{}'", device.name)
        };
        let named: Vec<_> = config.devices.iter().map(named).collect();
        return Err(PlantError::new(format!(
            "no device of the config has sensors or actuators and an interface that can be simulated: {}; those that can are {}",
            named.join(", "),
            kinds.join(", ")
        )));
    }
    Ok((bench, rigged))
}

fn maker(device: &DeviceConfig) -> Option<&'static (&'static str, &'static str, Maker)> {
    MAKERS.iter().find(|(kind, _, _)| device.interface.kind.as_deref() == Some(kind))
}

/// Puts one device on a bench; returns its links, as [`rig`] does.
///
/// # Errors
/// A device that cannot be simulated, or that names an element which the plant lacks.
pub fn connect(
    device: &DeviceConfig,
    bench: &mut Bench,
    at_once: bool,
) -> Result<Vec<(Outlet, LinkId)>, PlantError> {
    let wrong = |why: String| PlantError::new(format!("device '{}': {why}", device.name));
    let Some((_, _, make)) = maker(device) else {
        let kinds: Vec<_> = kinds().collect();
        return Err(wrong(format!("only these interfaces can be simulated: {}", kinds.join(", "))));
    };
    make(device, bench, at_once).map_err(|error| wrong(error.to_string()))
}

fn text<'a>(device: &'a DeviceConfig, key: &str) -> Option<&'a str> {
    match device.interface.parameters.get(key)? {
        Value::Text(text) => Some(text),
        _ => None,
    }
}

fn number(device: &DeviceConfig, key: &str, otherwise: f64) -> f64 {
    match device.interface.parameters.get(key) {
        Some(Value::Integer(number)) => *number as f64,
        Some(Value::Number(number)) => *number,
        _ => otherwise,
    }
}

/// Whether a device is a gripper that the controller of an arm leads to.
fn behind_gateway(device: &DeviceConfig) -> bool {
    device.interface.kind.as_deref() == Some("robotiq") && text(device, GATEWAY).is_some()
}

/// A serial line at the baud rate that a config gives its bus.
fn line(device: &DeviceConfig, at_once: bool) -> (f64, Carries) {
    let usual = if device.interface.kind.as_deref() == Some("robotiq") { 115_200.0 } else { 1e6 };
    let baud = number(device, "baud", usual);
    (baud, if at_once { Carries::AT_ONCE } else { Carries::serial(baud) })
}

fn dynamixels(
    device: &DeviceConfig,
    bench: &mut Bench,
    at_once: bool,
) -> Result<Vec<(Outlet, LinkId)>, PlantError> {
    let name = text(device, "model");
    if let Some(model) = model_v1(device, name) {
        let make = |id| dynamixel::v1::Servo::new(model, id);
        return chain(device, bench, at_once, make, dynamixel::v1::Servo::mount);
    }
    let model = match name {
        Some(name) => protocol::dynamixel::model(name).ok_or_else(|| {
            let known = protocol::dynamixel::KINDS.iter().chain(&v1::KINDS).map(|kind| kind.name);
            let known: Vec<_> = known.collect();
            PlantError::new(format!("no servo '{name}' can be simulated; there are {}", known.join(", ")))
        })?,
        None => &protocol::dynamixel::MODELS[0],
    };
    chain(device, bench, at_once, |id| dynamixel::Servo::new(model, id), dynamixel::Servo::mount)
}

/// The model of servos with protocol 1.0, where the config names one, or the protocol.
fn model_v1(device: &DeviceConfig, name: Option<&str>) -> Option<&'static v1::Model> {
    match name {
        Some(name) => v1::model(name),
        None if number(device, "protocol", 2.0) == 1.0 => v1::model(v1::MODELS[0].kind.name),
        None => None,
    }
}

fn feetechs(
    device: &DeviceConfig,
    bench: &mut Bench,
    at_once: bool,
) -> Result<Vec<(Outlet, LinkId)>, PlantError> {
    chain(device, bench, at_once, feetech::Servo::new, feetech::Servo::mount)
}

/// Servos that share a line.
fn chain<S: Member + 'static>(
    device: &DeviceConfig,
    bench: &mut Bench,
    at_once: bool,
    make: impl Fn(u8) -> S,
    mount: fn(&mut S, usize, f64, f64),
) -> Result<Vec<(Outlet, LinkId)>, PlantError> {
    let (baud, carries) = line(device, at_once);
    let bus = Bus::new(servos_of(device, bench.plant(), make, mount)?).with_baud(baud);
    Ok(vec![(Outlet::Serial, bench.connect(Box::new(bus), carries))])
}

fn tracker(device: &DeviceConfig, bench: &mut Bench, _: bool) -> Result<Vec<(Outlet, LinkId)>, PlantError> {
    let tracker = Tracker::of(device, bench.plant())?;
    let natnet = text(device, "protocol") == Some("natnet");
    let port = if natnet { natnet::DATA_PORT } else { number(device, "port", 5000.0) as u16 };
    let [frames, requests] = bench.connect_all(Box::new(tracker), [Carries::Datagrams; 2]);
    let mut links = vec![(Outlet::Udp(port), frames)];
    links.extend(natnet.then_some((Outlet::Udp(natnet::COMMAND_PORT), requests)));
    Ok(links)
}

/// An arm of version 10, unless the config says 5, with the first seven actuators; the eighth is the hand's finger.
fn franka(device: &DeviceConfig, bench: &mut Bench, _: bool) -> Result<Vec<(Outlet, LinkId)>, PlantError> {
    let names: Vec<_> = device.actuators.iter().map(|actuator| actuator.name.as_str()).collect();
    let Some((joints, rest)) = names.split_first_chunk::<7>() else {
        return Err(PlantError::new(format!(
            "an arm has seven joints, and the config {} actuators",
            names.len()
        )));
    };
    let version = if number(device, "version", 0.0) == 5.0 { Version::V5 } else { Version::V10 };
    let mounts = std::array::from_fn(|k| [device.actuators[k].scale, device.actuators[k].offset]);
    if let Some(place) = mounts.iter().position(|[scale, _]: &[f64; 2]| scale.abs() != 1.0) {
        let name = joints[place];
        return Err(PlantError::new(format!(
            "the scale of '{name}' is neither 1 nor -1; an arm's joints turn as far as the model's"
        )));
    }
    let arm = Arm::new(version, bench.plant(), *joints)?.mounted(bench.plant(), mounts);
    let hand = rest.first().map(|finger| Hand::new(bench.plant(), finger, HAND)).transpose()?;
    let mut links = Vec::new();
    let mut connect = |bench: &mut Bench, made, port| {
        let [commands, states] = bench.connect_all(made, [Carries::AT_ONCE, Carries::Datagrams]);
        links.extend([(Outlet::Tcp(port), commands), (Outlet::Udp(port), states)]);
    };
    connect(bench, Box::new(arm) as Box<dyn crate::Device>, 1337);
    if let Some(hand) = hand {
        connect(bench, Box::new(hand), number(device, "hand_port", 1338.0) as u16);
    }
    Ok(links)
}

fn gripper(
    device: &DeviceConfig,
    bench: &mut Bench,
    at_once: bool,
) -> Result<Vec<(Outlet, LinkId)>, PlantError> {
    let Some(actuator) = device.actuators.first() else {
        return Err(PlantError::new("a gripper needs an actuator, that of its fingers"));
    };
    if actuator.scale == 0.0 {
        return Err(PlantError::new(format!("the scale of '{}' is 0", actuator.name)));
    }
    let ends = [0.0, STROKE].map(|width| (width - actuator.offset) / actuator.scale);
    let gripper = Gripper::new(bench.plant(), &actuator.name, ends)?;
    if behind_gateway(device) {
        let link = bench.connect(Box::new(Gateway::new(gripper)), Carries::AT_ONCE);
        return Ok(vec![(Outlet::Tcp(GATEWAY_PORT), link)]);
    }
    let slave = number(device, "slave", f64::from(ADDRESS)) as u8;
    let (_, carries) = line(device, at_once);
    Ok(vec![(Outlet::Serial, bench.connect(Box::new(Rtu::new(gripper, slave)), carries))])
}
