//! OptiTrack: the pose of one rigid body, from NatNet or from RoboHive's own server.
//!
//! A sensor's `hdr_id` is 0 to 5 for x, y, z \[m\] and the three angles that RoboHive makes of the orientation \[rad\], or one of
//! the names `x`, `y`, `z`, `qw`, `qx`, `qy`, `qz`.
//!
//! | parameter | meaning | default |
//! |---|---|---|
//! | `protocol` | `robohive`: datagrams of 36 bytes; `natnet`: NatNet 3.0 or 4.1 | `robohive` |
//! | `server_name` | the machine that sends | required |
//! | `port` | port of this machine at which RoboHive's packets arrive | 5000 |
//! | `id` | number of the rigid body | 1 |
//! | `multicast` | NatNet frames come to the group that the server names, instead of to this machine alone | false |
//!
//! A frame that is more than 0.2 m or 0.5 rad from the one before it is refused; after the body was lost, ten good frames must
//! follow each other. After a reset, when a person may have moved the body, the next frame is accepted at any pose. Without a frame for 50 ms the reading is stale. RoboHive's keys `client_name`, `packet_size` and
//! `data_type` are accepted and not needed.
//!
//! Source: NatNet SDK documentation; RoboHive 0.7, `hardware_optitrack.py`. Proven against the simulated tracker of
//! `robohive-wire`; never tried with a physical one.

use crate::driver::Driver;
use crate::parameters::Parameters;
use crate::port::Sockets;
use crate::safety::limits::Limits;
use crate::safety::watchdog::Timeouts;
use protocol::Port;
use protocol::optitrack::natnet::{self, Bitstream, COMMAND_PORT, DATA_PORT, Frame, ServerInfo, message};
use protocol::optitrack::{Body, robohive, turned_angles};
use robot::{DeviceConfig, Fault, HardwareId};
use std::io;
use std::net::Ipv4Addr;
use std::sync::Arc;

/// Without a frame for this long the pose is stale \[s\].
const STALE: f64 = 0.05;
/// Largest step between two frames \[m, rad\].
const JUMP: [f64; 2] = [0.2, 0.5];
/// Good frames that must follow each other after the body was lost.
const GOOD: u32 = 10;
/// Longest wait for a server, and for the first frame \[s\].
const PATIENCE: f64 = 1.0;
/// Time between two keep-alives \[s\].
const KEEP_ALIVE: f64 = 1.0;

/// A number of a pose: 0 to 2 the position, 3 to 5 RoboHive's angles, 6 to 9 the quaternion w-x-y-z.
type Quantity = usize;

const NAMES: [(&str, Quantity); 7] =
    [("x", 0), ("y", 1), ("z", 2), ("qw", 6), ("qx", 7), ("qy", 8), ("qz", 9)];

/// How frames come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Source {
    RoboHive { port: u16 },
    NatNet { multicast: bool },
}

/// Links that are open.
struct Links {
    frames: Box<dyn Port>,
    /// To NatNet's server.
    requests: Option<Box<dyn Port>>,
    bitstream: Bitstream,
    kept_alive: f64,
}

/// One rigid body of a tracker, see [the module](self).
pub struct OptiTrack {
    server: String,
    source: Source,
    id: i32,
    sensors: Vec<Quantity>,
    sockets: Arc<dyn Sockets>,
    links: Option<Links>,
    buffer: Vec<u8>,
    /// The newest good frame, and when it came.
    seen: Option<(f64, Body)>,
    /// Frames that followed each other well.
    good: u32,
    /// The number of another body that was seen.
    other: Option<i32>,
}

fn refused(why: String) -> Fault {
    Fault::Refused(why)
}

