//! What can be wrong with a request for draws.

use std::fmt::{Display, Formatter, Result};

/// Why nothing was drawn. The generator is as it was before the call.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RandomError {
    /// A range of integers without a member.
    EmptyRange {
        /// First integer.
        low: i128,
        /// End of the range.
        high: i128,
        /// True when `high` belongs to the range.
        closed: bool,
    },
    /// A choice among nothing.
    EmptyPopulation,
    /// A choice without replacement of more than there is.
    SampleTooLarge {
        /// Members asked for.
        count: usize,
        /// Members that there are.
        population: usize,
    },
    /// Not one weight for each member of the population.
    WeightCount {
        /// Number of weights.
        weights: usize,
        /// Members that there are.
        population: usize,
    },
    /// A weight that is negative or no number.
    BadWeight {
        /// Which one, from 0.
        index: usize,
        /// Its value.
        weight: f64,
    },
    /// Weights whose sum is not 1.
    WeightSum {
        /// Their sum.
        sum: f64,
    },
    /// A choice without replacement of more members than have a weight above zero.
    TooFewWeights {
        /// Members asked for.
        count: usize,
        /// Members with a weight above zero.
        positive: usize,
    },
    /// An interval whose length is not finite.
    UnboundedInterval {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// An interval whose lower end is above the upper one.
    ReversedInterval {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// A standard deviation that is negative or no number.
    BadScale {
        /// The standard deviation.
        scale: f64,
    },
    /// Slices that belong together and differ in length.
    LengthMismatch {
        /// Length of the slice to fill.
        expected: usize,
        /// The other length.
        found: usize,
    },
    /// A seed given as text that is no non-negative integer of at most 4096 digits.
    BadSeed,
    /// An empty sequence where a legacy seed is asked for.
    EmptyKey,
    /// A saved state that no generator can have.
    BadState {
        /// What is wrong with it.
        what: &'static str,
    },
    /// More draws than memory can hold.
    OutOfMemory {
        /// Number of draws.
        count: usize,
    },
}

impl Display for RandomError {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::EmptyRange { low, high, closed } => {
                let sign = if *closed { "..=" } else { ".." };
                write!(f, "the range {low}{sign}{high} contains no integer: give a larger upper end")
            }
            Self::EmptyPopulation => write!(f, "nothing can be chosen from an empty population"),
            Self::SampleTooLarge { count, population } => write!(
                f,
                "{count} members cannot be chosen without replacement from {population}: choose fewer, or with replacement"
            ),
            Self::WeightCount { weights, population } => {
                write!(f, "{weights} weights were given for {population} members: give one for each")
            }
            Self::BadWeight { index, weight } => {
                write!(f, "weight {index} is {weight:?}: weights must not be negative or NaN")
            }
            Self::WeightSum { sum } => {
                write!(f, "the weights sum to {sum}: divide them by their sum, so that it is 1")
            }
            Self::TooFewWeights { count, positive } => write!(
                f,
                "{count} members cannot be chosen without replacement: only {positive} have a weight above zero"
            ),
            Self::UnboundedInterval { low, high } => {
                write!(f, "the interval from {low:?} to {high:?} has no finite length: give finite ends")
            }
            Self::ReversedInterval { low, high } => {
                write!(f, "the interval from {low:?} to {high:?} is reversed: exchange its ends")
            }
            Self::BadScale { scale } => {
                write!(f, "the standard deviation is {scale:?}: it must not be negative or NaN")
            }
            Self::LengthMismatch { expected, found } => {
                write!(
                    f,
                    "{expected} numbers are to be drawn, but {found} bounds were given: lengths must be equal"
                )
            }
            Self::BadSeed => {
                write!(
                    f,
                    "the seed is no integer: write up to 4096 decimal digits, or hexadecimal ones after 0x"
                )
            }
            Self::EmptyKey => write!(f, "the sequence of seeds is empty: give at least one number"),
            Self::BadState { what } => write!(f, "the saved state cannot be restored: {what}"),
            Self::OutOfMemory { count } => {
                write!(f, "there is no memory for {count} draws: draw fewer at a time")
            }
        }
    }
}

impl std::error::Error for RandomError {}
