//! The program whose window this is.

use super::glfw;
use super::opened::Opened;
use super::program_overlays::{Overlays, place_of};
use crate::remote::{Link, Opening, Orders, Report};
use eframe::egui::{Context, Event, Rect, Ui};

/// A program at the other end of a link, and what it lays over the picture.
pub struct Program {
    link: Link,
    /// Whether keys do something in the window.
    pub keys: bool,
    overlays: Overlays,
}

impl Program {
    /// The program at the other end of `link`.
    pub fn new(link: Link) -> Self {
        Program { link, keys: true, overlays: Overlays::default() }
    }

    /// What has been ordered since the last call.
    pub fn orders(&self) -> Orders {
        self.link.orders()
    }

    /// The model that the program sends; `None` where it sends none.
    ///
    /// # Errors
    /// It cannot be read, evaluated or drawn.
    pub(super) fn open(&mut self, opening: &Opening) -> Result<Option<Opened>, String> {
        self.keys = opening.keys;
        let session = self.link.open(opening).map_err(|error| error.to_string())?;
        session.map(|session| Opened::of_program(session, &opening.title)).transpose()
    }

    /// Does what was ordered, but for messages and closing.
    ///
    /// # Errors
    /// An order does not fit the model that is open.
    pub(super) fn follow(
        &mut self,
        context: &Context,
        opened: Option<&mut Opened>,
        orders: &mut Orders,
    ) -> Result<(), String> {
        if let Some(figures) = orders.figures.take() {
            self.overlays.figures = figures;
        }
        if let Some(texts) = orders.texts.take() {
            self.overlays.texts = texts;
        }
        if let Some(images) = orders.images.take() {
            self.overlays.set_images(context, &images);
        }
        match opened.filter(|opened| opened.is_a_programs()) {
            Some(opened) => self.link.follow(&mut opened.session, orders).map_err(|error| error.to_string()),
            None => Ok(()),
        }
    }

    /// Tells it of the keys that were pressed since the last frame, unless a person types text.
    pub fn hear(&mut self, context: &Context) {
        if context.egui_wants_keyboard_input() {
            return;
        }
        for event in context.input(|input| input.events.clone()) {
            if let Event::Key { key, physical_key, pressed: true, repeat: false, .. } = event
                && let Some(code) = glfw::code(physical_key.unwrap_or(key))
            {
                self.link.tell(&Report::Key(code));
            }
        }
    }

    /// Asks it for its model again.
    pub fn ask_for_reload(&mut self) {
        self.link.tell(&Report::Reload);
    }

    /// Shows what it lays over the picture, which is at `area`.
    pub fn show_overlays(&mut self, ui: &mut Ui, area: Rect) {
        self.overlays.show(ui, area);
        self.link.report_place(place_of(ui.ctx(), area));
    }

    /// Tells it what a person has done in this frame.
    pub fn report(&mut self, opened: Option<&Opened>) {
        if let Some(opened) = opened.filter(|opened| opened.is_a_programs()) {
            self.link.report(&opened.session);
        }
    }

    /// Takes leave.
    pub fn leave(mut self, opened: Option<&Opened>) {
        let opened = opened.filter(|opened| opened.is_a_programs());
        self.link.leave(opened.map(|opened| &opened.session));
    }
}