impl OptiTrack {
    /// The driver of a device; nothing is opened yet.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub fn new(config: &DeviceConfig, sockets: Arc<dyn Sockets>) -> Result<OptiTrack, Fault> {
        let mut parameters = Parameters::new(config);
        let server = parameters.text("server_name")?;
        let server = server.ok_or_else(|| {
            refused("its interface has no 'server_name', the machine that the tracker runs on".to_owned())
        })?;
        let port = parameters.number("port", 5000.0, [1.0, 65_535.0])? as u16;
        let multicast = parameters.flag("multicast", false)?;
        let source = match parameters.choice("protocol", &["robohive", "natnet"])? {
            0 => Source::RoboHive { port },
            _ => Source::NatNet { multicast },
        };
        let id = parameters.whole("id", 1)?;
        parameters.skip(&["client_name", "packet_size", "data_type"]);
        parameters.finish()?;
        if let Some(actuator) = config.actuators.first() {
            return Err(refused(format!(
                "a tracker moves nothing, and it has the actuator '{}'",
                actuator.name
            )));
        }
        let quantity = |sensor: &robot::SensorConfig| {
            let found = match &sensor.hardware {
                HardwareId::Number(place @ 0..6) => Some(*place as usize),
                HardwareId::Number(_) => None,
                HardwareId::Name(name) => NAMES.iter().find(|(known, _)| known == name).map(|(_, q)| *q),
            };
            found.ok_or_else(|| {
                refused(format!(
                    "the hdr_id of '{}' is not 0 to 5, nor x, y, z, qw, qx, qy or qz",
                    sensor.name
                ))
            })
        };
        Ok(OptiTrack {
            server,
            source,
            id,
            sensors: config.sensors.iter().map(quantity).collect::<Result<_, _>>()?,
            sockets,
            links: None,
            buffer: vec![0; natnet::MAX],
            seen: None,
            good: GOOD,
            other: None,
        })
    }

    fn unreachable(&self, error: &io::Error) -> Fault {
        Fault::Unreachable(format!("the tracker at {}: {error}", self.server))
    }

    fn open(&self) -> Result<Links, Fault> {
        let failed = |error| self.unreachable(&error);
        let (port, multicast) = match self.source {
            Source::RoboHive { port } => {
                let frames = self.sockets.listen(&self.server, port, None).map_err(failed)?;
                return Ok(Links { frames, requests: None, bitstream: Bitstream::V3, kept_alive: 0.0 });
            }
            Source::NatNet { multicast } => (DATA_PORT, multicast),
        };
        let (mut requests, _) = self.sockets.datagrams(&self.server, COMMAND_PORT).map_err(failed)?;
        let info = self.ask(requests.as_mut())?;
        let bitstream = Bitstream::of(info.version).ok_or_else(|| {
            let [major, minor, ..] = info.version;
            refused(format!("the tracker sends NatNet {major}.{minor}; known are 3.0 and 4.1"))
        })?;
        let group = info.group.filter(|_| multicast).map(Ipv4Addr::from);
        let frames = self.sockets.listen(&self.server, port, group).map_err(failed)?;
        let kept_alive = frames.now();
        Ok(Links { frames, requests: Some(requests), bitstream, kept_alive })
    }

    /// Asks the server for its frames, and what they look like.
    fn ask(&self, port: &mut dyn Port) -> Result<ServerInfo, Fault> {
        let failed = |error| self.unreachable(&error);
        let hello = natnet::message(message::CONNECT, &natnet::connect(Bitstream::V41));
        let mut buffer = [0; 2048];
        let end = port.now() + PATIENCE;
        while port.now() < end {
            port.send(&hello).map_err(failed)?;
            let count = port.receive(&mut buffer, PATIENCE / 4.0).map_err(failed)?;
            if let Some((message::SERVER_INFO, content)) = natnet::open(&buffer[..count])
                && let Some(info) = ServerInfo::decode(content)
            {
                return Ok(info);
            }
        }
        Err(Fault::Unreachable(format!(
            "no NatNet server answers at {}:{COMMAND_PORT}; switch streaming on in Motive, and check its interface",
            self.server
        )))
    }

    /// Takes all frames that have come.
    fn take(&mut self) -> Result<(), Fault> {
        loop {
            let Some(links) = &mut self.links else { return Err(Fault::NotConnected) };
            let received = links.frames.receive(&mut self.buffer, 0.0);
            let count = match received {
                Ok(0) => break,
                Ok(count) => count,
                Err(error) => return Err(self.unreachable(&error)),
            };
            let now = links.frames.now();
            let bytes = &self.buffer[..count];
            let body = match self.source {
                Source::RoboHive { .. } => robohive::decode(bytes).map(|(_, body)| body),
                Source::NatNet { .. } => natnet::open(bytes)
                    .filter(|(what, _)| *what == message::FRAME)
                    .and_then(|(_, content)| Frame::decode(content, links.bitstream))
                    .and_then(|frame| frame.bodies.into_iter().find(|body| body.id == self.id)),
            };
            match body {
                Some(body) if body.id == self.id => self.see(now, body),
                Some(body) => self.other = Some(body.id),
                None => {}
            }
        }
        self.keep_alive()
    }

    fn keep_alive(&mut self) -> Result<(), Fault> {
        let Some(Links { frames, requests: Some(requests), kept_alive, .. }) = &mut self.links else {
            return Ok(());
        };
        let now = frames.now();
        if now - *kept_alive < KEEP_ALIVE {
            return Ok(());
        }
        *kept_alive = now;
        let sent = requests.send(&natnet::message(message::KEEP_ALIVE, &[]));
        sent.map_err(|error| self.unreachable(&error))
    }

    /// Takes the next frame of the body, wherever it was before.
    fn first_frame(&mut self) -> Result<(), Fault> {
        (self.seen, self.good, self.other) = (None, GOOD, None);
        let end = self.links.as_ref().map_or(0.0, |links| links.frames.now()) + PATIENCE;
        loop {
            self.take()?;
            let Some(links) = &mut self.links else { return Err(Fault::NotConnected) };
            if self.seen.is_some() {
                return Ok(());
            }
            if links.frames.now() >= end {
                break;
            }
            links.frames.wait(STALE / 5.0);
        }
        let (id, server) = (self.id, &self.server);
        Err(Fault::Unreachable(match self.other {
            Some(other) => format!(
                "{server} sends the rigid body {other} and none with the id {id}; set 'id' of its interface"
            ),
            None => format!(
                "no frame of the rigid body {id} came from {server} in {PATIENCE} s; check that it is streamed, and that \
                 no firewall stops it"
            ),
        }))
    }

    /// Takes a frame's pose, unless the body is not in it, or has leapt.
    fn see(&mut self, now: f64, body: Body) {
        let finite = body.position.iter().chain(&body.orientation).all(|value| value.is_finite());
        if !body.tracked || !finite {
            self.good = 0;
            return;
        }
        if let Some((last, before)) = &self.seen
            && leapt(before, &body)
            && now - last < STALE
        {
            self.good = 0;
            return;
        }
        self.good = (self.good + 1).min(GOOD);
        if self.good == GOOD || self.seen.is_none() {
            self.seen = Some((now, body));
        }
    }
}

