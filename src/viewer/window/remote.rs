//! A window of another program: what it orders is done, and what a person does is reported to it.

use super::app::App;
use super::painters::Painters;
use super::program::Program;
use super::source::Source;
use crate::remote::{Link, Opening};
use eframe::egui::{Context, Rect, Ui, ViewportCommand};
use std::path::PathBuf;

impl App {
    /// A window of the program at the other end of `link`, which it has told to open with `opening`, drawn by `painters`.
    pub fn of_program(context: &Context, painters: Painters, link: Link, opening: &Opening) -> Self {
        let mut app = App::drawn_by(painters, None);
        app.program = Some(Program::new(link));
        app.open_for_program(context, opening);
        app
    }

    /// Whether this is the window of another program.
    pub fn has_program(&self) -> bool {
        self.program.is_some()
    }

    fn open_for_program(&mut self, context: &Context, opening: &Opening) {
        let Some(program) = &mut self.program else { return };
        (self.shows_left, self.shows_right) = (opening.left, opening.right);
        context.send_viewport_cmd(ViewportCommand::Title(opening.title.clone()));
        match program.open(opening).transpose() {
            Some(opened) => self.take(opened),
            None => {
                self.end_film();
                (self.opened, self.trouble) = (None, None);
            }
        }
        if let Some(path) = &opening.file {
            self.open(Source::File(PathBuf::from(path)));
            if let Some(opened) = &mut self.opened {
                opened.session.run(opening.runs);
            }
        }
    }

    /// Does what the program has ordered since the last frame, and tells it of keys.
    pub(super) fn receive(&mut self, context: &Context) {
        let Some(program) = &self.program else { return };
        let mut orders = program.orders();
        if let Some(opening) = orders.open.take() {
            self.open_for_program(context, &opening);
        }
        let Some(program) = &mut self.program else { return };
        program.hear(context);
        if let Err(why) = program.follow(context, self.opened.as_mut(), &mut orders) {
            self.trouble = Some(why);
        }
        if let Some(trouble) = orders.trouble {
            // An empty one says that all is well.
            self.trouble = Some(trouble).filter(|text| !text.is_empty());
        }
        if orders.close {
            context.send_viewport_cmd(ViewportCommand::Close);
        }
    }

    /// Asks the program, which waits for the window, for its model again. False where no program does.
    pub(super) fn asks_for_reload(&mut self) -> bool {
        let sent = self
            .opened
            .as_ref()
            .is_some_and(|opened| opened.is_a_programs() && !opened.session.is_following());
        match &mut self.program {
            Some(program) if sent => {
                program.ask_for_reload();
                true
            }
            _ => false,
        }
    }

    /// Shows what the program lays over the picture, which is at `area`.
    pub(super) fn show_overlays(&mut self, ui: &mut Ui, area: Rect) {
        if let Some(program) = &mut self.program {
            program.show_overlays(ui, area);
        }
    }

    /// Tells the program what a person has done in this frame.
    pub(super) fn report(&mut self) {
        if let Some(program) = &mut self.program {
            program.report(self.opened.as_ref());
        }
    }

    /// Takes leave of the program.
    pub(super) fn leave_program(&mut self) {
        if let Some(program) = self.program.take() {
            program.leave(self.opened.as_ref());
        }
    }
}
