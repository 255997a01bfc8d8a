//! Hands that move things: plans by sampling, a cost for each task. A soft ball is squeezed by what is measured of it.

pub mod baoding;
pub mod pen;
pub mod reorient;
mod search;
pub mod soft_ball;
