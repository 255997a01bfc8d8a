//! What is said to a gripper, on either line.

use crate::port::broken;
use protocol::Port;
use protocol::modbus::{Request, describe_exception, function};
use protocol::robotiq::{Action, INPUT, OUTPUT, Object, Stage, Status};
use robot::Fault;

/// Longest wait for a reply \[s\].
const PATIENCE: f64 = 0.03;
/// Least time between two requests \[s\].
const GAP: f64 = 5e-3;
/// Tries of a request.
const TRIES: usize = 3;

/// A line to a gripper.
pub(super) struct Line {
    port: Box<dyn Port>,
    /// Address on a serial line; `None` where a gateway takes lines of text.
    address: Option<u8>,
    /// When the last reply ended, or should have \[s\].
    last: f64,
    received: Vec<u8>,
}

impl Line {
    pub(super) fn new(port: Box<dyn Port>, address: Option<u8>) -> Line {
        Line { port, address, last: f64::NEG_INFINITY, received: Vec::with_capacity(64) }
    }

    /// Sends bytes and waits until `take` finds a reply in what has come, a few times.
    fn ask<R>(&mut self, bytes: &[u8], mut take: impl FnMut(&[u8]) -> Option<R>) -> Result<R, Fault> {
        let begun = self.port.now();
        let mut buffer = [0; 128];
        for _ in 0..TRIES {
            let early = GAP - (self.port.now() - self.last);
            if early > 0.0 {
                self.port.wait(early);
            }
            self.received.clear();
            self.port.discard().and_then(|()| self.port.send(bytes)).map_err(|error| broken(&error))?;
            let end = self.port.now() + PATIENCE;
            loop {
                let left = end - self.port.now();
                if left <= 0.0 {
                    break;
                }
                let count = self.port.receive(&mut buffer, left).map_err(|error| broken(&error))?;
                self.received.extend_from_slice(&buffer[..count]);
                if let Some(reply) = take(&self.received) {
                    self.last = self.port.now();
                    return Ok(reply);
                }
            }
            self.last = self.port.now();
        }
        Err(Fault::Stale(((self.port.now() - begun) * 1e3).ceil() as u64))
    }

    fn exchange(&mut self, address: u8, request: &Request) -> Result<Vec<u8>, Fault> {
        let answer = self.ask(&request.encode(address), |reply| {
            request.answer(address, reply).map(|answer| answer.map(<[u8]>::to_vec))
        })?;
        answer.map_err(|code| {
            Fault::Refused(format!("the gripper refused a request: {}", describe_exception(code)))
        })
    }

    /// Tells the gripper what to do.
    pub(super) fn command(&mut self, action: Action) -> Result<(), Fault> {
        if let Some(address) = self.address {
            let bytes = action.encode().to_vec();
            return self.exchange(address, &Request::Write { from: OUTPUT, bytes }).map(drop);
        }
        let Action { activate, go, position, speed, force, .. } = action;
        let (activate, go) = (u8::from(activate), u8::from(go));
        let line = format!("SET ACT {activate} GTO {go} POS {position} SPE {speed} FOR {force}\n");
        let accepted = self.ask(line.as_bytes(), |reply| Some(text(reply)? == "ack"))?;
        if accepted { Ok(()) } else { Err(Fault::Refused("the gateway did not take a command".to_owned())) }
    }

    /// What the gripper says.
    pub(super) fn status(&mut self) -> Result<Status, Fault> {
        if let Some(address) = self.address {
            let request = Request::Read { function: function::READ_INPUT, from: INPUT, count: 3 };
            let bytes = self.exchange(address, &request)?;
            let bytes = <[u8; 6]>::try_from(bytes).map_err(|_| Fault::Stale(0))?;
            return Ok(Status::decode(bytes));
        }
        let stage = match self.variable("STA")? {
            3 => Stage::Active,
            1 => Stage::Activating,
            _ => Stage::Reset,
        };
        let object = match self.variable("OBJ")? {
            0 => Object::Moving,
            1 => Object::StoppedOpening,
            2 => Object::StoppedClosing,
            _ => Object::AtPosition,
        };
        let (fault, position) = (self.variable("FLT")?, self.variable("POS")?);
        Ok(Status { activate: stage != Stage::Reset, stage, object, fault, position, ..Status::default() })
    }

    /// The width alone, which a gateway is asked for more cheaply.
    pub(super) fn position(&mut self) -> Result<Status, Fault> {
        if self.address.is_some() {
            return self.status();
        }
        let (fault, position) = (self.variable("FLT")?, self.variable("POS")?);
        Ok(Status { stage: Stage::Active, fault, position, ..Status::default() })
    }

    fn variable(&mut self, name: &str) -> Result<u8, Fault> {
        let line = format!("GET {name}\n");
        self.ask(line.as_bytes(), |reply| {
            let (said, value) = text(reply)?.split_once(' ')?;
            (said == name).then(|| value.trim().parse().ok())?
        })
    }

    pub(super) fn wait(&mut self, seconds: f64) {
        self.port.wait(seconds);
    }

    pub(super) fn now(&self) -> f64 {
        self.port.now()
    }
}

/// A whole line of what has come.
fn text(reply: &[u8]) -> Option<&str> {
    let end = reply.iter().position(|byte| *byte == b'\n')?;
    std::str::from_utf8(&reply[..end]).ok().map(str::trim)
}
