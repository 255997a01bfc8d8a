//! The window: egui over a [`Session`](crate::Session).
//!
//! | part | what it does |
//! |---|---|
//! | `source` | where models and environments come from, and when files have changed |
//! | `opened` | a model that is open: its session and its picture |
//! | `painters` | the GPU of the window and the CPU, which draw pictures into textures |
//! | `channel` | colours, depth or objects |
//! | `screen` | the picture, drawn as finely as time allows |
//! | `saving` | where screenshots and other files go |
//! | `canvas` | the picture in the window, and gestures on it |
//! | `insets` | small pictures over it: what other cameras see |
//! | `keys` | keys to commands |
//! | `panels` | what stands beside the picture |
//! | `program_overlays` | texts, images and figures that a program lays over the picture |
//! | `glfw` | keys by the numbers that programs know |
//! | `app` | all of it |
//! | `program`, `remote`, `serve` | a window of another program |
//! | `beside` | files that are opened and written, videos, and actions that a person steers |
//! | `episodes`, `exports`, `film`, `steer`, `gamepad`, `overlay` | one of these each |
//! | `script` | what programs ask the window for |
//!
//! Nothing but `run` needs a window of the system: the time is asked of `web_time`, files are opened from memory too, and saved
//! by what the window is given.

mod app;
mod beside;
mod canvas;
mod channel;
mod episodes;
mod exports;
mod film;
mod gamepad;
mod glfw;
mod insets;
mod keys;
mod opened;
mod overlay;
mod painters;
mod panels;
mod program;
mod program_overlays;
mod remote;
mod saving;
mod screen;
mod script;
#[cfg(not(target_arch = "wasm32"))]
mod serve;
mod source;
mod steer;

pub use app::App;
pub use channel::Channel;
/// Its types are those of [`setup`] and [`Painters::of`].
pub use eframe;
pub use episodes::{Making, Recording};
pub use opened::Opened;
pub use painters::Painters;
pub use saving::Save;
#[cfg(not(target_arch = "wasm32"))]
pub use serve::{NoService, serve};
pub use source::{NoModel, Recipe, Source, States, Unopened};

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use render_gpu::wgpu;
use std::fmt;
use std::sync::Arc;

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

/// Opens a window that shows `source`, or nothing yet, and returns when it is closed. `making` makes the environments of
/// recordings that are dropped on it.
///
/// # Errors
/// There is no display, or nothing that draws on it.
#[cfg(not(target_arch = "wasm32"))]
pub fn run(source: Option<Source>, making: Making) -> Result<(), NoWindow> {
    open(move |made| {
        let mut app = App::drawn_by(Painters::of(made.wgpu_render_state.as_ref()), source);
        app.make_by(making);
        Some(app)
    })
}

/// Opens the window of an app, and returns when it is closed. Without an app, none stays open.
#[cfg(not(target_arch = "wasm32"))]
fn open(make: impl FnOnce(&eframe::CreationContext<'_>) -> Option<App>) -> Result<(), NoWindow> {
    let viewport = eframe::egui::ViewportBuilder::default()
        .with_title("RoboHive")
        .with_app_id("robohive")
        .with_inner_size([1280.0, 800.0])
        .with_drag_and_drop(true);
    let options =
        eframe::NativeOptions { viewport, wgpu_options: setup(), ..eframe::NativeOptions::default() };
    let create: eframe::AppCreator<'_> = Box::new(move |made| {
        let app = make(made).ok_or("there is nothing to show")?;
        Ok(Box::new(app))
    });
    eframe::run_native("RoboHive", options, create).map_err(|error| NoWindow(cause(&error.to_string())))
}

/// An error without the place in winit's sources that it names.
#[cfg(not(target_arch = "wasm32"))]
fn cause(error: &str) -> String {
    let os = error.split_once("os error at ").and_then(|(_, rest)| rest.split_once(": "));
    os.map_or(error, |(_, cause)| cause).trim_end_matches('.').to_owned()
}
