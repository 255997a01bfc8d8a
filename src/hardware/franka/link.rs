//! The driver's side of a connection to an arm or a hand.

use crate::port::Sockets;
use protocol::Port;
use protocol::franka::{Command, Decoder, Request, Setpoint, State, Version, encode, hand, reply_size};
use robot::Fault;
use std::io::ErrorKind;

/// Longest wait for a reply \[s\].
const PATIENCE: f64 = 1.0;
/// How long to wait for bytes before looking for datagrams again \[s\].
const LOOK: f64 = 5e-4;

/// An error of a port: the device is gone, or could not be asked.
pub(super) fn broken(error: &std::io::Error) -> Fault {
    match error.kind() {
        ErrorKind::UnexpectedEof => Fault::Unreachable(format!("the connection is lost: {error}")),
        _ => Fault::Unreachable(error.to_string()),
    }
}

/// A reply: the request that it answers, and its payload.
struct Reply {
    id: u32,
    payload: Vec<u8>,
}

/// Requests and replies of a server, and the datagrams that it sends.
pub(super) struct Channel {
    commands: Box<dyn Port>,
    states: Box<dyn Port>,
    /// Where the server sends its datagrams.
    pub(super) port: u16,
    decoder: Decoder,
    hand: bool,
    next: u32,
    replies: Vec<Reply>,
    buffer: Vec<u8>,
    out: Vec<u8>,
}

impl Channel {
    pub(super) fn open(sockets: &dyn Sockets, host: &str, port: u16, hand: bool) -> Result<Channel, Fault> {
        let explain = |error: std::io::Error| {
            let what = if hand { "the hand" } else { "the arm" };
            Fault::Unreachable(format!(
                "{what} at {host}, port {port}: {error}; check the cable, the address, and that the interface is active in \
                 Desk"
            ))
        };
        let commands = sockets.connect(host, port).map_err(explain)?;
        let (states, own) = sockets.datagrams(host, port).map_err(explain)?;
        Ok(Channel {
            commands,
            states,
            port: own,
            decoder: if hand { Decoder::hand() } else { Decoder::arm() },
            hand,
            next: 0,
            replies: Vec::new(),
            buffer: vec![0; 4096],
            out: Vec::with_capacity(512),
        })
    }

    pub(super) fn now(&self) -> f64 {
        self.states.now()
    }

    /// Sends a request; returns its number.
    pub(super) fn request(&mut self, command: u32, payload: &[u8]) -> Result<u32, Fault> {
        let id = self.next;
        self.next = self.next.wrapping_add(1);
        self.out.clear();
        match u16::try_from(command) {
            Ok(command) if self.hand => hand::encode(&mut self.out, command, id, payload),
            _ => encode(&mut self.out, command, id, payload),
        }
        self.commands.send(&self.out).map_err(|error| broken(&error))?;
        Ok(id)
    }

    /// Takes the replies that have come, waiting for at most `timeout`.
    pub(super) fn listen(&mut self, timeout: f64) -> Result<(), Fault> {
        let mut timeout = timeout;
        loop {
            let count = self.commands.receive(&mut self.buffer, timeout).map_err(|error| broken(&error))?;
            if count == 0 {
                return Ok(());
            }
            timeout = 0.0;
            self.decoder.push(&self.buffer[..count]);
            while let Some(frame) = self.decoder.next_frame() {
                let frame = frame.map_err(|length| {
                    Fault::Unreachable(format!(
                        "its server announces a message of {} bytes, as no arm does; check that the address is the arm's",
                        length.0
                    ))
                })?;
                self.replies.push(Reply { id: frame.id, payload: frame.payload.to_vec() });
            }
            // What nobody waits for does not stay.
            let surplus = self.replies.len().saturating_sub(64);
            self.replies.drain(..surplus);
        }
    }

    /// The reply to a request, if it has come.
    pub(super) fn reply(&mut self, id: u32) -> Option<Vec<u8>> {
        let place = self.replies.iter().position(|reply| reply.id == id)?;
        Some(self.replies.remove(place).payload)
    }

    /// The next datagram that has come; 0 bytes where none has.
    pub(super) fn datagram(&mut self) -> Result<&[u8], Fault> {
        let count = self.states.receive(&mut self.buffer, 0.0).map_err(|error| broken(&error))?;
        Ok(&self.buffer[..count])
    }

    /// Connects as a client of this version; returns the server's.
    pub(super) fn greet(&mut self, version: u16) -> Result<(bool, u16), Fault> {
        let id = self.request(0, &Request { version, port: self.port }.encode())?;
        let end = self.now() + PATIENCE;
        loop {
            if let Some(payload) = self.reply(id) {
                return match (self.hand, &payload[..]) {
                    (false, [status, a, b, ..]) => Ok((*status == 0, u16::from_le_bytes([*a, *b]))),
                    (true, [s, _, a, b, ..]) => Ok((*s == 0, u16::from_le_bytes([*a, *b]))),
                    _ => {
                        Err(Fault::Unreachable("its server answers a greeting with too few bytes".to_owned()))
                    }
                };
            }
            let left = end - self.now();
            if left <= 0.0 {
                return Err(Fault::Unreachable(
                    "its server does not answer a greeting; does another program have the arm?".to_owned(),
                ));
            }
            self.listen(left.min(LOOK))?;
        }
    }
}

