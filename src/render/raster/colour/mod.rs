//! The colour of what is seen: light on the corners of triangles, fragments painted, and the sky behind them.

mod lighting;
pub mod paint;
mod power;
pub mod seen;
pub mod sky;
pub mod transparency;
