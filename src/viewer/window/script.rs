//! What a program asks the window for: the page around it, and tests.

use super::app::App;
use super::episodes::Making;
use super::opened::Opened;
use super::saving::Save;
use super::source::Source;
use crate::command::{Command, shortcuts};
use crate::session::Session;
use eframe::egui::Rect;
use mjcf::Loaded;
use render::{Picture, RenderError};

impl App {
    /// Shows a model that was read of `source`, as [`App::open`] does.
    pub fn open_loaded(&mut self, source: Source, loaded: Loaded) {
        let session = Session::new(loaded.model).map_err(|error| error.to_string());
        self.take(session.and_then(|session| Opened::with(source, session, loaded.warnings.to_string())));
    }

    /// The model that is open.
    pub fn opened(&self) -> Option<&Session> {
        self.opened.as_ref().map(|opened| &opened.session)
    }

    /// The same, to be stepped and changed.
    pub fn opened_mut(&mut self) -> Option<&mut Session> {
        self.opened.as_mut().map(|opened| &mut opened.session)
    }

    /// What went wrong last.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Lets go of what is open, for another window.
    pub fn leave(&mut self) -> Option<Opened> {
        self.opened.take()
    }

    /// Goes on with what another window has left.
    pub fn resume(&mut self, left: Option<Opened>) {
        self.opened = left;
        if let Some(opened) = &mut self.opened {
            opened.screen.forget();
        }
        self.insets.forget();
    }

    /// Shows what a camera sees over the picture.
    pub fn show_camera(&mut self, name: &str) {
        self.insets.choose(name);
    }

    /// The cameras whose pictures lie over the picture, by name, and where \[point\].
    pub fn insets(&self) -> impl Iterator<Item = (&str, Rect)> {
        self.insets.shown()
    }

    /// The same, which is then forgotten.
    pub fn take_trouble(&mut self) -> Option<String> {
        self.trouble.take()
    }

    /// Does what a command says, as its key does.
    pub fn perform(&mut self, command: Command) {
        if let Some(opened) = &mut self.opened {
            opened.session.perform(command);
        }
    }

    /// Does what a command of this name says, see [`shortcuts`]. False where there is none.
    pub fn perform_named(&mut self, name: &str) -> bool {
        let found = shortcuts().into_iter().find(|shortcut| shortcut.name == name);
        found.map(|shortcut| self.perform(shortcut.command)).is_some()
    }

    /// Lets `making` make the environments of recordings that are opened.
    pub fn make_by(&mut self, making: Making) {
        self.making = making;
    }

    /// Sends screenshots and other files elsewhere than into the working folder.
    pub fn save_by(&mut self, save: Save) {
        self.save = save;
    }

    /// Where the picture was in the last frame \[point\].
    pub fn area(&self) -> Rect {
        self.area
    }

    /// What draws, and why it is not the GPU.
    pub fn drawn(&self) -> (String, &str) {
        (self.painters.name(), self.painters.reason())
    }

    /// Lets the GPU draw, where there is one, or the CPU.
    pub fn use_gpu(&mut self, wanted: bool) {
        self.painters.use_gpu(wanted);
    }

    /// The picture of the present state as the CPU draws it, `size` pixels wide and high; nothing where nothing is open.
    ///
    /// # Errors
    /// The camera or an item has no place; the size is zero or too large.
    pub fn drawn_by_cpu(&mut self, size: [usize; 2]) -> Result<Option<Picture>, RenderError> {
        let Some(opened) = &mut self.opened else { return Ok(None) };
        opened.screen.picture(&opened.session, size).map(Some)
    }

    /// Columns and rows of the window that the picture takes \[pixel\].
    pub fn size(&self) -> [usize; 2] {
        self.opened.as_ref().map_or([0; 2], |opened| opened.screen.size())
    }

    /// The picture that the GPU has shown last, bytes R, G, B, A of each pixel from the top.
    ///
    /// # Errors
    /// The GPU failed.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read_gpu(&mut self) -> Result<Option<Vec<u8>>, render_gpu::GpuError> {
        let size = self.size();
        self.painters.read_gpu(size)
    }

    /// Columns and rows of the last small picture \[pixel\].
    #[cfg(not(target_arch = "wasm32"))]
    pub fn inset_size(&self) -> Option<[usize; 2]> {
        self.insets.size()
    }

    /// The small picture that the GPU has drawn last, bytes R, G, B, A of each pixel from the top.
    ///
    /// # Errors
    /// The GPU failed.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read_gpu_inset(&mut self) -> Result<Option<Vec<u8>>, render_gpu::GpuError> {
        let size = self.inset_size();
        Ok(size.map(|size| self.painters.read_gpu_sheet(size)).transpose()?.flatten())
    }

    /// A sentence on what is shown, for those who do not see it.
    pub fn summary(&self) -> String {
        let Some(opened) = &self.opened else { return "Nothing is open".into() };
        let session = &opened.session;
        let (title, data) = (opened.source.title(), session.data());
        if session.is_running() {
            return format!("{title}, running");
        }
        format!("{title}, paused at {:.3} s, {} contacts", data.time(), data.con.contact.len())
    }
}
