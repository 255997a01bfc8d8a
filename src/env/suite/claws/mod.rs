//! Claws that turn an object in hand.

pub(super) mod reorient;