/// A connection to an arm.
pub(super) struct Link {
    channel: Channel,
    pub(super) version: Version,
    pub(super) state: State,
    /// When the newest state came \[s\]; `None` before the first.
    pub(super) received: Option<f64>,
    scratch: Vec<u8>,
}

impl Link {
    /// Connects, with the arm's version unless `wanted` says which.
    pub(super) fn open(
        sockets: &dyn Sockets,
        host: &str,
        port: u16,
        wanted: Option<Version>,
    ) -> Result<Link, Fault> {
        let mut version = wanted.unwrap_or(Version::V10);
        let mut channel = Channel::open(sockets, host, port, false)?;
        let (mut fits, mut own) = channel.greet(version.number())?;
        if let (false, None, Some(other)) = (fits && own == version.number(), wanted, Version::of(own)) {
            // A server has one client; this one must go before it comes again.
            drop(channel);
            version = other;
            channel = Channel::open(sockets, host, port, false)?;
            (fits, own) = channel.greet(version.number())?;
        }
        if !fits || own != version.number() {
            return Err(Fault::Refused(format!(
                "the arm speaks version {own} of its interface, and not {}; this driver knows 5 and 10",
                version.number()
            )));
        }
        let scratch = Vec::with_capacity(Setpoint::size(version));
        let mut link = Link { channel, version, state: State::default(), received: None, scratch };
        link.wait_until("says its state", |link| link.received.is_some())?;
        Ok(link)
    }

    pub(super) fn now(&self) -> f64 {
        self.channel.now()
    }

    /// Takes what has come. Returns how many states there were since the one before, 0 where there is none that is newer.
    pub(super) fn pump(&mut self) -> Result<u64, Fault> {
        self.channel.listen(0.0)?;
        let before = self.state.message;
        let mut newest: Option<State> = None;
        loop {
            let bytes = self.channel.datagram()?;
            if bytes.is_empty() {
                break;
            }
            // Damaged and outdated datagrams are skipped.
            let Some(state) = State::decode(bytes, self.version) else { continue };
            let latest = newest.as_ref().map_or(before, |newest| newest.message);
            let plausible = self.received.is_none() || state.message < before.saturating_add(MOST_AHEAD);
            if sound(&state) && plausible && (state.message > latest || self.received.is_none()) {
                newest = Some(state);
            }
        }
        let Some(state) = newest else { return Ok(0) };
        let steps = if self.received.is_some() { state.message - before } else { 1 };
        self.state = state;
        self.received = Some(self.now());
        Ok(steps)
    }

    /// Answers the newest state.
    pub(super) fn answer(&mut self, setpoint: &Setpoint) -> Result<(), Fault> {
        let setpoint = Setpoint { message: self.state.message, ..*setpoint };
        setpoint.encode(self.version, &mut self.scratch);
        self.channel.states.send(&self.scratch).map_err(|error| broken(&error))
    }

    /// Sends a request; returns its number.
    pub(super) fn request(&mut self, command: Command, payload: &[u8]) -> Result<u32, Fault> {
        let number = command.number(self.version);
        let number =
            number.ok_or_else(|| Fault::Refused(format!("this version has no command {command:?}")))?;
        self.channel.request(number, payload)
    }

    /// The first byte of the reply to a request, if it has come.
    pub(super) fn reply(&mut self, id: u32) -> Option<u8> {
        self.channel.reply(id).and_then(|payload| payload.first().copied())
    }

    /// Sends a request and waits for its reply.
    pub(super) fn ask(&mut self, command: Command, payload: &[u8]) -> Result<u8, Fault> {
        debug_assert!(reply_size(command) == 1);
        let id = self.request(command, payload)?;
        self.wait_reply(id, &format!("answers {command:?}"))
    }

    pub(super) fn wait_reply(&mut self, id: u32, what: &str) -> Result<u8, Fault> {
        let mut answer = None;
        self.wait_until(what, |link| {
            answer = answer.or_else(|| link.reply(id));
            answer.is_some()
        })?;
        answer.ok_or(Fault::NotConnected)
    }

    /// Takes what comes until something is so.
    pub(super) fn wait_until(
        &mut self,
        what: &str,
        mut done: impl FnMut(&mut Link) -> bool,
    ) -> Result<(), Fault> {
        let end = self.now() + PATIENCE;
        loop {
            self.pump()?;
            if done(self) {
                return Ok(());
            }
            if self.now() >= end {
                return Err(Fault::Unreachable(format!(
                    "for {PATIENCE} s it has not been so that the arm {what}"
                )));
            }
            self.channel.listen(LOOK)?;
        }
    }
}

/// States that are further ahead than this were damaged on the way: the arm counts milliseconds.
const MOST_AHEAD: u64 = 1000;

/// Whether the values that the driver uses are what joints can have.
fn sound(state: &State) -> bool {
    use protocol::franka::field::{DQ, Q, Q_D};
    [state.get(Q), state.get(Q_D), state.get(DQ)].iter().flatten().all(|value| value.abs() < 20.0)
}
