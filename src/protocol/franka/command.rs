//! Commands over TCP: `command | id | size`, each an unsigned number of 4 bytes, then a payload; the size counts the header.
//! Replies repeat command and id, and may come in another order.

/// Version of the interface that an arm speaks; it speaks one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Version {
    /// Panda, also called FER; libfranka 0.9.
    V5,
    /// FR3; libfranka 0.18 and later.
    V10,
}

impl Version {
    /// Its number.
    pub fn number(self) -> u16 {
        match self {
            Version::V5 => 5,
            Version::V10 => 10,
        }
    }

    /// The version of a number, where it is one of these.
    pub fn of(number: u16) -> Option<Version> {
        [Version::V5, Version::V10].into_iter().find(|version| version.number() == number)
    }
}

/// What an arm can be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Command {
    Connect,
    Move,
    StopMove,
    GetCartesianLimit,
    SetCollisionBehavior,
    SetJointImpedance,
    SetCartesianImpedance,
    SetGuidingMode,
    SetEeToK,
    SetNeToEe,
    SetLoad,
    SetFilters,
    AutomaticErrorRecovery,
    LoadModelLibrary,
    GetRobotModel,
}

/// `(command, number in version 5, number in version 10, payload of the request)`; a move's payload is that of version 5.
const COMMANDS: [(Command, Option<u32>, Option<u32>, usize); 15] = [
    (Command::Connect, Some(0), Some(0), 4),
    (Command::Move, Some(1), Some(1), 56),
    (Command::StopMove, Some(2), Some(2), 0),
    (Command::GetCartesianLimit, Some(3), None, 4),
    (Command::SetCollisionBehavior, Some(4), Some(3), 416),
    (Command::SetJointImpedance, Some(5), Some(4), 56),
    (Command::SetCartesianImpedance, Some(6), Some(5), 48),
    (Command::SetGuidingMode, Some(7), Some(6), 7),
    (Command::SetEeToK, Some(8), Some(7), 128),
    (Command::SetNeToEe, Some(9), Some(8), 128),
    (Command::SetLoad, Some(10), Some(9), 104),
    (Command::SetFilters, Some(11), None, 40),
    (Command::AutomaticErrorRecovery, Some(12), Some(10), 0),
    (Command::LoadModelLibrary, Some(13), None, 2),
    (Command::GetRobotModel, None, Some(11), 0),
];

impl Command {
    /// Its number on the wire; `None` where the version has no such command.
    pub fn number(self, version: Version) -> Option<u32> {
        let (_, v5, v10, _) = COMMANDS.into_iter().find(|entry| entry.0 == self)?;
        match version {
            Version::V5 => v5,
            Version::V10 => v10,
        }
    }

    /// The command of a number.
    pub fn of(number: u32, version: Version) -> Option<Command> {
        COMMANDS.into_iter().map(|entry| entry.0).find(|command| command.number(version) == Some(number))
    }
}

/// Bytes of a request's payload.
pub fn request_size(command: Command, version: Version) -> usize {
    match (command, version) {
        (Command::Move, Version::V10) => 113,
        _ => COMMANDS.iter().find(|entry| entry.0 == command).map_or(0, |entry| entry.3),
    }
}

/// Fewest bytes of a reply's payload: a status, and what a connection and a limit add to it.
pub fn reply_size(command: Command) -> usize {
    match command {
        Command::Connect => 3,
        Command::GetCartesianLimit => 154,
        _ => 1,
    }
}

/// Who keeps the arm on its path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Controller {
    /// The arm's own, by joint.
    JointImpedance,
    /// The arm's own, in space.
    CartesianImpedance,
    /// The client, by torques.
    External,
}

impl Controller {
    const ALL: [Controller; 3] =
        [Controller::JointImpedance, Controller::CartesianImpedance, Controller::External];

    /// As a request names it; a state has the same number.
    pub fn number(self) -> u32 {
        Controller::ALL.iter().position(|other| *other == self).unwrap_or(0) as u32
    }
}

/// What the client commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Generator {
    JointPosition,
    JointVelocity,
    CartesianPose,
    CartesianVelocity,
    /// Torques alone, in version 10.
    None,
}

