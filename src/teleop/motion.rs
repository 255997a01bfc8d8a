//! The input of a person in a tick: motion and marks.

use physics::math::{Quat, Vec3};

/// Motion of a hand since the last tick, in the world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandMove {
    /// Displacement \[m\].
    pub way: Vec3,
    /// Rotation.
    pub turn: Quat,
}

/// Arms that a person can drive at once: the first, and the left one beside it.
pub const ARMS: usize = 2;

/// How a person wants an arm to move during a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmMotion {
    /// Along x, y, z, and about them: fractions of the motion in a tick, -1 to 1.
    pub along: [f64; 6],
    /// Motion of a tracked hand that is followed.
    pub hand: Option<HandMove>,
    /// Target of the gripper, -1 (closed) to 1 (open); `None` leaves it.
    pub gripper: Option<f64>,
}

impl ArmMotion {
    /// Whether the hand should move.
    pub fn moves(&self) -> bool {
        self.along.iter().any(|&x| x != 0.0) || self.hand.is_some()
    }

    /// The direction of the hand's motion, not normalised.
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
    /// Velocity of a base, as fractions of the largest, -1 to 1: forward, to the left, counterclockwise.
    pub base: [f64; 3],
    /// Numbers of joints, and the fractions of their motion in a tick, -1 to 1.
    pub joints: Vec<(usize, f64)>,
    /// Targets of the controls led by a glove or a leader arm, in their units, in the order of the calibration or the config.
    pub led: Option<Vec<f64>>,
    /// Everything moves at a quarter of its speed.
    pub quarter: bool,
}

impl Motion {
    /// Whether there is any motion. Gloves and leader arms never rest and do not count: they do not start time, which ending a
    /// pause does.
    pub fn moves(&self) -> bool {
        self.arms.iter().any(ArmMotion::moves)
            || self.base.iter().any(|&x| x != 0.0)
            || self.joints.iter().any(|&(_, x)| x != 0.0)
    }

    /// The fraction of its speed at which everything moves.
    pub(crate) fn pace(&self) -> f64 {
        if self.quarter { 0.25 } else { 1.0 }
    }

    /// Whether there is any motion, or a target of a gripper.
    pub fn touches(&self) -> bool {
        self.moves() || self.arms.iter().any(|arm| arm.gripper.is_some())
    }
}

/// A command about the episode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// The episode is over, and a good one.
    Success,
    /// The episode is over; it is kept as one that failed.
    Failure,
    /// The episode is discarded, and restarts from the same reset.
    Discard,
    /// The episode is discarded, and the next one begins.
    Skip,
    /// Time pauses, or continues.
    Pause,
    /// Time runs at a quarter of its speed, or at full speed again.
    Slow,
    /// One state back; time pauses.
    Back,
    /// One state forward again, after going back.
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
    /// Whether it repeats while it is held.
    pub fn repeats(self) -> bool {
        matches!(self, Mark::Back | Mark::Forward | Mark::BackSecond | Mark::ForwardSecond)
    }
}

/// The input of a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// How the robot moves.
    pub motion: Motion,
    /// Commands about the episode.
    pub marks: Vec<Mark>,
}
