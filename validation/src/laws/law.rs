//! A law, its measured number and its bound.

use crate::reference::ReferenceError;
use crate::tolerance::Tolerance;
use physics::StepError;
use std::fmt;

/// What a measured number must be.
#[derive(Clone, Copy, Debug)]
pub enum Bound {
    /// At most this: a quantity of the motion itself.
    AtMost(f64),
    /// What a tolerance allows of a difference that should be zero.
    Within(&'static Tolerance),
    /// This, give or take the second number.
    Near(f64, f64),
}

/// One law on one system, measured.
#[derive(Clone, Debug)]
pub struct Law {
    /// What holds.
    pub law: String,
    /// The system, and how it is run.
    pub on: String,
    /// The number measured.
    pub measured: f64,
    /// What it must be.
    pub bound: Bound,
}

impl Law {
    /// A law on a system, its number and its bound.
    pub(super) fn new(law: &str, on: impl Into<String>, measured: f64, bound: Bound) -> Self {
        Law { law: law.to_owned(), on: on.into(), measured, bound }
    }

    /// True when the number keeps its bound.
    pub fn holds(&self) -> bool {
        match self.bound {
            Bound::AtMost(most) => self.measured <= most,
            Bound::Within(tolerance) => tolerance.allows(self.measured),
            Bound::Near(value, give) => (self.measured - value).abs() <= give,
        }
    }
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (measured, bound) = match self.bound {
            Bound::AtMost(most) => (format!("{:.1e}", self.measured), format!("at most {most:.0e}")),
            Bound::Within(most) => (format!("{:.1e}", self.measured), format!("at most {:.0e}", most.bound)),
            Bound::Near(value, give) => (format!("{:.3}", self.measured), format!("{value} ± {give}")),
        };
        let verdict = if self.holds() { "yes" } else { "no" };
        write!(f, "| {} | {} | {measured} | {bound} | {verdict} |", self.law, self.on)
    }
}

/// Why a law cannot be measured.
#[derive(Debug)]
pub enum LawError {
    /// A model of this module does not compile.
    Model(String),
    /// A recorded model cannot be read.
    Reference(ReferenceError),
    /// A step was refused.
    Step(StepError),
}

impl fmt::Display for LawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LawError::Model(text) => f.write_str(text),
            LawError::Reference(error) => error.fmt(f),
            LawError::Step(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for LawError {}

impl From<ReferenceError> for LawError {
    fn from(error: ReferenceError) -> Self {
        LawError::Reference(error)
    }
}

impl From<StepError> for LawError {
    fn from(error: StepError) -> Self {
        LawError::Step(error)
    }
}

/// Compiles a model of these laws.
pub(super) fn compile(text: &str) -> Result<physics::Model, LawError> {
    mjcf::load_str(text).map(|loaded| loaded.model).map_err(|e| LawError::Model(e.to_string()))
}
