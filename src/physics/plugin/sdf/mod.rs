//! Signed distance fields: MuJoCo's shapes by formula, and what a field must tell.
//!
//! The parts have the dimensions of MuJoCo's. The formulas of gear, bolt and nut are derived from the geometry of the parts
//! and agree with MuJoCo's to rounding; bowl and torus follow its plugins, and through them distance functions by Inigo
//! Quilez. Where surfaces meet they bound the distance from below rather than being exact.

mod fastener;
mod gear;
mod revolved;

pub(super) use fastener::{Bolt, Nut};
pub(super) use gear::Gear;
pub(super) use revolved::{Bowl, Torus};

use crate::math::Legible;
use crate::model::{AttributeError, Field, Instance};

/// Declares plugins that are a field and nothing else.
macro_rules! fields {
    ($($(#[$doc:meta])* $kind:ident = $name:literal { $($attribute:ident = $default:expr,)* } $field:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $kind;

        impl $kind {
            fn read(config: &crate::model::Config) -> Result<$field, crate::model::AttributeError> {
                let field = $field {
                    $($attribute: config.number(stringify!($attribute))?.unwrap_or($default),)*
                };
                field.check()?;
                Ok(field)
            }
        }

        impl crate::model::Plugin for $kind {
            fn name(&self) -> &str {
                $name
            }

            fn attributes(&self) -> &[&str] {
                &[$(stringify!($attribute),)*]
            }

            fn capabilities(&self) -> &[crate::model::Capability] {
                &[crate::model::Capability::Sdf]
            }

            fn field(
                &self,
                config: &crate::model::Config,
            ) -> Result<Option<Box<dyn crate::model::Field>>, crate::model::AttributeError> {
                Ok(Some(Box::new($kind::read(config)?)))
            }

            fn instance(
                &self,
                config: &crate::model::Config,
                _: &crate::model::Model,
                _: usize,
            ) -> Result<Box<dyn crate::model::Instance>, crate::model::AttributeError> {
                Ok(Box::new(crate::plugin::sdf::Solid($kind::read(config)?)))
            }
        }
    )*};
}
use fields;

/// An instance that is a field.
#[derive(Debug)]
struct Solid<F>(F);

impl<F: Field> Instance for Solid<F> {
    fn field(&self) -> Option<&dyn Field> {
        Some(&self.0)
    }
}

/// Refuses a length that is not positive.
fn positive(name: &str, value: f64) -> Result<(), AttributeError> {
    if value > 0.0 {
        return Ok(());
    }
    Err(format!("attribute '{name}' is {}: a positive number is needed", Legible(value)).into())
}

/// What lies in either.
fn union(a: f64, b: f64) -> f64 {
    if a <= b { a } else { b }
}

/// What lies in both.
fn intersection(a: f64, b: f64) -> f64 {
    if a >= b { a } else { b }
}

/// What of the first lies outside the second.
fn subtraction(a: f64, b: f64) -> f64 {
    intersection(a, -b)
}

/// Length of a vector in the plane.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}
