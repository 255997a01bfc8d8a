//! Windows: a process of its own each, which this one tells what to show.
//!
//! | file | what |
//! |---|---|
//! | `class.rs` | the window as Python holds it |
//! | `arguments.rs` | what Python says of cameras, options and overlays, and back |
//! | `serve.rs` | what the window's own process calls |

mod arguments;
mod class;
mod serve;

pub use arguments::effect_names;
pub use class::PyWindow;
pub use serve::serve_window;
