//! An OptiTrack tracker that sees one rigid body.

use crate::device::{Device, Moment};
use crate::plant::{Plant, PlantError};
use protocol::optitrack::natnet::{self, Bitstream, Frame, ServerInfo, message};
use protocol::optitrack::{Body, robohive};
use robot::{DeviceConfig, HardwareId};

/// Frames a second, as a Prime camera sends them.
const RATE: f64 = 120.0;
/// Ticks of the tracker's clock a second.
const CLOCK: u64 = 10_000_000;
/// The link that frames leave by.
pub const FRAMES: usize = 0;
/// The link of requests and their answers.
pub const REQUESTS: usize = 1;

/// What frames look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// RoboHive's packet of 36 bytes, to whoever listens.
    RoboHive,
    /// NatNet, from the moment on in which a client has connected.
    NatNet,
}

/// Where the body is in the plant.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Seen {
    /// Three slides and three hinges in the order x, y, z, each with the scale and the offset of a config: what a robot
    /// reads is `tracker × scale + offset`.
    Joints([(usize, f64, f64); 6]),
    /// A free joint.
    Free(usize),
}

/// A tracker, and its body.
pub struct Tracker {
    format: Format,
    seen: Seen,
    id: i32,
    hidden: bool,
    bitstream: Bitstream,
    connected: bool,
    number: i32,
    next: f64,
    powered: bool,
}

impl Tracker {
    /// The tracker of a device of a config: its sensors say which joints of the plant the body has.
    ///
    /// # Errors
    /// Sensors that are not six positions of hinges and slides, nor components of the pose of a free joint.
    pub fn of(device: &DeviceConfig, plant: &Plant) -> Result<Tracker, PlantError> {
        let natnet = matches!(device.interface.parameters.get("protocol"), Some(robot::Value::Text(name)) if name == "natnet");
        let id = match device.interface.parameters.get("id") {
            Some(robot::Value::Integer(id)) => *id as i32,
            Some(robot::Value::Text(id)) => id.parse().unwrap_or(1),
            _ => 1,
        };
        Ok(Tracker {
            format: if natnet { Format::NatNet } else { Format::RoboHive },
            seen: seen(device, plant)?,
            id,
            hidden: false,
            bitstream: Bitstream::V41,
            connected: !natnet,
            number: 0,
            next: 0.0,
            powered: true,
        })
    }

    /// Covers the body's markers, or uncovers them.
    pub fn hide(&mut self, hidden: bool) {
        self.hidden = hidden;
    }

    /// The body as the tracker sees it now.
    fn body(&self, plant: &Plant) -> Body {
        let qpos = &plant.data().state.qpos;
        let (position, orientation) = match self.seen {
            Seen::Free(at) => (
                [qpos[at], qpos[at + 1], qpos[at + 2]],
                [qpos[at + 3], qpos[at + 4], qpos[at + 5], qpos[at + 6]],
            ),
            Seen::Joints(joints) => {
                let [x, y, z, a, b, c] =
                    joints.map(|(address, scale, offset)| (qpos[address] - offset) / scale);
                ([x, y, z], protocol::optitrack::quaternion_of_turned([a, b, c]))
            }
        };
        Body { id: self.id, position, orientation, error: 2e-4, tracked: !self.hidden }
    }

    fn say_frame(&mut self, moment: &mut Moment<'_>) {
        self.number += 1;
        let body = self.body(moment.plant);
        let bytes = match self.format {
            Format::RoboHive if self.hidden => return,
            Format::RoboHive => robohive::encode(moment.time, &body).to_vec(),
            Format::NatNet => {
                let frame = Frame { number: self.number, timestamp: moment.time, bodies: vec![body] };
                natnet::message(message::FRAME, &frame.encode(self.bitstream))
            }
        };
        moment.outbox.send(FRAMES, moment.time, bytes);
    }
}

/// Which joints the sensors of a device read.
fn seen(device: &DeviceConfig, plant: &Plant) -> Result<Seen, PlantError> {
    if let Some(sensor) = device.sensors.first()
        && let Some(address) = plant.free_joint(&sensor.name)
    {
        return Ok(Seen::Free(address));
    }
    let mut joints = [None; 6];
    for sensor in &device.sensors {
        let place = match sensor.hardware {
            HardwareId::Number(place @ 0..6) => place as usize,
            _ => {
                return Err(PlantError::new(format!(
                    "the hdr_id of '{}' is not from 0 to 5 (x, y, z and three angles)",
                    sensor.name
                )));
            }
        };
        joints[place] = Some((plant.joint_of_sensor(&sensor.name)?, sensor.scale, sensor.offset));
    }
    let [Some(x), Some(y), Some(z), Some(a), Some(b), Some(c)] = joints else {
        return Err(PlantError::new("a tracked body has six sensors, with the hdr_id 0 to 5"));
    };
    Ok(Seen::Joints([x, y, z, a, b, c]))
}

impl Device for Tracker {
    fn receive(&mut self, moment: &mut Moment<'_>, _channel: usize, bytes: &[u8]) {
        let Some((what, content)) = natnet::open(bytes).filter(|_| self.powered) else { return };
        match what {
            message::CONNECT => {
                self.bitstream = natnet::wanted(content).unwrap_or(Bitstream::V41);
                self.connected = true;
                let info = ServerInfo {
                    version: self.bitstream.version(),
                    clock: CLOCK,
                    data_port: natnet::DATA_PORT,
                    group: None,
                };
                let answer = natnet::message(message::SERVER_INFO, &info.encode());
                moment.outbox.send(REQUESTS, moment.time, answer);
            }
            message::DISCONNECT => self.connected = false,
            message::KEEP_ALIVE => {}
            _ => moment.outbox.send(REQUESTS, moment.time, natnet::message(message::UNRECOGNISED, &[])),
        }
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        if self.powered && self.connected && moment.time >= self.next {
            self.say_frame(moment);
            self.next = moment.time + 1.0 / RATE - 1e-9;
        }
    }

    fn stop_button(&mut self, pressed: bool) {
        self.powered = !pressed;
    }
}
