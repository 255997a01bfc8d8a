//! Dynamixel servos with protocol 2.0 or 1.0 on one serial bus.
//!
//! An actuator's `hdr_id` is the id of its servo, and its `mode` is `position` (the default), `extended`, `velocity` or
//! `current`. Commands and readings are in rad (0 to 2π, as the servo counts), rad/s, and A. A sensor with the number of a
//! servo reads its position; a second one with the same number reads its velocity, as RoboHive's driver orders them. A name
//! gives the quantity explicitly: `'12:velocity'`, `'12:current'`, `'12:position'`.
//!
//! | parameter | meaning | default |
//! |---|---|---|
//! | `name` | the serial port | required |
//! | `baud` | bits a second | 1,000,000 |
//! | `protocol` | 2 (series X, and MX with firmware for it) or 1 (AX, RX, MX) | that of `model`, or 2 |
//! | `model` | the model of all servos, such as `'AX-12A'`; others are refused | any of the protocol |
//! | `safe` | `hold`: it stays where it is with torque; `off`: torque off | `hold` |
//! | `profile_velocity` | limit of the servo's own motion to a goal \[rad/s\]; 0 is none | the servo's velocity limit; 3 with protocol 1 |
//! | `profile_acceleration` | limit of its acceleration \[rad/s²\]; not with protocol 1 | none |
//! | `watchdog` | longest time without a command \[s\] | 0.25 |
//! | `reset_time` | duration of a reset \[s\] | 5 |
//! | `return_delay` | the servo's delay before an answer \[µs\], written where it differs | 0 |
//! | `fast_sync_read` | all servos answer in one packet, if every firmware supports it (X430 from 45, X330 from 46) | true |
//!
//! With protocol 2 the servos' own bus watchdog is set when they are armed: 0.1 s after the last instruction they stop where they
//! are, even if this process was killed. RoboHive's keys `motor_type` and `n` are accepted and ignored.
//!
//! # Protocol 1.0
//!
//! Those servos have no watchdog of their own: when this process is killed they go to their last goal, no faster than
//! `profile_velocity`, and hold it. They are read one after the other. AX and RX turn within 300 degrees, so their angles are
//! from 0 to 5.23 rad, with the middle at 2.62. They support position mode only: in wheel mode their command is a share of the output, not a
//! velocity. No current is measured. The next reset clears an alarm whose cause is gone, and restores the torque limit.
//!
//! Source: ROBOTIS e-Manual. Tested against the simulated servos of `robohive-wire`; never tried on a physical servo.

use crate::port::Opener;
use crate::servos::{Make, Servos};
use protocol::dynamixel::{FAMILY, v1};
use robot::{DeviceConfig, Fault};

/// Velocity limit of servos without a register for it \[rad/s\].
const SPEED: f64 = 3.0;

/// The driver of a device; nothing is opened yet.
///
/// # Errors
/// A parameter that is missing or wrong.
pub fn driver(config: &DeviceConfig, opener: Opener) -> Result<Servos, Fault> {
    Servos::new(config, opener, |parameters| {
        parameters.skip(&["motor_type", "n"]);
        let model = parameters.text("model")?.map(|name| known(&name)).transpose()?;
        let protocol =
            parameters.number("protocol", model.map_or(2.0, |(protocol, _)| protocol), [1.0, 2.0])?;
        if protocol.fract() != 0.0 {
            return Err(Fault::Refused(format!(
                "its interface has protocol = {protocol}; there are 1 and 2"
            )));
        }
        if let Some((own, name)) = model
            && own != protocol
        {
            return Err(Fault::Refused(format!(
                "its interface has protocol = {protocol}, which the model '{name}' does not support; remove 'protocol'"
            )));
        }
        let first = protocol == 1.0;
        let otherwise = if first { SPEED } else { -1.0 };
        let speed = parameters.number("profile_velocity", otherwise, [0.0, 100.0])?;
        let acceleration = parameters.number("profile_acceleration", 0.0, [0.0, 1e4])?;
        if first && acceleration != 0.0 {
            return Err(Fault::Refused(
                "its interface has a profile_acceleration, which servos with protocol 1 do not support; remove it"
                    .to_owned(),
            ));
        }
        Ok(Make {
            family: if first { &v1::FAMILY } else { &FAMILY },
            model: model.map(|(_, name)| name),
            speed: (speed >= 0.0).then_some(speed),
            acceleration,
            return_delay: 1e-6 * parameters.number("return_delay", 0.0, [0.0, 508.0])?,
            fast_sync_read: parameters.flag("fast_sync_read", true)?,
            bauds: [9600.0, 4.5e6],
        })
    })
}

/// The protocol of a model of this name, and the name.
fn known(name: &str) -> Result<(f64, &'static str), Fault> {
    let second = FAMILY.kinds.iter().map(|kind| (2.0, kind.name));
    let all = second.chain(v1::FAMILY.kinds.iter().map(|kind| (1.0, kind.name)));
    all.clone().find(|(_, known)| *known == name).ok_or_else(|| {
        let names: Vec<_> = all.map(|(_, known)| known).collect();
        Fault::Refused(format!(
            "its interface has the unknown model '{name}'; the models are {}",
            names.join(", ")
        ))
    })
}
