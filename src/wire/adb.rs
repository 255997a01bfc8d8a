//! An adb server with one headset, whose log says what a script shows.

use crate::device::{Device, Moment};
use protocol::adb::{OKAY, fail, first_text, text};

/// What the headset's app writes before what it shows.
const TAG: &str = "I wE9ryARX: ";
/// Version of the protocol that the server says, in hexadecimal digits.
const VERSION: &str = "0029";

/// A controller as the app shows it: its position \[m\] in the frame of the head, x right, y up, z backward, and the matrix that
/// turns it, row by row; nothing while the headset does not see it.
pub type Seen = Option<([f64; 3], [f64; 9])>;

/// What the app shows for one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// When, after the log was asked for \[s\].
    pub time: f64,
    /// The left and the right controller.
    pub hands: [Seen; 2],
    /// Buttons and axes as the app writes them: `RG,A,rightTrig 0.5`.
    pub buttons: String,
}

impl Shown {
    /// The line of the log.
    fn line(&self) -> String {
        let pose = |(side, hand): (char, &Seen)| {
            hand.as_ref().map(|(at, turn)| {
                let row =
                    |k: usize| format!("{} {} {} {}", turn[3 * k], turn[3 * k + 1], turn[3 * k + 2], at[k]);
                format!("{side}:{} {} {} 0 0 0 1", row(0), row(1), row(2))
            })
        };
        let poses: Vec<String> = ['l', 'r'].into_iter().zip(&self.hands).filter_map(pose).collect();
        let seconds = self.time % 60.0;
        format!("01-01 00:00:{seconds:06.3}  1234  1250 {TAG}{}&{}\n", poses.join("|"), self.buttons)
    }
}

/// Where a connection is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// It asks the server.
    Server,
    /// It asks the headset.
    Headset,
    /// It is the log, which began then \[s\], and has come so far in the script.
    Log(f64, usize),
    /// It was refused, and hears nothing more.
    Over,
}

/// The server, for one connection at a time.
pub struct Server {
    serial: String,
    script: Vec<Shown>,
    /// Time after which the script begins again \[s\].
    period: Option<f64>,
    heard: Vec<u8>,
    phase: Phase,
}

impl Server {
    /// A server with a headset of this serial number, which shows the script, in the order of its times, to whoever reads
    /// its log.
    pub fn new(serial: &str, mut script: Vec<Shown>) -> Self {
        script.sort_by(|a, b| a.time.total_cmp(&b.time));
        Server { serial: serial.to_owned(), script, period: None, heard: Vec::new(), phase: Phase::Server }
    }

    /// Repeats the script with this period \[s\].
    #[must_use]
    pub fn with_period(mut self, seconds: f64) -> Self {
        self.period = Some(seconds);
        self
    }

    /// Answers a request.
    fn answer(&mut self, time: f64, request: &str) -> Vec<u8> {
        let any = ["host:transport-any", "host:transport-usb"].contains(&request);
        let named = request.strip_prefix("host:transport:");
        match (self.phase, request) {
            (Phase::Server, "host:version") => [&OKAY[..], &text(VERSION)].concat(),
            (Phase::Server, "host:devices") => {
                [&OKAY[..], &text(&format!("{}\tdevice\n", self.serial))].concat()
            }
            (Phase::Server, _) if any || named == Some(&self.serial[..]) => {
                self.phase = Phase::Headset;
                OKAY.to_vec()
            }
            (Phase::Headset, _) if request.starts_with("shell:") && request.contains("logcat") => {
                self.phase = Phase::Log(time, 0);
                OKAY.to_vec()
            }
            _ => {
                self.phase = Phase::Over;
                fail(&named.map_or_else(
                    || "unknown host service".to_owned(),
                    |serial| format!("device '{serial}' not found"),
                ))
            }
        }
    }
}

impl Device for Server {
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]) {
        self.heard.extend_from_slice(bytes);
        while matches!(self.phase, Phase::Server | Phase::Headset) {
            let answer = match first_text(&self.heard) {
                Ok(None) => return,
                Ok(Some((request, length))) => {
                    self.heard.drain(..length);
                    self.answer(moment.time, &request)
                }
                Err(_) => {
                    self.phase = Phase::Over;
                    fail("invalid request")
                }
            };
            moment.outbox.send(channel, moment.time, answer);
        }
        self.heard.clear();
    }

    fn tick(&mut self, _: &mut Moment<'_>) {}

    fn stop_button(&mut self, _: bool) {}

    fn due(&self) -> f64 {
        match self.phase {
            Phase::Log(begun, next) => {
                self.script.get(next).map_or(f64::INFINITY, |shown| begun + shown.time)
            }
            _ => f64::INFINITY,
        }
    }

    fn work(&mut self, moment: &mut Moment<'_>) {
        let Phase::Log(begun, next) = self.phase else { return };
        let Some(shown) = self.script.get(next) else { return };
        moment.outbox.send(0, moment.time, shown.line().into_bytes());
        self.phase = match self.period {
            Some(period) if next + 1 == self.script.len() => Phase::Log(begun + period, 0),
            _ => Phase::Log(begun, next + 1),
        };
    }

    fn connected(&mut self, _: &mut Moment<'_>, _: usize, _: bool) {
        (self.phase, self.heard) = (Phase::Server, Vec::new());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_what_the_app_writes() {
        let turn = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0];
        let shown = Shown {
            time: 61.25,
            hands: [None, Some(([0.25, -0.5, 0.125], turn))],
            buttons: "R,RG,rightTrig 0.5".to_owned(),
        };
        assert_eq!(
            shown.line(),
            "01-01 00:00:01.250  1234  1250 I wE9ryARX: r:1 0 0 0.25 0 0 -1 -0.5 0 1 0 0.125 0 0 0 1&R,RG,rightTrig 0.5\n"
        );
        assert!(Shown::default().line().ends_with("wE9ryARX: &\n"));
    }

    #[test]
    fn requests_are_answered_as_adb_answers_them() {
        let mut server = Server::new("1WMHH", Vec::new());
        assert_eq!(server.answer(0.0, "host:version"), b"OKAY00040029");
        assert_eq!(server.answer(0.0, "host:devices"), b"OKAY000d1WMHH\tdevice\n");
        assert_eq!(server.answer(0.0, "host:transport:1WMHH"), b"OKAY");
        assert_eq!(server.answer(2.5, "shell:logcat -T 1"), b"OKAY");
        assert_eq!(server.phase, Phase::Log(2.5, 0));
        let mut other = Server::new("1WMHH", Vec::new());
        assert_eq!(other.answer(0.0, "host:transport:2"), b"FAIL0014device '2' not found");
        assert_eq!(Server::new("1", Vec::new()).answer(0.0, "host:kill"), b"FAIL0014unknown host service");
    }
}
