//! Feetech servos of the STS series on one serial bus, as the arms SO-100 and SO-101 have them.
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
//! | `acceleration` | the same of its acceleration \[rad/s²\] | 20 |
//! | `watchdog` | longest time without a command \[s\] | 0.25 |
//! | `reset_time` | duration of a reset \[s\] | 5 |
//!
//! These servos have no watchdog of their own: when this process is killed they go to their last goal, no faster than `speed`,
//! and hold it.
//!
//! Source: Feetech's protocol document and memory table, see [`protocol::feetech`]. Proven against the simulated servos of
//! `robohive-wire`, and those against the crate `rustypot`; never tried on a physical servo.

mod bus;
mod driver;

pub use driver::Feetech;
