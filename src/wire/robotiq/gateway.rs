//! A gripper behind the controller of a Universal Robots arm, which passes on lines of text.

use super::gripper::Gripper;
use crate::device::{Device, Moment};

/// Longest line.
const LONGEST: usize = 512;

/// A gripper that is spoken to by `GET POS` and `SET POS 255 SPE 128 GTO 1`.
pub struct Gateway {
    gripper: Gripper,
    line: Vec<u8>,
}

impl Gateway {
    /// The gateway to a gripper.
    pub fn new(gripper: Gripper) -> Gateway {
        Gateway { gripper, line: Vec::new() }
    }

    /// The answer to a line; what is not understood is answered with a question mark.
    fn answer(&mut self, moment: &Moment<'_>, line: &str) -> String {
        self.gripper.hear(moment.time);
        let mut words = line.split_ascii_whitespace();
        let answer = match words.next() {
            Some("GET") => words.next().and_then(|name| {
                self.gripper.variable(moment.plant, name).map(|value| format!("{name} {value}"))
            }),
            Some("SET") => {
                let mut action = Some(self.gripper.action());
                while let (Some(before), Some(name)) = (action, words.next()) {
                    let value = words.next().and_then(|word| word.parse().ok());
                    action = value.and_then(|value| Gripper::with_variable(before, name, value));
                }
                action.map(|action| {
                    self.gripper.command(moment, action);
                    "ack".to_owned()
                })
            }
            _ => None,
        };
        answer.unwrap_or_else(|| "?".to_owned())
    }
}

impl Device for Gateway {
    fn receive(&mut self, moment: &mut Moment<'_>, _channel: usize, bytes: &[u8]) {
        for byte in bytes {
            if *byte != b'\n' {
                self.line.push(*byte);
                self.line.truncate(LONGEST);
                continue;
            }
            let line = String::from_utf8_lossy(&std::mem::take(&mut self.line)).into_owned();
            let answer = self.answer(moment, &line) + "\n";
            moment.outbox.send(0, moment.time, answer.into_bytes());
        }
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        self.gripper.tick(moment);
    }

    fn stop_button(&mut self, _pressed: bool) {
        self.gripper.break_down(0x0A);
    }

    fn connected(&mut self, _moment: &mut Moment<'_>, _channel: usize, _connected: bool) {
        self.line.clear();
    }
}
