//! What the byte of a reply says, which differs between versions.

use super::command::Version;

/// How a command ended, whatever it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It was done.
    Done,
    /// It cannot be done in the arm's present mode.
    NotPossible,
    /// An argument is outside its range.
    Invalid,
    /// A reflex ended it.
    Reflex,
    /// The stop button, or a safety function, ended it.
    Emergency,
    /// A person must bring the arm out of its error.
    Manual,
    /// Another command ended it.
    Aborted,
    /// A number that the documents do not have.
    Unknown(u8),
}

impl Outcome {
    /// The byte of a reply to a setter.
    pub fn of_setter(byte: u8) -> Outcome {
        match byte {
            0 => Outcome::Done,
            1 => Outcome::NotPossible,
            2 => Outcome::Invalid,
            3 => Outcome::Emergency,
            other => Outcome::Unknown(other),
        }
    }

    /// The byte that a setter answers.
    pub fn setter(self) -> u8 {
        match self {
            Outcome::Done => 0,
            Outcome::Invalid => 2,
            _ => 1,
        }
    }

    /// The byte of a reply to `StopMove`.
    pub fn of_stop(byte: u8, version: Version) -> Outcome {
        match (byte, version) {
            (0, _) => Outcome::Done,
            (1, _) => Outcome::NotPossible,
            (2, _) | (3, Version::V10) => Outcome::Emergency,
            (3, Version::V5) | (4, Version::V10) => Outcome::Reflex,
            (4, Version::V5) | (5, Version::V10) => Outcome::Aborted,
            (other, _) => Outcome::Unknown(other),
        }
    }

    /// The byte of a reply to `AutomaticErrorRecovery`.
    pub fn of_recovery(byte: u8, version: Version) -> Outcome {
        match (byte, version) {
            (0, _) => Outcome::Done,
            (1, _) => Outcome::NotPossible,
            (2, Version::V10) => Outcome::Emergency,
            (2, Version::V5) | (3, Version::V10) => Outcome::Manual,
            (3, Version::V5) | (4, Version::V10) => Outcome::Reflex,
            (4, Version::V5) | (5, Version::V10) => Outcome::Emergency,
            (5, Version::V5) | (6, Version::V10) => Outcome::Aborted,
            (other, _) => Outcome::Unknown(other),
        }
    }

    /// In words, after "it".
    pub fn describe(self) -> &'static str {
        match self {
            Outcome::Done => "did it",
            Outcome::NotPossible => "cannot do that in its present mode",
            Outcome::Invalid => "found an argument outside its range",
            Outcome::Reflex => "was stopped by a reflex",
            Outcome::Emergency => "was stopped by its stop button or a safety function",
            Outcome::Manual => "needs a person to bring it out of its error",
            Outcome::Aborted => "was told to do something else",
            Outcome::Unknown(_) => "gave an answer that its documents do not have",
        }
    }
}

/// What a reply to `Move` says; the first says that the motion began, the second how it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum MoveEnd {
    Success,
    Started,
    Preempted,
    NotPossible,
    Singular,
    Invalid,
    Reflex,
    Emergency,
    Input,
    Aborted,
    Unknown(u8),
}

/// `(what, byte in version 5, byte in version 10)`.
const MOVE: [(MoveEnd, u8, u8); 10] = [
    (MoveEnd::Success, 0, 0),
    (MoveEnd::Started, 1, 1),
    (MoveEnd::Preempted, 2, 2),
    (MoveEnd::NotPossible, 3, 5),
    (MoveEnd::Singular, 4, 6),
    (MoveEnd::Invalid, 5, 7),
    (MoveEnd::Reflex, 6, 8),
    (MoveEnd::Emergency, 7, 9),
    (MoveEnd::Input, 8, 10),
    (MoveEnd::Aborted, 9, 11),
];

impl MoveEnd {
    /// The byte of a reply.
    pub fn byte(self, version: Version) -> u8 {
        if let MoveEnd::Unknown(byte) = self {
            return byte;
        }
        let entry = MOVE.into_iter().find(|entry| entry.0 == self);
        entry.map_or(0, |(_, v5, v10)| if version == Version::V5 { v5 } else { v10 })
    }

    /// What a byte says.
    pub fn of(byte: u8, version: Version) -> MoveEnd {
        // Version 10 tells apart what safety functions do.
        if version == Version::V10 && (3..=4).contains(&byte) {
            return MoveEnd::Emergency;
        }
        let entry = MOVE.into_iter().find(|entry| entry.0.byte(version) == byte);
        entry.map_or(MoveEnd::Unknown(byte), |entry| entry.0)
    }

    /// In words, after "its motion".
    pub fn describe(self) -> &'static str {
        match self {
            MoveEnd::Success => "ended as commanded",
            MoveEnd::Started => "began",
            MoveEnd::Preempted => "was stopped by StopMove",
            MoveEnd::NotPossible => "cannot begin in its present mode",
            MoveEnd::Singular => "cannot begin in a singular pose",
            MoveEnd::Invalid => "was asked for with arguments outside their range",
            MoveEnd::Reflex => "was ended by a reflex",
            MoveEnd::Emergency => "was ended by the stop button or a safety function",
            MoveEnd::Input => "was ended by commands that it cannot take",
            MoveEnd::Aborted => "was ended by another command",
            MoveEnd::Unknown(_) => "ended with a number that its documents do not have",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_end_has_another_number_in_another_version() {
        assert_eq!((MoveEnd::Reflex.byte(Version::V5), MoveEnd::Reflex.byte(Version::V10)), (6, 8));
        assert_eq!(MoveEnd::of(9, Version::V5), MoveEnd::Aborted);
        assert_eq!(MoveEnd::of(9, Version::V10), MoveEnd::Emergency);
        assert_eq!(MoveEnd::of(77, Version::V5), MoveEnd::Unknown(77));
        assert_eq!(Outcome::of_recovery(2, Version::V5), Outcome::Manual);
        assert_eq!(Outcome::of_recovery(2, Version::V10), Outcome::Emergency);
        assert_eq!(Outcome::of_stop(3, Version::V5), Outcome::Reflex);
    }
}
