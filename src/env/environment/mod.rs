//! An environment: how it is made, reset and stepped, what it shows, and its states.

mod description;
mod drawing;
mod env;
mod hardware;
mod images;
mod live;
mod look;
mod memory;
mod options;
mod parts;
mod paths;
mod state;

pub use env::{Env, Step};
pub use hardware::{Hardware, OpenCameras, Ready};
pub use memory::EnvMemory;
pub use options::Options;
pub use paths::PathReward;
pub use state::{EnvState, Injected, WorldState};
