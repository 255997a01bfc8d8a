//! A gripper on a serial line.

use super::gripper::Gripper;
use crate::device::{Device, Moment};
use protocol::modbus::{Request, function, refusal};
use protocol::robotiq::{Action, INPUT, OUTPUT};

/// Silence between a request and its reply: 3.5 bytes at 19 200 bits a second, as Modbus has it for faster lines \[s\].
const PAUSE: f64 = 1.75e-3;
/// Bytes that come later than this after those before them begin another frame \[s\].
const GAP: f64 = 5e-3;

/// A gripper that is spoken to by Modbus RTU.
pub struct Rtu {
    gripper: Gripper,
    address: u8,
    bytes: Vec<u8>,
    last: f64,
    powered: bool,
}

impl Rtu {
    /// A gripper with an address.
    pub fn new(gripper: Gripper, address: u8) -> Rtu {
        Rtu { gripper, address, bytes: Vec::new(), last: 0.0, powered: true }
    }

    fn answer(&mut self, moment: &Moment<'_>, request: &Request) -> Vec<u8> {
        self.gripper.hear(moment.time);
        match request {
            Request::Read { from: INPUT, count: count @ 1..=6, .. } => {
                let mut bytes = self.gripper.status(moment.plant).encode().to_vec();
                bytes.resize(2 * usize::from(*count), 0);
                request.reply(self.address, &bytes)
            }
            Request::Read { function, .. } => refusal(self.address, *function, 2),
            Request::Write { from: OUTPUT, bytes } => match <[u8; 6]>::try_from(&bytes[..]) {
                Ok(bytes) => {
                    self.gripper.command(moment, Action::decode(bytes));
                    request.reply(self.address, &[])
                }
                Err(_) => refusal(self.address, function::WRITE_MULTIPLE, 3),
            },
            Request::Write { .. } => refusal(self.address, function::WRITE_MULTIPLE, 2),
            Request::Unknown(function) => refusal(self.address, *function, 1),
        }
    }
}

impl Device for Rtu {
    fn receive(&mut self, moment: &mut Moment<'_>, _channel: usize, bytes: &[u8]) {
        if moment.time - self.last > GAP {
            self.bytes.clear();
        }
        self.last = moment.time;
        self.bytes.extend_from_slice(bytes);
        while let Some(decoded) = Request::decode(&self.bytes) {
            let Ok((address, request, length)) = decoded else {
                // Nobody answers what cannot be understood.
                self.bytes.clear();
                return;
            };
            self.bytes.drain(..length);
            if address == self.address && self.powered {
                let reply = self.answer(moment, &request);
                moment.outbox.send(0, moment.time + PAUSE, reply);
            }
        }
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        if self.powered {
            self.gripper.tick(moment);
        }
    }

    fn stop_button(&mut self, pressed: bool) {
        // It cuts the power: the fingers stay, and must be activated again.
        self.powered = !pressed;
        self.gripper.break_down(0x0A);
    }
}
