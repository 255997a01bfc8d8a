//! A CyberGlove on a hand that a script moves.

use crate::device::{Device, Moment};
use protocol::cyberglove::{BAUD, GloveError, RESET, SAMPLE, STOP, STREAM, sample};

/// Samples a second, until a command says otherwise.
const RATE: f64 = 90.0;

/// What every sensor measures at a time \[s\].
pub type Worn = Box<dyn Fn(f64) -> Vec<u8> + Send>;

/// A glove, and who wears it. The stop button pulls it out of its interface.
pub struct Glove {
    sensors: u8,
    worn: Worn,
    heard: Vec<u8>,
    period: f64,
    /// When the next sample of a stream is due \[s\].
    next: Option<f64>,
    plugged: bool,
}

impl Glove {
    /// A glove with 18 or 22 sensors, which measure this.
    pub fn new(sensors: u8, worn: Worn) -> Self {
        Glove { sensors, worn, heard: Vec::new(), period: 1.0 / RATE, next: None, plugged: true }
    }

    fn measured(&self, letter: u8, time: f64) -> Vec<u8> {
        if self.plugged {
            sample(letter, &(self.worn)(time))
        } else {
            vec![b'e', GloveError::Unplugged.letter()]
        }
    }

    /// Answers the first command that is there, and how many bytes it has; `None` while its end is missing.
    fn answer(&mut self, time: f64) -> Option<(Vec<u8>, usize)> {
        Some(match *self.heard.as_slice() {
            [] => return None,
            [STOP, ..] => {
                self.next = None;
                (Vec::new(), 1)
            }
            [RESET, ..] => {
                (self.next, self.period) = (None, 1.0 / RATE);
                (vec![RESET, 0], 1)
            }
            [SAMPLE, ..] => (self.measured(SAMPLE, time), 1),
            [STREAM, ..] => {
                self.next = Some(time + self.period);
                (Vec::new(), 1)
            }
            [b'?', b'S', ..] => (vec![b'?', b'S', self.sensors, 0], 2),
            [b'?', _, ..] => (vec![b'e', GloveError::Unknown.letter()], 2),
            [b'T', high, low, more, times, ..] => {
                let ticks =
                    f64::from(u16::from_be_bytes([high, low])) * f64::from(u16::from_be_bytes([more, times]));
                let period = ticks / f64::from(BAUD);
                // A sample takes longer on the line.
                let least = 10.0 * f64::from(self.sensors + 2) / f64::from(BAUD);
                if period < least {
                    (vec![b'e', GloveError::Rate.letter()], 5)
                } else {
                    self.period = period;
                    (vec![b'T', 0], 5)
                }
            }
            [b'?'] | [b'T', ..] => return None,
            _ => (vec![b'e', GloveError::Unknown.letter()], 1),
        })
    }
}

impl Device for Glove {
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]) {
        self.heard.extend_from_slice(bytes);
        while let Some((answer, length)) = self.answer(moment.time) {
            self.heard.drain(..length);
            if !answer.is_empty() {
                moment.outbox.send(channel, moment.time, answer);
            }
        }
    }

    fn tick(&mut self, _: &mut Moment<'_>) {}

    fn stop_button(&mut self, pressed: bool) {
        self.plugged = !pressed;
    }

    fn due(&self) -> f64 {
        self.next.unwrap_or(f64::INFINITY)
    }

    fn work(&mut self, moment: &mut Moment<'_>) {
        moment.outbox.send(0, moment.time, self.measured(STREAM, moment.time));
        self.next = Some(moment.time + self.period);
    }
}
