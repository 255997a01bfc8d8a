//! The driver's side of a hand.

use super::link::Channel;
use super::settings::Settings;
use crate::port::Sockets;
use protocol::franka::hand::{EPSILON, State, VERSION, command, payload, status};
use robot::Fault;

/// Without a state for this long the hand is gone \[s\].
const SILENCE: f64 = 1.0;
/// Least time between two commands \[s\].
const PERIOD: f64 = 0.1;
/// Widths that are the same \[m\].
const SAME: f64 = 5e-4;
/// At this width and below the fingers close on something with the hand's force \[m\].
const CLOSED: f64 = 5e-3;
/// Longest that homing takes \[s\].
const HOMING: f64 = 20.0;

/// A connection to a hand.
pub(super) struct Hand {
    channel: Channel,
    pub(super) state: State,
    received: Option<f64>,
    speed: f64,
    force: f64,
    /// Its last commanded width \[m\].
    told: Option<f64>,
    wanted: f64,
    sent: f64,
    pending: Vec<(u32, u16)>,
}

impl Hand {
    pub(super) fn open(sockets: &dyn Sockets, settings: &Settings) -> Result<Hand, Fault> {
        let mut channel = Channel::open(sockets, &settings.host, settings.hand_port, true)?;
        let (fits, own) = channel.greet(VERSION)?;
        if !fits {
            return Err(Fault::Refused(format!(
                "the hand speaks version {own} of its interface, and not {VERSION}"
            )));
        }
        let mut hand = Hand {
            channel,
            state: State::default(),
            received: None,
            speed: settings.hand_speed,
            force: settings.hand_force,
            told: None,
            wanted: 0.0,
            sent: f64::NEG_INFINITY,
            pending: Vec::new(),
        };
        let end = hand.channel.now() + SILENCE;
        while hand.received.is_none() {
            if hand.channel.now() > end {
                return Err(Fault::Unreachable("the hand does not say its state".to_owned()));
            }
            hand.channel.listen(1e-3)?;
            hand.pump()?;
        }
        Ok(hand)
    }

    /// Takes what has come.
    pub(super) fn pump(&mut self) -> Result<(), Fault> {
        self.channel.listen(0.0)?;
        loop {
            let bytes = self.channel.datagram()?;
            if bytes.is_empty() {
                break;
            }
            let Some(state) = State::decode(bytes) else { continue };
            let sound = (-0.01..=0.2).contains(&state.width) && (0.0..=0.2).contains(&state.max_width);
            if sound && (self.received.is_none() || state.message > self.state.message) {
                self.state = state;
                self.received = Some(self.channel.now());
            }
        }
        Ok(())
    }

    /// Finds the largest width, where the hand does not know it.
    pub(super) fn home(&mut self) -> Result<(), Fault> {
        if self.state.max_width > 0.0 {
            return Ok(());
        }
        let id = self.channel.request(u32::from(command::HOMING), &[])?;
        let end = self.channel.now() + HOMING;
        loop {
            self.channel.listen(0.01)?;
            self.pump()?;
            match self.channel.reply(id).and_then(|payload| payload.first().copied()).map(u16::from) {
                Some(status::SUCCESS) => break,
                Some(_) => {
                    return Err(Fault::Hardware("the hand could not find its largest width".to_owned()));
                }
                None if self.channel.now() > end => {
                    return Err(Fault::Unreachable("the hand does not end its homing".to_owned()));
                }
                None => {}
            }
        }
        let end = self.channel.now() + SILENCE;
        while self.state.max_width == 0.0 && self.channel.now() < end {
            self.channel.listen(0.01)?;
            self.pump()?;
        }
        Ok(())
    }

    /// Begins where the fingers are.
    pub(super) fn begin(&mut self) {
        self.wanted = self.state.width;
        self.told = Some(self.state.width);
    }

    pub(super) fn aim(&mut self, width: f64) {
        self.wanted = width.clamp(0.0, self.state.max_width.max(0.0));
    }

    /// Tells the fingers where to go, when that has changed.
    pub(super) fn work(&mut self) -> Result<(), Fault> {
        self.pump()?;
        let now = self.channel.now();
        let silence = now - self.received.unwrap_or(now);
        if silence > SILENCE {
            return Err(Fault::Unreachable(format!("the hand has sent no state for {silence:.1} s")));
        }
        let mut failed = false;
        let channel = &mut self.channel;
        self.pending.retain(|(id, _)| match channel.reply(*id) {
            None => true,
            Some(payload) => {
                failed |= payload.first() == Some(&(status::FAIL as u8));
                false
            }
        });
        if failed {
            return Err(Fault::Hardware("the hand could not carry out a command".to_owned()));
        }
        let changed = self.told.is_none_or(|told| (told - self.wanted).abs() > SAME);
        if !changed || now - self.sent < PERIOD {
            return Ok(());
        }
        let closing = self.wanted <= CLOSED;
        let (what, values) = if closing {
            let most = self.state.max_width.max(EPSILON);
            (command::GRASP, payload(&[self.wanted, EPSILON, most, self.speed, self.force]))
        } else {
            (command::MOVE, payload(&[self.wanted, self.speed]))
        };
        let id = self.channel.request(u32::from(what), &values)?;
        self.pending.push((id, what));
        (self.told, self.sent) = (Some(self.wanted), now);
        Ok(())
    }

    /// The fingers stay where they are.
    pub(super) fn stop(&mut self) -> Result<(), Fault> {
        self.pending.clear();
        self.begin();
        self.channel.request(u32::from(command::STOP), &[]).map(drop)
    }
}
