//! What a config says of a gripper.

use crate::parameters::Parameters;
use protocol::robotiq::{ADDRESS, FORCES, SPEEDS};
use robot::{DeviceConfig, Fault};

/// Port of the gateway.
const GATEWAY: u16 = 63352;

/// Where the gripper is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Serial { path: String, baud: u32, address: u8 },
    Gateway { host: String, port: u16 },
}

/// Parameters of a gripper.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) place: Place,
    pub(super) speed: f64,
    pub(super) force: f64,
    pub(super) watchdog: f64,
    pub(super) reset_time: f64,
}

impl Settings {
    /// Those of a device.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub(super) fn new(config: &DeviceConfig) -> Result<Settings, Fault> {
        let refused = |why: &str| Err(Fault::Refused(why.to_owned()));
        let mut parameters = Parameters::new(config);
        let (name, host) = (parameters.text("name")?, parameters.text("ip_address")?);
        let baud = parameters.number("baud", 115_200.0, [9600.0, 4.5e6])? as u32;
        let address = parameters.number("slave", f64::from(ADDRESS), [1.0, 247.0])? as u8;
        let place = match (name, host) {
            (Some(path), None) => Place::Serial { path, baud, address },
            (None, Some(host)) => match host.rsplit_once(':') {
                Some((host, port)) if !host.contains(':') => match port.parse() {
                    Ok(port) => Place::Gateway { host: host.to_owned(), port },
                    Err(_) => return refused("the port in its interface's ip_address is no number"),
                },
                _ => Place::Gateway { host, port: GATEWAY },
            },
            _ => {
                return refused(
                    "its interface has either a 'name', the path of a serial port, as '/dev/ttyUSB0', or an \
                     'ip_address', that of the arm's controller",
                );
            }
        };
        let settings = Settings {
            place,
            speed: parameters.number("speed", 0.1, SPEEDS)?,
            force: parameters.number("force", FORCES[0], FORCES)?,
            watchdog: parameters.number("watchdog", 0.25, [0.02, 10.0])?,
            reset_time: parameters.number("reset_time", 2.0, [0.1, 60.0])?,
        };
        parameters.finish()?;
        if config.actuators.len() > 1 {
            return refused(
                "its config has more than one actuator; a gripper has the width between its fingers alone",
            );
        }
        Ok(settings)
    }
}
