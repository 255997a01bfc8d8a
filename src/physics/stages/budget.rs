//! Memory that one step may take: what contacts and constraint rows ask for is counted before it is stored.

use std::fmt;

/// Memory for the contacts and constraint rows of one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepBudget {
    /// Bytes.
    pub bytes: usize,
}

impl Default for StepBudget {
    fn default() -> Self {
        StepBudget { bytes: 1 << 30 }
    }
}

/// What a step has too many of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Demand {
    /// Pairs of bodies whose bounding boxes overlap.
    BodyPairs,
    /// Pairs of geoms of two bodies that may touch.
    GeomPairs,
    /// Contacts.
    Contacts,
    /// Constraint rows, with what the solver makes of them.
    Rows,
}

/// A step needs more memory than its budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OverBudget {
    /// What there is too much of.
    pub demand: Demand,
    /// How many; of pairs and contacts as many as were found before the search ended.
    pub count: usize,
    /// Contacts of the step.
    pub contacts: usize,
    /// Bytes asked for.
    pub bytes: usize,
    /// Bytes of the budget.
    pub budget: usize,
}

impl fmt::Display for OverBudget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let OverBudget { demand, count, contacts, bytes, budget } = self;
        match demand {
            Demand::BodyPairs => write!(f, "{count} pairs of bodies or more may touch")?,
            Demand::GeomPairs => write!(f, "{count} pairs of geoms of two bodies or more may touch")?,
            Demand::Contacts => write!(f, "the geoms make {count} contacts or more")?,
            Demand::Rows => write!(f, "{contacts} contacts and other constraints make {count} rows")?,
        }
        write!(
            f,
            " and need {bytes} bytes, more than the step's budget of {budget}; raise `budget` of the `Data`, \
             or exclude contacts between geoms that overlap"
        )
    }
}

impl std::error::Error for OverBudget {}

impl StepBudget {
    /// How many things of `size` bytes fit.
    pub(crate) fn count(self, size: usize) -> usize {
        self.bytes / size
    }

    /// The error of `count` things of `size` bytes.
    pub(crate) fn exceeded(self, demand: Demand, count: usize, size: usize) -> OverBudget {
        let contacts = if demand == Demand::Contacts { count } else { 0 };
        OverBudget { demand, count, contacts, bytes: count.saturating_mul(size), budget: self.bytes }
    }
}
