//! A process that is the window of another one.

use super::{App, NoWindow, Painters, open};
use crate::remote::{Link, Report, WireError};
use eframe::egui::Context;
use std::cell::RefCell;
use std::fmt;
use std::io::{Read, Write};
use std::rc::Rc;
use std::sync::{Arc, OnceLock};

/// Why a process is no window of another one.
#[derive(Debug)]
#[non_exhaustive]
pub enum NoService {
    /// There is no program at the other end, or one of another version.
    Program(WireError),
    /// No window can be opened, as the program was told.
    Window(NoWindow),
}

impl fmt::Display for NoService {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoService::Program(error) => {
                write!(f, "no program asks for a window on the standard input: {error}")
            }
            NoService::Window(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for NoService {}

/// Opens the window that the program at the other end of `from` and `to` asks for, and returns when it is closed. Windows
/// belong to the main thread of a process.
///
/// # Errors
/// There is no program there, or no window, of which the program is told.
pub fn serve(from: impl Read + Send + 'static, to: impl Write + Send + 'static) -> Result<(), NoService> {
    let shown: Arc<OnceLock<Context>> = Arc::default();
    let wakes = Arc::clone(&shown);
    let wake = move || {
        if let Some(context) = wakes.get() {
            context.request_repaint();
        }
    };
    let Some(met) = Link::meet(from, to, wake).map_err(NoService::Program)? else { return Ok(()) };
    let waiting = Rc::new(RefCell::new(Some(met)));
    let taken = Rc::clone(&waiting);
    let opened = open(move |made| {
        let (mut link, opening) = taken.borrow_mut().take()?;
        link.tell(&Report::Ready);
        let painters = Painters::of(made.wgpu_render_state.as_ref());
        let _ = shown.set(made.egui_ctx.clone());
        Some(App::of_program(&made.egui_ctx, painters, link, &opening))
    });
    opened.map_err(|error| {
        if let Some((mut link, _)) = waiting.borrow_mut().take() {
            link.tell(&Report::Failed(error.need()));
        }
        NoService::Window(error)
    })
}
