//! Laws of mechanics and of the algorithms, which hold whatever MuJoCo computes: each measured, each with a bound.

mod free_flight;
mod order;
mod pile;
mod states;

use crate::reference::{Reference, ReferenceError};
use crate::tolerance::Tolerance;
use physics::StepError;
use std::fmt;
use std::fmt::Write;

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
    fn new(law: &str, on: impl Into<String>, measured: f64, bound: Bound) -> Self {
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

fn compile(text: &str) -> Result<physics::Model, LawError> {
    mjcf::load_str(text).map(|loaded| loaded.model).map_err(|e| LawError::Model(e.to_string()))
}

/// How many of the four variants of the pile are run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Piles {
    /// Newton with pyramidal cones.
    One,
    /// Newton and CG with both cones.
    All,
}

/// Measures every law; those on recorded states are the worst over all `references`, called `on`.
///
/// # Errors
/// A model cannot be read or refuses to move.
pub fn measure(on: &str, references: &[Reference], piles: Piles) -> Result<Vec<Law>, LawError> {
    let mut laws = order::orders()?;
    laws.extend(free_flight::momentum()?);
    laws.extend(free_flight::energy()?);
    laws.extend(states::recorded(on, references)?);
    laws.push(pile::action_and_reaction()?);
    laws.extend(pile::piles(piles)?);
    Ok(laws)
}

/// The table, and as verdict an error that lists the laws that do not hold.
pub fn render(laws: &[Law]) -> (String, Result<(), String>) {
    let mut text = String::from("| law | on | measured | bound | holds |\n|---|---|---|---|---|\n");
    for law in laws {
        let _ = writeln!(text, "{law}");
    }
    let broken: Vec<String> = laws.iter().filter(|l| !l.holds()).map(ToString::to_string).collect();
    (text, if broken.is_empty() { Ok(()) } else { Err(broken.join("\n")) })
}
