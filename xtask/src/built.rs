//! What checks build, and how.

use crate::command::succeed;
use std::process::Command;

/// The profile of all checks, unless they check what is shipped: one compilation serves them.
pub const PROFILE: &str = "ci";

/// All packages but six that checks of their own build: the renderer that needs a GPU's interface, the clients of devices, the
/// second solver, and the program in Bevy that uses it, which take minutes to compile (`gpu`, `clients`, `rapier`), the extension module for Python (`python`), and what makes the documentation
/// site (`site`). Encoders come with their networks.
pub const EVERYTHING: &[&str] = &[
    "--workspace",
    "--exclude",
    "robohive-render-gpu",
    "--exclude",
    "robohive-python",
    "--exclude",
    "robohive-site",
    "--exclude",
    "robohive-clients",
    "--exclude",
    "robohive-rapier",
    "--exclude",
    "robohive-bevy",
    "--features",
    "robohive-encoders/networks",
];

/// What makes any selection of packages need the same features of other people's crates as [`EVERYTHING`], so that it compiles
/// none of them again.
pub const SAME_FEATURES: [&str; 2] = ["-p", "workspace-hack"];

/// What draws by a GPU and opens windows, with the command that has both.
pub const GRAPHICS: &[&str] = &[
    "-p",
    "workspace-hack",
    "-p",
    "robohive-render-gpu",
    "-p",
    "robohive-validation",
    "-p",
    "robohive-viewer",
    "-p",
    "robohive-cli",
    "--features",
    "robohive-validation/gpu,robohive-viewer/window,robohive-cli/gpu,robohive-cli/window",
];

/// Builds rustdoc's pages of [`EVERYTHING`].
///
/// # Errors
/// Something is wrong in them.
pub fn document() -> Result<(), String> {
    let mut doc = Command::new("cargo");
    doc.args(["doc", "--profile", PROFILE]).args(EVERYTHING).arg("--no-deps");
    succeed(doc.env("RUSTDOCFLAGS", "-D warnings"))
}
