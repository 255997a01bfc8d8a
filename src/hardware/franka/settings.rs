//! What a config says of an arm.

use super::workspace::Workspace;
use crate::parameters::Parameters;
use protocol::franka::{HAND_PORT, JOINTS, PORT, Version};
use robot::{ActuatorConfig, DeviceConfig, Fault, HardwareId, SensorConfig};
use std::net::IpAddr;

/// Number of the hand among actuators.
const HAND: usize = JOINTS;

/// From the flange of an arm to the tips of a Franka Hand's fingers \[m\].
const FINGERTIPS: f64 = 0.1034;

/// What a sensor reads, of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Position(usize),
    Velocity(usize),
    Torque(usize),
    External(usize),
    Width,
}

/// What is commanded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    Joint(usize),
    Width,
}

/// Parameters of an arm.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) version: Option<Version>,
    /// Torques from here instead of the arm's own control.
    pub(super) impedance: bool,
    pub(super) gain_scale: f64,
    pub(super) reset_gain_scale: f64,
    /// Targets jump.
    pub(super) direct: bool,
    pub(super) collision: [f64; 2],
    /// Where the end effector may be.
    pub(super) workspace: Option<Workspace>,
    pub(super) watchdog: f64,
    pub(super) reset_time: f64,
    pub(super) hand: bool,
    pub(super) hand_port: u16,
    pub(super) hand_speed: f64,
    pub(super) hand_force: f64,
    pub(super) targets: Vec<Target>,
    pub(super) sensors: Vec<Quantity>,
}

fn refused(why: String) -> Fault {
    Fault::Refused(why)
}

/// Address and port of `host:port`, or of a host alone.
fn split(address: &str) -> Result<(String, u16), Fault> {
    match address.rsplit_once(':') {
        // An address of IP version 6 has colons of its own.
        Some((host, port)) if !host.contains(':') => {
            let port = port.parse().map_err(|_| {
                refused(format!("its interface has ip_address = '{address}', whose port is no number"))
            })?;
            Ok((host.to_owned(), port))
        }
        _ => Ok((address.to_owned(), PORT)),
    }
}

impl Settings {
    /// Those of a device.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub(super) fn new(config: &DeviceConfig) -> Result<Settings, Fault> {
        let mut parameters = Parameters::new(config);
        let address = parameters.text("ip_address")?.ok_or_else(|| {
            refused("its interface has no 'ip_address', the address of the arm, as '172.16.0.2'".to_owned())
        })?;
        let (host, port) = split(&address)?;
        let impedance = parameters.choice("control", &["impedance", "position"])? == 0;
        let direct = parameters.choice("interpolation", &["smooth", "none"])? == 1;
        if direct && !(host == "localhost" || host.parse().is_ok_and(|address: IpAddr| address.is_loopback()))
        {
            return Err(refused(format!(
                "its interface has interpolation = 'none', which lets targets jump beyond the limits of an arm: only a \
                 simulated one at a loopback address is sent that, not '{host}'"
            )));
        }
        let version = parameters.number("version", 0.0, [0.0, 10.0])?;
        let version = match version {
            0.0 => None,
            number => Some(Version::of(number as u16).ok_or_else(|| {
                refused(format!(
                    "its interface has version = {number}; there are 5 and 10, and 0 to find out"
                ))
            })?),
        };
        let hand = parameters.flag("hand", false)?;
        let tool = parameters.number("tool", if hand { FINGERTIPS } else { 0.0 }, [-1.0, 1.0])?;
        let numbers = parameters.numbers("box")?;
        let settings = Settings {
            host,
            port,
            version,
            impedance,
            direct,
            gain_scale: parameters.number("gain_scale", 1.0, [0.0, 2.0])?,
            reset_gain_scale: parameters.number("reset_gain_scale", 1.0, [0.0, 2.0])?,
            collision: [
                parameters.number("collision_torque", 40.0, [1.0, 100.0])?,
                parameters.number("collision_force", 40.0, [1.0, 100.0])?,
            ],
            watchdog: parameters.number("watchdog", 0.25, [0.02, 10.0])?,
            reset_time: parameters.number("reset_time", 5.0, [0.1, 60.0])?,
            workspace: numbers.map(|numbers| Workspace::new(&numbers, tool)).transpose()?,
            hand,
            hand_port: parameters.number("hand_port", f64::from(HAND_PORT), [1.0, 65_535.0])? as u16,
            hand_speed: parameters.number("hand_speed", 0.1, [0.001, 0.2])?,
            hand_force: parameters.number("hand_force", 20.0, [0.0, 70.0])?,
            targets: config.actuators.iter().map(target).collect::<Result<_, _>>()?,
            sensors: config.sensors.iter().map(sensor).collect::<Result<_, _>>()?,
        };
        parameters.finish()?;
        settings.check()?;
        Ok(settings)
    }

    /// What single entries do not show.
    fn check(&self) -> Result<(), Fault> {
        for (k, target) in self.targets.iter().enumerate() {
            if self.targets[..k].contains(target) {
                return Err(refused(format!("two of its actuators have the hdr_id {}", place(*target))));
            }
        }
        let width = self.targets.contains(&Target::Width) || self.sensors.contains(&Quantity::Width);
        if width && !self.hand {
            return Err(refused(
                "its config names the hand's width, but its interface has no hand = true".to_owned(),
            ));
        }
        Ok(())
    }
}

