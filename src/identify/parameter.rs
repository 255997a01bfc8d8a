//! A number that is fitted, with bounds and what is known of it.

use crate::error::IdentifyError;
use crate::quantity::Quantity;
use physics::Model;
use physics::model::ObjType;

/// What is known of a value before the log: a normal distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// The most probable value.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
}

/// A number that is fitted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Parameter {
    /// `joint3.damping`; `delay` alone.
    pub name: String,
    /// What it is.
    pub quantity: Quantity,
    /// Joint, actuator or body that has it.
    pub element: usize,
    /// Where the fit begins: what the model has.
    pub start: f64,
    /// Least value.
    pub lower: f64,
    /// Largest value.
    pub upper: f64,
    /// What counts as much: differences and directions are compared with it.
    pub scale: f64,
    /// What is known before.
    pub prior: Option<Prior>,
}

impl Parameter {
    /// The parameter of an element, which begins at the model's value.
    ///
    /// Values are not negative; masses and gains stay within a tenth and ten times the model's, delays below a fifth of a
    /// second, the others below a hundred times their scale.
    pub(crate) fn of(model: &Model, quantity: Quantity, element: usize) -> Self {
        let start = quantity.read(model, element);
        let scale = if start == 0.0 { quantity.typical(model) } else { start.abs() };
        let (lower, upper) = match quantity {
            Quantity::Mass => (0.1 * start, 10.0 * start),
            Quantity::Gain if start < 0.0 => (10.0 * start, 0.1 * start),
            Quantity::Gain => (0.1 * start, 10.0 * start),
            Quantity::Delay => (0.0, 0.2),
            _ => (0.0, 100.0 * scale),
        };
        let name = match quantity.kind() {
            Some(kind) => format!("{}.{}", called(model, kind, element), quantity.name()),
            None => quantity.name().to_owned(),
        };
        Parameter { name, quantity, element, start, lower: lower.min(start), upper, scale, prior: None }
    }

    /// The same within other bounds, begun inside of them.
    ///
    /// # Errors
    /// The bounds are no finite numbers in order.
    pub fn within(mut self, lower: f64, upper: f64) -> Result<Self, IdentifyError> {
        if !(lower.is_finite() && upper.is_finite() && lower < upper) {
            return Err(IdentifyError::Choice(format!(
                "bounds of {} are {lower} and {upper}; they are finite, the first below the second",
                self.name
            )));
        }
        (self.lower, self.upper) = (lower, upper);
        self.start = self.start.clamp(lower, upper);
        Ok(self)
    }

    /// The same with a prior.
    ///
    /// # Errors
    /// Its numbers are not finite, or the deviation is not positive.
    pub fn known(mut self, prior: Prior) -> Result<Self, IdentifyError> {
        if !(prior.mean.is_finite() && prior.deviation.is_finite() && prior.deviation > 0.0) {
            return Err(IdentifyError::Choice(format!(
                "the prior of {} is {} with the deviation {}; both are finite, and the deviation is positive",
                self.name, prior.mean, prior.deviation
            )));
        }
        self.prior = Some(prior);
        Ok(self)
    }
}

/// The name of an element, its number where it has none.
pub(crate) fn called(model: &Model, kind: ObjType, element: usize) -> String {
    match model.name_of(kind, element) {
        "" => format!("#{element}"),
        name => name.to_owned(),
    }
}

/// Parameters with their values, for messages.
pub(crate) fn valued(parameters: &[Parameter], values: &[f64]) -> String {
    let all: Vec<_> = parameters.iter().zip(values).map(|(p, x)| format!("{} = {x:.4e}", p.name)).collect();
    all.join(", ")
}