/// Whether a body cannot have moved so far from one frame to the next.
fn leapt(before: &Body, after: &Body) -> bool {
    let distance: f64 = before.position.iter().zip(after.position).map(|(a, b)| (a - b).powi(2)).sum();
    let alike: f64 = before.orientation.iter().zip(after.orientation).map(|(a, b)| a * b).sum();
    distance.sqrt() > JUMP[0] || 2.0 * alike.abs().min(1.0).acos() > JUMP[1]
}

impl Driver for OptiTrack {
    fn connect(&mut self) -> Result<(), Fault> {
        self.links = Some(self.open()?);
        self.first_frame()
    }

    fn moved(&mut self) -> Result<(), Fault> {
        let Some(links) = &mut self.links else { return Err(Fault::NotConnected) };
        let discarded = links.frames.discard();
        discarded.map_err(|error| self.unreachable(&error))?;
        self.first_frame()
    }

    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault> {
        self.take()?;
        let now = self.links.as_ref().map_or(0.0, |links| links.frames.now());
        let Some((came, body)) = &self.seen else { return Err(Fault::Stale(0)) };
        if now - came > STALE {
            return Err(Fault::Stale(((now - came) * 1e3) as u64));
        }
        let angles = turned_angles(body.orientation);
        let all: Vec<_> = body.position.into_iter().chain(angles).chain(body.orientation).collect();
        for (value, quantity) in values.iter_mut().zip(&self.sensors) {
            *value = all[*quantity];
        }
        Ok(())
    }

    fn present(&mut self, _commands: &mut [f64]) -> Result<(), Fault> {
        Ok(())
    }

    fn arm(&mut self, _present: &[f64]) -> Result<(), Fault> {
        Ok(())
    }

    fn command(&mut self, _commands: &[f64]) -> Result<(), Fault> {
        Ok(())
    }

    fn make_safe(&mut self) -> Result<bool, Fault> {
        Ok(true)
    }

    fn disconnect(&mut self) {
        if let Some(Links { requests: Some(requests), .. }) = &mut self.links {
            // A server that does not hear it notices by itself.
            requests.send(&natnet::message(message::DISCONNECT, &[])).unwrap_or_default();
        }
        self.links = None;
    }

    fn limits(&self) -> Vec<Limits> {
        Vec::new()
    }

    fn timeouts(&self) -> Timeouts {
        Timeouts { command: f64::INFINITY, reading: STALE, heartbeat: STALE / 2.5 }
    }

    fn resource(&self) -> String {
        match self.source {
            Source::RoboHive { port } => format!("UDP port {port}"),
            Source::NatNet { .. } => format!("UDP port {DATA_PORT}"),
        }
    }
}
