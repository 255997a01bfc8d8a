//! Feetech servos of the STS series on one serial bus, as in the arms SO-100 and SO-101.
//!
//! An actuator's `hdr_id` is the id of its servo, and its `mode` is `position` (the default) or `velocity`. Commands and readings
//! are in rad (0 to 2π, as the servo counts), rad/s, and A. Sensors are named as those of [`dynamixel`](crate::dynamixel).
//!
//! | parameter | meaning | default |
//! |---|---|---|
//! | `name` | the serial port | required |
//! | `baud` | bits a second | 1,000,000 |
//! | `safe` | `hold`: it stays where it is with torque; `off`: torque off | `hold` |
//! | `speed` | limit of the servo's own motion to a goal \[rad/s\]; 0 is none | 3 |
//! | `acceleration` | limit of its acceleration \[rad/s²\] | 20 |
//! | `watchdog` | longest time without a command \[s\] | 0.25 |
//! | `reset_time` | duration of a reset \[s\] | 5 |
//!
//! These servos have no watchdog of their own: when this process is killed they go to their last goal, no faster than `speed`,
//! and hold it.
//!
//! Source: Feetech's protocol document and memory table, see [`protocol::feetech`]. Tested against the simulated servos of
//! `robohive-wire`, and those against the crate `rustypot`; never tried on a physical servo.

use crate::port::Opener;
use crate::servos::{Make, Servos};
use protocol::feetech::FAMILY;
use robot::{DeviceConfig, Fault};

/// The driver of a device; nothing is opened yet.
///
/// # Errors
/// A parameter that is missing or wrong.
pub fn driver(config: &DeviceConfig, opener: Opener) -> Result<Servos, Fault> {
    Servos::new(config, opener, |parameters| {
        Ok(Make {
            family: &FAMILY,
            model: None,
            speed: Some(parameters.number("speed", 3.0, [0.0, 20.0])?),
            acceleration: parameters.number("acceleration", 20.0, [0.0, 39.0])?,
            return_delay: 0.0,
            fast_sync_read: false,
            bauds: [19_200.0, 1e6],
        })
    })
}