fn place(target: Target) -> usize {
    match target {
        Target::Joint(joint) => joint,
        Target::Width => HAND,
    }
}

fn target(config: &ActuatorConfig) -> Result<Target, Fault> {
    match &config.hardware {
        HardwareId::Number(number) => match usize::try_from(*number) {
            Ok(joint) if joint < JOINTS => Ok(Target::Joint(joint)),
            Ok(HAND) => Ok(Target::Width),
            _ => Err(refused(format!(
                "hdr_id {number} of '{}' is no joint; there are 0 to 6, and 7 for the hand's width",
                config.name
            ))),
        },
        HardwareId::Name(name) if name == "width" => Ok(Target::Width),
        HardwareId::Name(name) => Err(refused(format!(
            "hdr_id '{name}' of '{}' is no joint; there are 0 to 6, and 7 or 'width' for the hand",
            config.name
        ))),
    }
}

fn sensor(config: &SensorConfig) -> Result<Quantity, Fault> {
    let unknown = |what: String| {
        Err(refused(format!(
            "hdr_id {what} of '{}' is no reading; there are 0 to 6 (positions), 7 to 13 (velocities), 'q1', 'dq1', \
             'tau1', 'tau_ext1' and so on to 7, and 'width'",
            config.name
        )))
    };
    match &config.hardware {
        HardwareId::Number(number) => match usize::try_from(*number) {
            Ok(k) if k < JOINTS => Ok(Quantity::Position(k)),
            Ok(k) if k < 2 * JOINTS => Ok(Quantity::Velocity(k - JOINTS)),
            _ => unknown(number.to_string()),
        },
        HardwareId::Name(name) if name == "width" => Ok(Quantity::Width),
        HardwareId::Name(name) => {
            type Make = fn(usize) -> Quantity;
            let kinds: [(&str, Make); 4] = [
                ("tau_ext", Quantity::External),
                ("tau", Quantity::Torque),
                ("dq", Quantity::Velocity),
                ("q", Quantity::Position),
            ];
            let found = kinds.iter().find_map(|(prefix, make)| {
                let joint = name.strip_prefix(prefix)?.parse::<usize>().ok()?;
                (1..=JOINTS).contains(&joint).then(|| make(joint - 1))
            });
            found.map_or_else(|| unknown(format!("'{name}'")), Ok)
        }
    }
}
