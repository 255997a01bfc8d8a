//! The window: egui over a [`Session`](crate::Session).
//!
//! | part | what it does |
//! |---|---|
//! | `source` | where models and environments come from, and when files have changed |
//! | `opened` | a model that is open: its session and its picture |
//! | `screen` | the picture, drawn as finely as time allows |
//! | `canvas` | the picture in the window, and gestures on it |
//! | `keys` | keys to commands |
//! | `panels` | what stands beside the picture |
//! | `overlay` | texts, images and figures that a program lays over the picture |
//! | `glfw` | keys by the numbers that programs know |
//! | `app` | all of it |
//! | `program`, `remote`, `serve` | a window of another program |

mod app;
mod canvas;
mod glfw;
mod keys;
mod opened;
mod overlay;
mod panels;
mod program;
mod remote;
mod screen;
mod serve;
mod source;

pub use app::App;
pub use serve::{NoService, serve};
pub use source::{Recipe, Source};

use std::fmt;

/// Why there is no window.
#[derive(Debug)]
pub struct NoWindow(String);

impl NoWindow {
    /// What is missing.
    fn need(&self) -> String {
        format!(
            "no window can be opened: {}; a window needs a display (DISPLAY or WAYLAND_DISPLAY) and OpenGL, Vulkan, Metal or \
             Direct3D",
            self.0
        )
    }
}

impl fmt::Display for NoWindow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let need = self.need();
        write!(f, "{need}; without one, `robohive render` draws pictures and `robohive sim --video` videos")
    }
}

impl std::error::Error for NoWindow {}

/// Opens a window that shows `source`, or nothing yet, and returns when it is closed.
///
/// # Errors
/// There is no display, or nothing that draws on it.
pub fn run(source: Option<Source>) -> Result<(), NoWindow> {
    open(move |made| Some(App::new(&made.egui_ctx, source)))
}

/// Opens the window of an app, and returns when it is closed. Without an app, none stays open.
fn open(make: impl FnOnce(&eframe::CreationContext<'_>) -> Option<App>) -> Result<(), NoWindow> {
    let viewport = eframe::egui::ViewportBuilder::default()
        .with_title("RoboHive")
        .with_app_id("robohive")
        .with_inner_size([1280.0, 800.0])
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
    let create: eframe::AppCreator<'_> = Box::new(move |made| {
        let app = make(made).ok_or("there is nothing to show")?;
        Ok(Box::new(app))
    });
    eframe::run_native("RoboHive", options, create).map_err(|error| NoWindow(error.to_string()))
}
