//! What tasks draw with: the generator, and the boxes that settings state.

use crate::error::EnvError;
use serde::Deserialize;

/// numpy's default generator, by which all draws of an environment are made.
pub type Rng = random::Generator<random::Pcg64>;

/// The corners of a box that vectors are drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ranges<const N: usize = 3> {
    /// Lowest values.
    #[serde(with = "array")]
    pub low: [f64; N],
    /// Highest values.
    #[serde(with = "array")]
    pub high: [f64; N],
}

impl<const N: usize> Ranges<N> {
    /// A vector with every component uniform between its bounds; one draw a component, in order.
    ///
    /// # Errors
    /// A bound that is below the other, or is not finite.
    pub fn draw(&self, rng: &mut Rng) -> Result<[f64; N], EnvError> {
        let mut vector = [0.0; N];
        rng.fill_uniform_each(&self.low, &self.high, &mut vector)?;
        Ok(vector)
    }
}

/// Arrays of any length, of integers or floating-point numbers.
mod array {
    use serde::{Deserialize, Deserializer, de::Error};

    pub fn deserialize<'de, D: Deserializer<'de>, const N: usize>(from: D) -> Result<[f64; N], D::Error> {
        let values = Vec::<f64>::deserialize(from)?;
        let found = values.len();
        values
            .try_into()
            .map_err(|_| D::Error::custom(format!("{N} numbers are expected, and {found} were given")))
    }
}
