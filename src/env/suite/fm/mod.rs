//! Arms with hands and grippers as they stand in laboratories.

pub(super) mod data;
pub(super) mod pose;
mod text_precision;
