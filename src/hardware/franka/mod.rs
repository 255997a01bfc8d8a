//! Franka arms over the Franka Control Interface: Panda (version 5 of the interface) and FR3 (version 10).
//!
//! An actuator's `hdr_id` is the number of its joint, 0 to 6, and 7 is the hand's width; commands are positions in rad and m.
//! A sensor's is 0 to 6 for a joint's position, 7 to 13 for its velocity (as RoboHive's driver orders them), or a name:
//! `q1` to `q7` \[rad\], `dq1` to `dq7` \[rad/s\], `tau1` to `tau7` (measured) and `tau_ext1` to `tau_ext7` (from outside)
//! \[N m\], `width` \[m\]. What lies between the fingers of a model and the width is the config's `scale`: a finger moves half
//! the width.
//!
//! | parameter | meaning | default |
//! |---|---|---|
//! | `ip_address` | of the arm, or its name; `host:port` for another port than 1337 | required |
//! | `control` | `impedance`: torques from here, as RoboHive has them; `position`: the arm's own joint position control | `impedance` |
//! | `gain_scale` | of the stiffness 40 30 50 25 35 25 10 N m/rad and the damping 4 6 5 5 3 2 1 N m s/rad | 1 |
//! | `reset_gain_scale` | the same, on the way to where an episode begins | 1 |
//! | `interpolation` | `smooth`: targets become a motion within the arm's limits; `none`: targets jump, which only an arm at a loopback address is sent | `smooth` |
//! | `version` | of the interface, 5 or 10; 0 finds out | 0 |
//! | `collision_torque`, `collision_force` | contacts that stop the arm \[N m, N\] | 40, 40 |
//! | `box` | `[x low, x high, y low, y high, z low, z high]` of the end effector, in the frame of the arm's base \[m\] | none |
//! | `tool` | from the flange to the point that the box is for, along the flange's axis \[m\] | 0.1034 with `hand`, else 0 |
//! | `watchdog` | longest time without a command \[s\] | 0.25 |
//! | `reset_time` | duration of a reset \[s\] | 5 |
//! | `hand` | there is a Franka Hand | false |
//! | `hand_port` | of the hand's server | 1338 |
//! | `hand_speed`, `hand_force` | of the fingers, and when they close on something (to 5 mm or less) \[m/s, N\] | 0.1, 20 |
//!
//! # The box
//!
//! A command whose end effector would be outside of the `box` is refused before anything reaches the wire, with where it would
//! be; so is a motion on whose way it would come to rest outside, as joints that turn between two places inside may pass
//! outside. Either way the arm comes to rest, and the next reset goes on. An arm that begins outside may come nearer to the
//! box.
//!
//! # The loop
//!
//! The arm says its state a thousand times a second and stops when twenty answers are missing. The driver's own loop, a thread
//! that looks four times a millisecond, answers each with the next point of a motion towards the newest target: velocity,
//! acceleration and jerk of every joint stay within the arm's limits (at most four fifths of the acceleration and a fifth of
//! the jerk, and three lost packets less than the velocity), also where it turns back half-way, and where the network loses a
//! packet. It follows its target by 8 ms. It begins where the arm was last commanded
//! to be, and ends at rest.
//!
//! | silence of the arm | what happens |
//! |---|---|
//! | 3 ms | a line in the record |
//! | 10 ms | the motion comes to rest with the greatest deceleration |
//! | 20 ms | `StopMove`, and the device is in its safe state |
//!
//! A reflex, the stop button and an end of the connection are faults that name what the arm says. The next reset connects
//! again, recovers from the error, and begins at the arm's commanded position; while the stop button is pressed it refuses.
//!
//! Sources: see [`protocol::franka`]; stiffness and damping: the defaults of Polymetis, which RoboHive used. Proven against
//! the simulated arm of `robohive-wire`, and that against the crate `franka-rs`; never tried on a physical arm. A machine that
//! answers in time needs a kernel with real-time scheduling and the arm on a network of its own.

mod driver;
mod generator;
mod hand;
mod link;
mod settings;
mod workspace;

pub use driver::Franka;
