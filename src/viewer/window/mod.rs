//! The window: egui over a [`Session`](crate::Session).
//!
//! | part | what it does |
//! |---|---|
//! | `source` | where models and environments come from, and when files have changed |
//! | `opened` | a model that is open: its session and its picture |
//! | `painters` | the GPU of the window and the CPU, which draw pictures into textures |
//! | `screen` | the picture, drawn as finely as time allows |
//! | `saving` | where screenshots and other files go |
//! | `canvas` | the picture in the window, and gestures on it |
//! | `keys` | keys to commands |
//! | `panels` | what stands beside the picture |
//! | `app` | all of it |
//! | `beside` | files that are opened and written, videos, and actions that a person steers |
//! | `episodes`, `exports`, `film`, `steer`, `gamepad`, `overlay` | one of these each |
//! | `script` | what programs ask the window for |
//!
//! Nothing but `run` needs a window of the system: the time is asked of `web_time`, files are opened from memory too, and saved
//! by what the window is given.

mod app;
mod beside;
mod canvas;
mod episodes;
mod exports;
mod film;
mod gamepad;
mod keys;
mod opened;
mod overlay;
mod painters;
mod panels;
mod saving;
mod screen;
mod script;
mod source;
mod steer;

pub use app::App;
/// Its types are those of [`setup`] and [`Painters::of`].
pub use eframe;
pub use episodes::{Making, Recording};
pub use opened::Opened;
pub use painters::Painters;
pub use saving::Save;
pub use source::{NoModel, Recipe, Source};

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use render_gpu::wgpu;
use std::fmt;
use std::sync::Arc;

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

/// How a window or a page opens its GPU: with all that it offers, which pictures need.
pub fn setup() -> WgpuConfiguration {
    let limits = |adapter: &wgpu::Adapter| wgpu::DeviceDescriptor {
        label: Some("window"),
        required_limits: adapter.limits(),
        ..wgpu::DeviceDescriptor::default()
    };
    let setup = WgpuSetupCreateNew {
        device_descriptor: Arc::new(limits),
        ..WgpuSetupCreateNew::without_display_handle()
    };
    WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..WgpuConfiguration::default() }
}

/// Opens a window that shows `source`, or nothing yet, and returns when it is closed.
///
/// # Errors
/// There is no display, or nothing that draws on it.
#[cfg(not(target_arch = "wasm32"))]
pub fn run(source: Option<Source>) -> Result<(), NoWindow> {
    let viewport = eframe::egui::ViewportBuilder::default()
        .with_title("RoboHive")
        .with_app_id("robohive")
        .with_inner_size([1280.0, 800.0])
        .with_drag_and_drop(true);
    let options =
        eframe::NativeOptions { viewport, wgpu_options: setup(), ..eframe::NativeOptions::default() };
    let make = move |context: &eframe::CreationContext<'_>| {
        let painters = Painters::of(context.wgpu_render_state.as_ref());
        let app: Box<dyn eframe::App> = Box::new(App::drawn_by(painters, source));
        Ok(app)
    };
    eframe::run_native("RoboHive", options, Box::new(make)).map_err(|error| NoWindow(error.to_string()))
}
