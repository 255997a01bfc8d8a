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
//! | `app` | all of it |

mod app;
mod canvas;
mod keys;
mod opened;
mod panels;
mod screen;
mod source;

pub use app::App;
pub use source::{Recipe, Source};

use std::fmt;

/// Why there is no window.
#[derive(Debug)]
pub struct NoWindow(String);

impl fmt::Display for NoWindow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no window can be opened: {}; a window needs a display (DISPLAY or WAYLAND_DISPLAY) and OpenGL, Vulkan, Metal or \
             Direct3D; without one, `robohive render` draws pictures and `robohive sim --video` videos",
            self.0
        )
    }
}

impl std::error::Error for NoWindow {}

/// Opens a window that shows `source`, or nothing yet, and returns when it is closed.
///
/// # Errors
/// There is no display, or nothing that draws on it.
pub fn run(source: Option<Source>) -> Result<(), NoWindow> {
    let viewport = eframe::egui::ViewportBuilder::default()
        .with_title("RoboHive")
        .with_app_id("robohive")
        .with_inner_size([1280.0, 800.0])
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
    let make = move |context: &eframe::CreationContext<'_>| {
        let app: Box<dyn eframe::App> = Box::new(App::new(&context.egui_ctx, source));
        Ok(app)
    };
    eframe::run_native("RoboHive", options, Box::new(make)).map_err(|error| NoWindow(error.to_string()))
}
