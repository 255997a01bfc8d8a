//! The colour of what is seen: light on the corners of triangles, fragments painted, and the sky behind them.

mod lighting;
pub mod paint;
mod power;
pub mod seen;
mod shares;
pub mod sky;
pub mod transparency;
