//! The rows of elements outside of the tree: constraints, tendons, actuators, sensors, custom data.

mod actuator;
mod constraint;
mod custom;
mod sensor;
mod tendon;

pub(super) use constraint::sorted_names;
pub(crate) use sensor::{datatype, needstage};

use super::log::Log;
use super::lookup::Lookup;
use super::plugins::Plugins;
use crate::spec::Spec;
use physics::model::Rows;

/// Appends the rows of all kinds.
pub(super) fn fill(m: &mut Rows, (spec, plugins): (&Spec, &Plugins), lookup: &Lookup, log: &mut Log) {
    constraint::fill(m, spec, lookup, log);
    tendon::fill(m, spec, lookup, log);
    actuator::fill(m, (spec, plugins), lookup, log);
    sensor::fill(m, (spec, plugins), lookup, log);
    custom::fill(m, spec, lookup, log);
}
