//! Signed distance fields: MuJoCo's shapes by formula, and what a field must tell.
//!
//! The formulas are those of MuJoCo's plugins, from shaders by Inigo Quilez (bowl, torus) and others (bolt and nut:
//! shadertoy.com/view/XtffzX, gear: shadertoy.com/view/3lG3WR). They bound the distance from below rather than being exact.

mod fastener;
mod gear;
mod revolved;

pub(super) use fastener::{Bolt, Nut};
pub(super) use gear::Gear;
pub(super) use revolved::{Bowl, Torus};

use super::Instance;
use crate::math::Vec3;
use std::fmt::Debug;

/// A signed distance field in its own frame [m].
pub trait Field: Debug + Send + Sync {
    /// Distance of `point` from the surface, negative inside.
    fn distance(&self, point: Vec3) -> f64;

    /// Slope of the distance at `point`; forward differences where a field knows no better.
    fn gradient(&self, point: Vec3) -> Vec3 {
        const STEP: f64 = 1e-8;
        let here = self.distance(point);
        std::array::from_fn(|k| {
            let mut moved = point;
            moved[k] += STEP;
            (self.distance(moved) - here) / STEP
        })
    }

    /// A box around the surface: centre, half sizes.
    fn bounds(&self) -> [f64; 6];
}

/// Declares plugins that are a field and nothing else.
macro_rules! fields {
    ($($(#[$doc:meta])* $kind:ident = $name:literal { $($attribute:ident = $default:expr,)* } $field:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $kind;

        impl $kind {
            fn read(config: &crate::plugin::Config) -> Result<$field, crate::plugin::AttributeError> {
                Ok($field {
                    $($attribute: config.number(stringify!($attribute))?.unwrap_or($default),)*
                })
            }
        }

        impl crate::plugin::Plugin for $kind {
            fn name(&self) -> &str {
                $name
            }

            fn attributes(&self) -> &[&str] {
                &[$(stringify!($attribute),)*]
            }

            fn capabilities(&self) -> &[crate::plugin::Capability] {
                &[crate::plugin::Capability::Sdf]
            }

            fn field(
                &self,
                config: &crate::plugin::Config,
            ) -> Result<Option<Box<dyn crate::plugin::Field>>, crate::plugin::AttributeError> {
                Ok(Some(Box::new($kind::read(config)?)))
            }

            fn instance(
                &self,
                config: &crate::plugin::Config,
                _: &crate::Model,
                _: usize,
            ) -> Result<Box<dyn crate::plugin::Instance>, crate::plugin::AttributeError> {
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
