//! From the world to the window: projections, what is cut away, and which samples a triangle covers.

pub mod clip;
pub mod coverage;
pub mod lens;
pub mod projection;
pub mod vertices;
