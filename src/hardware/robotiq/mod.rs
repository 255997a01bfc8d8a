//! Robotiq 2F-85 grippers: on a serial line by Modbus RTU, or behind the controller of a Universal Robots arm.
//!
//! The one actuator and the sensors of a device are the width between the fingers, from 0 to 0.085 m; RoboHive's scales
//! (sensor −9.81 and 0.834 for the angle of a finger, actuator −0.085 and 0.085 for a share) turn it into what its models have.
//!
//! | parameter | meaning | default |
//! |---|---|---|
//! | `name` | the serial port | one of the two is required |
//! | `ip_address` | of the controller whose gateway leads to the gripper; `host:port` for another port than 63352 | |
//! | `baud`, `slave` | of the serial line: bits a second, and the gripper's address | 115,200, 9 |
//! | `speed` | of the fingers \[m/s\], 0.02 to 0.15 | 0.1 |
//! | `force` | with which they close \[N\], 20 to 235 | 20 |
//! | `watchdog` | longest time without a command \[s\] | 0.25 |
//! | `reset_time` | duration of a reset \[s\] | 2 |
//!
//! A gripper that is not activated is, when the device is armed: its fingers then close and open once, so keep yours out of
//! them. After silence, and when the robot is dropped, the fingers stop where they are and go on holding what they hold;
//! they are never told to open. A fault that ends the activation (supply, overcurrent and the like) is an error that says
//! which, and the next reset activates the gripper again. Requests are at least 5 ms apart.
//!
//! RoboHive reached its gripper by Polymetis, whose speed 0.1 is the fastest here and whose force 0.1 the weakest.
//!
//! Source: Robotiq 2F-85 instruction manual; the gateway's lines as drivers of other people have them. Proven against the
//! simulated gripper of `robohive-wire`; never tried on a physical gripper.

mod driver;
mod line;
mod settings;

pub use driver::Robotiq;