impl Generator {
    const ALL: [Generator; 5] = [
        Generator::JointPosition,
        Generator::JointVelocity,
        Generator::CartesianPose,
        Generator::CartesianVelocity,
        Generator::None,
    ];

    /// As a request names it; a state has the next number, and 0 where nothing moves.
    pub fn number(self) -> u32 {
        Generator::ALL.iter().position(|other| *other == self).unwrap_or(0) as u32
    }
}

/// A request to begin a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Who keeps the arm on its path.
    pub controller: Controller,
    /// What is commanded.
    pub generator: Generator,
    /// Largest deviation from the path: position \[m\], rotation, elbow \[rad\].
    pub path: [f64; 3],
    /// Largest deviation from the goal, in the same units.
    pub goal: [f64; 3],
}

impl Move {
    /// A motion with the deviations that libfranka allows: 10 m, 3.12 rad, 2π rad.
    pub fn new(controller: Controller, generator: Generator) -> Move {
        let deviation = [10.0, 3.12, std::f64::consts::TAU];
        Move { controller, generator, path: deviation, goal: deviation }
    }

    /// The payload of a request.
    pub fn encode(&self, version: Version) -> Vec<u8> {
        let mut out = Vec::with_capacity(request_size(Command::Move, version));
        out.extend(self.controller.number().to_le_bytes());
        out.extend(self.generator.number().to_le_bytes());
        out.extend(self.path.iter().chain(&self.goal).flat_map(|value| value.to_le_bytes()));
        // Version 10: no asynchronous motion, whose largest velocities follow.
        out.resize(request_size(Command::Move, version), 0);
        out
    }

    /// The motion that a payload asks for; `None` where it asks for none that exists.
    pub fn decode(payload: &[u8], version: Version) -> Option<Move> {
        if payload.len() != request_size(Command::Move, version) {
            return None;
        }
        let number = |at: usize| word(payload, at).map(|number| number as usize);
        let generator = *Generator::ALL.get(number(4)?)?;
        if version == Version::V5 && generator == Generator::None {
            return None;
        }
        let mut values = [0.0; 6];
        for (k, value) in values.iter_mut().enumerate() {
            *value = double(payload, 8 + 8 * k)?;
        }
        let [a, b, c, d, e, f] = values;
        Some(Move {
            controller: *Controller::ALL.get(number(0)?)?,
            generator,
            path: [a, b, c],
            goal: [d, e, f],
        })
    }
}

pub(super) fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

pub(super) fn double(bytes: &[u8], at: usize) -> Option<f64> {
    Some(f64::from_le_bytes(bytes.get(at..at + 8)?.try_into().ok()?))
}

/// What a connection begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request {
    /// Version that the client speaks.
    pub version: u16,
    /// Port at which the client waits for states.
    pub port: u16,
}

impl Request {
    /// The payload of a request to connect.
    pub fn encode(self) -> [u8; 4] {
        let ([a, b], [c, d]) = (self.version.to_le_bytes(), self.port.to_le_bytes());
        [a, b, c, d]
    }

    /// What a payload says.
    pub fn decode(payload: &[u8]) -> Option<Request> {
        let [a, b, c, d] = payload.try_into().ok()?;
        Some(Request { version: u16::from_le_bytes([a, b]), port: u16::from_le_bytes([c, d]) })
    }
}

/// Appends a message of the arm's server or its client to `out`.
pub fn encode(out: &mut Vec<u8>, command: u32, id: u32, payload: &[u8]) {
    out.extend(command.to_le_bytes());
    out.extend(id.to_le_bytes());
    out.extend((HEADER as u32 + payload.len() as u32).to_le_bytes());
    out.extend(payload);
}

const HEADER: usize = 12;
/// Longest message that is taken for one; the longest that is known is the model library with about 330 kB.
const LONGEST: usize = 1 << 20;

/// A message, either way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Number of the command.
    pub command: u32,
    /// Number of the request.
    pub id: u32,
    /// What follows the header.
    pub payload: &'a [u8],
}

/// Cuts a stream into messages. What it does not understand it cannot skip: the stream is useless from there on.
#[derive(Clone, Debug)]
pub struct Decoder {
    bytes: Vec<u8>,
    used: usize,
    hand: bool,
}

