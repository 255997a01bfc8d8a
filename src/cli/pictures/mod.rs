//! What draws, what is looked at, and the commands that draw.

pub mod bench_render;
pub mod drawing;
pub mod film;
pub mod framing;
pub mod gallery;
pub mod look;
pub mod preview;
pub mod render;
pub mod render_requests;
pub mod renderer;
pub mod solved;
pub mod studio;
pub mod subject;
pub mod thumbnail;
