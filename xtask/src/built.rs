//! What checks build, and how.

/// The profile of all checks, unless they check what is shipped: one compilation serves them.
pub const PROFILE: &str = "ci";

/// All packages but two that checks of their own build: the renderer that needs a GPU's interface, which takes minutes to
/// compile (`gpu`), and the extension module for Python (`python`). Encoders come with their networks.
pub const EVERYTHING: &[&str] = &[
    "--workspace",
    "--exclude",
    "robohive-render-gpu",
    "--exclude",
    "robohive-python",
    "--features",
    "robohive-encoders/networks",
];
