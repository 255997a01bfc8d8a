//! What a person wants, tick by tick.

use physics::math::{Quat, Vec3};

/// Way and turn of a hand since the last tick, in the frame of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandMove {
    /// The way \[m\].
    pub way: Vec3,
    /// The turn.
    pub turn: Quat,
}

/// Arms that a person can drive at once: the first, and the left one beside it.
pub const ARMS: usize = 2;

/// How a person wants an arm to move during a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmMotion {
    /// Along x, y, z, and about them: parts of what a tick moves, -1 to 1.
    pub along: [f64; 6],
    /// A hand that is followed.
    pub hand: Option<HandMove>,
    /// Where the gripper should be, -1 (closed) to 1; `None` leaves it.
    pub gripper: Option<f64>,
}

impl ArmMotion {
    /// Whether the hand should move.
    pub fn moves(&self) -> bool {
        self.along.iter().any(|&x| x != 0.0) || self.hand.is_some()
    }

    /// The direction in which the hand goes, of any length.
    pub fn way(&self) -> Vec3 {
        let [x, y, z, ..] = self.along;
        self.hand.map_or([x, y, z], |hand| hand.way)
    }

    /// Whether the hand should turn.
    pub fn turns(&self) -> bool {
        self.along[3..].iter().any(|&x| x != 0.0) || self.hand.is_some()
    }
}

/// How a person wants the robot to move during a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Its arms: the first, and the left one.
    pub arms: [ArmMotion; ARMS],
    /// Velocity of a base, in parts of the largest, -1 to 1: forward, to the left, counterclockwise.
    pub base: [f64; 3],
    /// Numbers of joints, and the parts of what a tick moves them, -1 to 1.
    pub joints: Vec<(usize, f64)>,
    /// Where a glove or a leader arm has controls, in their units and in the order of the calibration or the config.
    pub led: Option<Vec<f64>>,
    /// Everything moves at a quarter.
    pub quarter: bool,
}

impl Motion {
    /// Whether anything should move that rests otherwise. A hand in a glove or at an arm never rests: it moves nothing while time stands
    /// still, which a pause that is ended lets go on.
    pub fn moves(&self) -> bool {
        self.arms.iter().any(ArmMotion::moves)
            || self.base.iter().any(|&x| x != 0.0)
            || self.joints.iter().any(|&(_, x)| x != 0.0)
    }

    /// Whether a person touches anything: something should move, or a gripper.
    pub fn touches(&self) -> bool {
        self.moves() || self.arms.iter().any(|arm| arm.gripper.is_some())
    }
}

/// What a person says of the episode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// The episode is over, and a good one.
    Success,
    /// The episode is over; it is kept as one that failed.
    Failure,
    /// The episode is thrown away, and begins once more from the same reset.
    Discard,
    /// The episode is thrown away, and the next one begins.
    Skip,
    /// Time stands still, or goes on.
    Pause,
    /// Time goes at a quarter of its speed, or at its own again.
    Slow,
    /// One state back; time stands still then.
    Back,
    /// One state forward again, of those that were gone back over.
    Forward,
    /// A second back.
    BackSecond,
    /// A second forward.
    ForwardSecond,
    /// The policy hands control to the person, or the person to the policy.
    Policy,
    /// The session ends.
    End,
}

/// Marks by the names of mapping files.
pub const MARKS: [(&str, Mark); 12] = [
    ("success", Mark::Success),
    ("failure", Mark::Failure),
    ("discard", Mark::Discard),
    ("skip", Mark::Skip),
    ("pause", Mark::Pause),
    ("slow", Mark::Slow),
    ("back", Mark::Back),
    ("forward", Mark::Forward),
    ("back_second", Mark::BackSecond),
    ("forward_second", Mark::ForwardSecond),
    ("policy", Mark::Policy),
    ("end", Mark::End),
];

impl Mark {
    /// Whether it acts as long as it is held, and not once.
    pub fn repeats(self) -> bool {
        matches!(self, Mark::Back | Mark::Forward | Mark::BackSecond | Mark::ForwardSecond)
    }
}

/// All that a person wants of one tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// How the robot moves.
    pub motion: Motion,
    /// What is said of the episode.
    pub marks: Vec<Mark>,
}
