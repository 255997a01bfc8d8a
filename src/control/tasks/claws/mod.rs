//! ROBEL's D'Claw.

mod finger;
pub mod pose;
pub mod turn;
