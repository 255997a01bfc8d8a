//! Laws of mechanics and of the algorithms, which hold whatever MuJoCo computes: each measured, each with a bound.

mod free_flight;
mod law;
mod order;
mod pile;
mod states;

pub use law::{Bound, Law, LawError};
pub use pile::Piles;

use crate::reference::Reference;
use std::fmt::Write;

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
