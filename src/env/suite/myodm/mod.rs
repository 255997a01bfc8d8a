//! Muscle-driven hand and arm that follow recorded motions of objects.

mod reference;
pub(super) mod track;
