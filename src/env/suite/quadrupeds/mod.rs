//! Four-legged robots.

pub(super) mod free_walk;
mod kitty;
pub(super) mod orient;
pub(super) mod stand;
pub(super) mod walk;
