//! What can go wrong between a driver and its device, on demand and repeatably.

use random::{Generator, Pcg64};
use std::fmt;
use std::str::FromStr;

/// How often each fault strikes a message, as probabilities.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Rates {
    /// The message is lost.
    pub drop: f64,
    /// It comes late, by up to [`Rates::LATE`].
    pub delay: f64,
    /// It comes after the one that follows it.
    pub reorder: f64,
    /// It comes twice.
    pub duplicate: f64,
    /// One of its bits is flipped.
    pub corrupt: f64,
    /// Its end is missing.
    pub truncate: f64,
    /// Nothing passes for [`Rates::STALL`]; what was sent in the meantime comes then.
    pub stall: f64,
    /// The connection ends.
    pub disconnect: f64,
    /// Somebody presses the stop button.
    pub stop: f64,
}

const NAMES: [&str; 9] =
    ["drop", "delay", "reorder", "duplicate", "corrupt", "truncate", "stall", "disconnect", "stop"];

impl Rates {
    /// Longest delay of a message \[s\].
    pub const LATE: f64 = 0.05;
    /// How long a stall lasts \[s\].
    pub const STALL: f64 = 0.5;

    fn all(&mut self) -> [&mut f64; 9] {
        let Rates { drop, delay, reorder, duplicate, corrupt, truncate, stall, disconnect, stop } = self;
        [drop, delay, reorder, duplicate, corrupt, truncate, stall, disconnect, stop]
    }
}

/// A list of faults that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RatesError(String);

impl fmt::Display for RatesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for RatesError {}

/// `drop=0.01,delay=0.1`.
///
/// ```
/// let rates: robohive_wire::Rates = "drop=0.01,corrupt=0.5".parse()?;
/// assert_eq!((rates.drop, rates.corrupt, rates.delay), (0.01, 0.5, 0.0));
/// assert!("dorp=1".parse::<robohive_wire::Rates>().is_err());
/// # Ok::<(), robohive_wire::RatesError>(())
/// ```
impl FromStr for Rates {
    type Err = RatesError;

    fn from_str(text: &str) -> Result<Rates, RatesError> {
        let (mut rates, mut named) = (Rates::default(), [false; NAMES.len()]);
        for entry in text.split(',').map(str::trim).filter(|entry| !entry.is_empty()) {
            let Some((name, value)) = entry.split_once('=') else {
                return Err(RatesError(format!(
                    "'{entry}' is not of the form fault=probability, as drop=0.01"
                )));
            };
            let Some(place) = NAMES.iter().position(|known| *known == name.trim()) else {
                return Err(RatesError(format!(
                    "there is no fault '{}'; there are {}",
                    name,
                    NAMES.join(", ")
                )));
            };
            if std::mem::replace(&mut named[place], true) {
                return Err(RatesError(format!("the fault {} is there twice", NAMES[place])));
            }
            let rate = value.trim().parse::<f64>().ok().filter(|rate| (0.0..=1.0).contains(rate));
            *rates.all()[place] = rate.ok_or_else(|| {
                RatesError(format!("'{value}' is not a probability of {name}: a number from 0 to 1"))
            })?;
        }
        Ok(rates)
    }
}

/// What becomes of messages in one direction of a link.
pub(crate) struct Injector {
    rates: Rates,
    rng: Generator<Pcg64>,
    /// Nothing passes before this \[s\].
    stalled: f64,
    /// A message that waits for the next one to overtake it.
    held: Option<(f64, Vec<u8>)>,
    struck: u64,
}

/// What befell the link as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Accident {
    Disconnected,
    StopPressed,
}

impl Injector {
    pub(crate) fn new(rates: Rates, seed: u64) -> Injector {
        Injector { rates, rng: Generator::pcg64(seed), stalled: f64::NEG_INFINITY, held: None, struck: 0 }
    }

    /// Faults so far.
    pub(crate) fn struck(&self) -> u64 {
        self.struck
    }

    fn strikes(&mut self, rate: f64) -> bool {
        // A fault that never strikes draws nothing, so that adding it to the list does not move the others.
        let strikes = rate > 0.0 && self.rng.random() < rate;
        self.struck += u64::from(strikes);
        strikes
    }

    fn below(&mut self, bound: usize) -> usize {
        self.rng.integer(0..bound as u64).map_or(0, |drawn| drawn as usize)
    }

    /// Passes on a message that would arrive at `due`, zero to three times, with the times at which that happens.
    pub(crate) fn pass(
        &mut self,
        due: f64,
        mut bytes: Vec<u8>,
        mut deliver: impl FnMut(f64, Vec<u8>),
    ) -> Option<Accident> {
        let rates = self.rates;
        if rates == Rates::default() {
            deliver(due, bytes);
            return None;
        }
        let accident = if self.strikes(rates.disconnect) {
            Some(Accident::Disconnected)
        } else {
            self.strikes(rates.stop).then_some(Accident::StopPressed)
        };
        if self.strikes(rates.stall) {
            self.stalled = due + Rates::STALL;
        }
        let mut due = due.max(self.stalled);
        if self.strikes(rates.drop) {
            return accident;
        }
        if self.strikes(rates.delay) {
            due += Rates::LATE * self.rng.random();
        }
        if !bytes.is_empty() && self.strikes(rates.corrupt) {
            let (place, bit) = (self.below(bytes.len()), self.below(8));
            bytes[place] ^= 1 << bit;
        }
        if !bytes.is_empty() && self.strikes(rates.truncate) {
            bytes.truncate(self.below(bytes.len()));
        }
        if self.strikes(rates.duplicate) {
            deliver(due, bytes.clone());
        }
        let overtaken = self.held.take();
        if overtaken.is_none() && self.strikes(rates.reorder) {
            self.held = Some((due, bytes));
            return accident;
        }
        deliver(due, bytes);
        if let Some((earlier, bytes)) = overtaken {
            deliver(earlier.max(due), bytes);
        }
        accident
    }
}
