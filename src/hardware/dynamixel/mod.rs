//! Dynamixel servos with protocol 2.0 on one serial bus.
//!
//! An actuator's `hdr_id` is the id of its servo, and its `mode` is `position` (the default), `extended`, `velocity` or
//! `current`. Commands and readings are in rad (0 to 2π, as the servo counts), rad/s, and A. A sensor with the number of a
//! servo reads its position; a second one with the same number reads its velocity, as RoboHive's driver orders them. A name
//! says it outright: `'12:velocity'`, `'12:current'`, `'12:position'`.
//!
//! | parameter | meaning | default |
//! |---|---|---|
//! | `name` | the serial port | required |
//! | `baud` | bits a second | 1,000,000 |
//! | `safe` | `hold`: it stays where it is with torque; `off`: torque off | `hold` |
//! | `profile_velocity`, `profile_acceleration` | limits of the servo's own motion to a goal \[rad/s, rad/s²\]; 0 is none | the servo's velocity limit; none |
//! | `watchdog` | longest time without a command \[s\] | 0.25 |
//! | `reset_time` | duration of a reset \[s\] | 5 |
//! | `return_delay` | the servo's delay before an answer \[µs\], written where it differs | 0 |
//!
//! The servos' own bus watchdog is set when they are armed: 0.1 s after the last instruction they stop where they are, also
//! when this process was killed. RoboHive's keys `motor_type` and `n` are accepted and not needed.
//!
//! Source: ROBOTIS e-Manual. Proven against the simulated servos of `robohive-wire`; never tried on a physical servo.

mod bus;
mod driver;
mod settings;

pub use driver::Dynamixel;
