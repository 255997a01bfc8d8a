//! What the command says of its version.

/// The version of MuJoCo whose motion is followed.
macro_rules! mujoco {
    () => {
        "3.12.0"
    };
}

/// Version of MuJoCo that the physics follows.
pub const MUJOCO: &str = mujoco!();

/// Version, commit where it is known, and version of MuJoCo.
pub const VERSION: &str =
    concat!(env!("CARGO_PKG_VERSION"), " (", env!("ROBOHIVE_FOLLOWS"), " MuJoCo ", mujoco!(), ")");
