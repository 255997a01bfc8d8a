//! A kitchen and its appliances.

pub(super) mod appliance;
mod chore;
pub(super) mod kitchen;