impl Decoder {
    /// For the arm's server, whose header has 12 bytes.
    pub fn arm() -> Decoder {
        Decoder { bytes: Vec::new(), used: 0, hand: false }
    }

    /// For the hand's server: the command has 2 bytes, the header 10.
    pub fn hand() -> Decoder {
        Decoder { hand: true, ..Decoder::arm() }
    }

    /// Takes what came.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.used);
        self.used = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// The next message; `None` until more bytes come, an error where no message can be.
    pub fn next_frame(&mut self) -> Option<Result<Frame<'_>, BadLength>> {
        let bytes = &self.bytes[self.used..];
        let (command, rest) = if self.hand {
            let command = u16::from_le_bytes(bytes.get(..2)?.try_into().ok()?);
            (u32::from(command), 2)
        } else {
            (word(bytes, 0)?, 4)
        };
        let (id, size) = (word(bytes, rest)?, word(bytes, rest + 4)? as usize);
        let header = rest + 8;
        if !(header..=LONGEST).contains(&size) {
            return Some(Err(BadLength(size)));
        }
        let payload = bytes.get(header..size)?;
        self.used += size;
        Some(Ok(Frame { command, id, payload }))
    }
}

/// A header that announces a message of an impossible length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BadLength(pub usize);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_sizes_are_those_of_the_documents() {
        use Command::*;
        assert_eq!((Move.number(Version::V5), Move.number(Version::V10)), (Some(1), Some(1)));
        assert_eq!(AutomaticErrorRecovery.number(Version::V5), Some(12));
        assert_eq!(AutomaticErrorRecovery.number(Version::V10), Some(10));
        assert_eq!((GetRobotModel.number(Version::V5), GetRobotModel.number(Version::V10)), (None, Some(11)));
        assert_eq!(Command::of(4, Version::V5), Some(SetCollisionBehavior));
        assert_eq!(Command::of(4, Version::V10), Some(SetJointImpedance));
        assert_eq!(Command::of(14, Version::V5), None);
        assert_eq!((request_size(Move, Version::V5), request_size(Move, Version::V10)), (56, 113));
        assert_eq!(request_size(SetCollisionBehavior, Version::V5), 416);
        assert_eq!((reply_size(Connect), reply_size(Move)), (3, 1));
    }

    #[test]
    fn a_move_lies_where_it_should_and_comes_back() {
        let mut request = self::Move::new(Controller::External, Generator::JointVelocity);
        request.goal = [1.0, 2.0, 3.0];
        let bytes = request.encode(Version::V5);
        assert_eq!((bytes.len(), bytes[0], bytes[4]), (56, 2, 1));
        assert_eq!(bytes[8..16], 10.0_f64.to_le_bytes());
        assert_eq!(bytes[32..40], 1.0_f64.to_le_bytes());
        for version in [Version::V5, Version::V10] {
            let bytes = request.encode(version);
            assert_eq!(self::Move::decode(&bytes, version), Some(request));
            assert_eq!(self::Move::decode(&bytes[1..], version), None);
        }
        let torques = self::Move::new(Controller::External, Generator::None);
        assert_eq!(self::Move::decode(&torques.encode(Version::V5), Version::V5), None);
    }

    #[test]
    fn messages_come_out_of_any_pieces_and_a_bad_length_is_an_error() {
        let mut stream = Vec::new();
        encode(&mut stream, 0, 7, &Request { version: 5, port: 0x1234 }.encode());
        assert_eq!(stream, [0, 0, 0, 0, 7, 0, 0, 0, 16, 0, 0, 0, 5, 0, 0x34, 0x12]);
        encode(&mut stream, 2, 8, &[]);
        let mut decoder = Decoder::arm();
        let mut found = Vec::new();
        for byte in stream {
            decoder.push(&[byte]);
            while let Some(frame) = decoder.next_frame() {
                let frame = frame.unwrap();
                found.push((frame.command, frame.id, frame.payload.to_vec()));
            }
        }
        assert_eq!(found, [(0, 7, vec![5, 0, 0x34, 0x12]), (2, 8, vec![])]);
        decoder.push(&[1, 0, 0, 0, 1, 0, 0, 0, 11, 0, 0, 0]);
        assert_eq!(decoder.next_frame(), Some(Err(BadLength(11))));
    }
}
