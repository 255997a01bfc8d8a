//! The window as a whole.

use super::canvas::canvas;
use super::keys::Keys;
use super::opened::Opened;
use super::panels;
use super::program::Program;
use super::source::Source;
use crate::command::Command;
use crate::text;
use eframe::egui::{
    self, Align2, CentralPanel, CollapsingHeader, Context, Key, MenuBar, Modifiers, Panel, RichText,
    ScrollArea, Ui, ViewportCommand,
};
use std::time::{Duration, Instant};
use video::{Frame as Pixels, write_png};

/// What physics may take of a frame.
const SHARE: f64 = 0.7;
/// What a frame should take \[s\].
const FRAME: f64 = 1.0 / 60.0;
/// Longest time that is caught up with after a frame \[s\].
const LONGEST: f64 = 0.25;

/// The viewer.
pub struct App {
    pub(super) opened: Option<Opened>,
    /// What could not be opened, drawn or written, until something is.
    pub(super) trouble: Option<String>,
    /// The program whose window this is.
    pub(super) program: Option<Program>,
    keys: Keys,
    desk: panels::Desk,
    pub(super) shows_left: bool,
    pub(super) shows_right: bool,
    shows_help: bool,
    last: Instant,
}

impl App {
    /// A viewer of `source`, or of nothing yet.
    pub fn new(_context: &Context, source: Option<Source>) -> Self {
        let mut app = App {
            opened: None,
            trouble: None,
            program: None,
            keys: Keys::new(),
            desk: panels::Desk::default(),
            shows_left: true,
            shows_right: true,
            shows_help: false,
            last: Instant::now(),
        };
        if let Some(source) = source {
            app.open(source);
        }
        app
    }

    /// The model that is open.
    pub fn opened(&self) -> Option<&crate::Session> {
        self.opened.as_ref().map(|opened| &opened.session)
    }

    /// What went wrong last.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    pub(super) fn open(&mut self, source: Source) {
        match Opened::open(source) {
            Ok(opened) => {
                (self.opened, self.trouble) = (Some(opened), None);
                self.desk.forget();
            }
            Err(why) => self.trouble = Some(why),
        }
    }

    fn reload(&mut self) {
        if self.asks_for_reload() {
            return;
        }
        if let Some(opened) = &mut self.opened {
            self.trouble = opened.reload().err();
        }
    }

    /// Lets time go by, follows files, keys and what is dropped.
    fn advance(&mut self, context: &Context) {
        let elapsed = self.last.elapsed().as_secs_f64().min(LONGEST);
        self.last = Instant::now();
        self.receive(context);
        let dropped =
            context.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        let follows = self.opened.as_ref().is_some_and(|opened| opened.session.is_following());
        if let Some(path) = dropped.filter(|_| !follows) {
            self.open(Source::File(path));
        }
        self.general_keys(context);
        if self.opened.as_mut().is_some_and(Opened::is_outdated) {
            self.reload();
        }
        let Some(opened) = &mut self.opened else { return };
        if self.program.as_ref().is_none_or(|program| program.keys) {
            for command in self.keys.pressed(context) {
                opened.session.perform(command);
            }
        }
        let began = Instant::now();
        opened.session.advance(elapsed, &mut || began.elapsed().as_secs_f64() < SHARE * FRAME);
        self.desk.signals.measure(&opened.session);
        if opened.session.is_running() || opened.session.holds() {
            context.request_repaint();
        } else {
            context.request_repaint_after(Duration::from_millis(500));
        }
    }

    /// Keys of the window rather than of the session.
    fn general_keys(&mut self, context: &Context) {
        let pressed = |modifiers, key| context.input_mut(|input| input.consume_key(modifiers, key));
        if pressed(Modifiers::COMMAND, Key::L) {
            self.reload();
        }
        if pressed(Modifiers::COMMAND, Key::P) {
            self.screenshot();
        }
        if pressed(Modifiers::COMMAND, Key::Q) {
            context.send_viewport_cmd(ViewportCommand::Close);
        }
        if pressed(Modifiers::NONE, Key::F1) {
            self.shows_help = !self.shows_help;
        }
        if pressed(Modifiers::NONE, Key::Tab) {
            self.shows_left = !self.shows_left;
        }
        if pressed(Modifiers::SHIFT, Key::Tab) {
            self.shows_right = !self.shows_right;
        }
        let exact = context.input(|input| input.modifiers.shift);
        if context.input(|input| input.modifiers.command && input.key_pressed(Key::C)) {
            self.copy_state(context, exact);
        }
    }

    fn copy_state(&self, context: &Context, exact: bool) {
        if let Some(opened) = &self.opened {
            context.copy_text(text::key(opened.session.model(), opened.session.data(), exact));
        }
    }

    /// Writes the picture into `screenshot.png`, or the next free name.
    fn screenshot(&mut self) {
        let Some(opened) = &self.opened else { return };
        let picture = opened.screen.picture();
        let names =
            (0..).map(|i| if i == 0 { "screenshot.png".into() } else { format!("screenshot-{i}.png") });
        let Some(name) = names.take(10_000).find(|name| !std::path::Path::new(name).exists()) else { return };
        let written = Pixels::new(picture.width as u32, picture.height as u32, &picture.rgb)
            .and_then(|pixels| write_png(&name, &pixels));
        self.trouble = written.err().map(|error| format!("{name}: {error}"));
    }

    fn menu(&mut self, ui: &mut Ui) {
        MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| {
                ui.menu_button("Open a model of our own", |ui| {
                    for source in Source::own() {
                        if ui.button(source.title()).clicked() {
                            self.open(source);
                            ui.close();
                        }
                    }
                });
                ui.menu_button("Play an environment of our own", |ui| {
                    for source in Source::own_environments() {
                        if ui.button(source.title()).clicked() {
                            self.open(source);
                            ui.close();
                        }
                    }
                });
                if ui.button("Reload  Ctrl+L").clicked() {
                    self.reload();
                }
                if ui.button("Screenshot  Ctrl+P").clicked() {
                    self.screenshot();
                }
                if ui.button("Copy state  Ctrl+C").clicked() {
                    self.copy_state(ui.ctx(), false);
                }
                if ui.button("Quit  Ctrl+Q").clicked() {
                    ui.ctx().send_viewport_cmd(ViewportCommand::Close);
                }
            });
            ui.menu_button("View", |ui| {
                ui.checkbox(&mut self.shows_left, "Left panel  Tab");
                ui.checkbox(&mut self.shows_right, "Right panel  Shift+Tab");
                egui::widgets::global_theme_preference_buttons(ui);
            });
            if ui.button("Help").clicked() {
                self.shows_help = !self.shows_help;
            }
        });
    }

    fn status(&self, ui: &mut Ui) {
        let Some(opened) = &self.opened else {
            ui.label("Nothing is open");
            return;
        };
        let (session, data) = (&opened.session, opened.session.data());
        ui.horizontal(|ui| {
            ui.label(RichText::new(opened.source.title()).strong());
            let paused = match (session.is_running(), session.history().behind()) {
                _ if session.is_following() => "driven by a program".to_owned(),
                (true, _) => "running".to_owned(),
                (false, 0) => "paused".to_owned(),
                (false, behind) => format!("paused (-{behind})"),
            };
            ui.label(paused);
            ui.label(format!("{:.3} s", data.time()));
            ui.label(format!("{} contacts", data.con.contact.len()));
            if let Some(reached) = session.pace().reached().filter(|_| session.is_running()) {
                ui.label(format!("{} % ({reached:.1} %)", session.pace().percent()));
            }
            if let Some(selected) = session.selected() {
                ui.label(format!(
                    "selected: {}",
                    session.model().label_of(physics::model::ObjType::Body, selected.body)
                ));
            }
        });
    }

    fn help(&mut self, context: &Context) {
        egui::Window::new("Help").open(&mut self.shows_help).vscroll(true).show(context, |ui| {
            for (gesture, does) in GESTURES {
                ui.label(format!("{gesture}: {does}"));
            }
            ui.separator();
            egui::Grid::new("keys").striped(true).show(ui, |ui| {
                for (key, does) in self.keys.rows() {
                    ui.monospace(key);
                    ui.label(does);
                    ui.end_row();
                }
            });
        });
    }
}

/// What the pointer does.
const GESTURES: [(&str, &str); 9] = [
    ("Left drag", "orbit"),
    ("Right drag", "pan, with Shift in the horizontal plane"),
    ("Wheel or middle drag", "zoom"),
    ("Double click", "select a body"),
    ("Right double click", "look at a point"),
    ("Ctrl and right double click", "track a body"),
    ("Ctrl and left drag", "turn the selected body"),
    ("Ctrl and right drag", "pull the selected body, with Shift in the horizontal plane"),
    ("Drop a file", "open it"),
];

/// A section of a panel.
fn section(ui: &mut Ui, title: &str, open: bool, contents: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(title).default_open(open).show(ui, contents);
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }

    fn on_exit(&mut self) {
        self.leave();
    }
}

impl App {
    /// One frame: follows input, lets time go by, shows everything.
    pub fn show(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        self.advance(&context);
        Panel::top("menu").show(ui, |ui| self.menu(ui));
        Panel::bottom("status").show(ui, |ui| self.status(ui));
        if let Some(opened) = &mut self.opened {
            let session = &mut opened.session;
            Panel::left("left").default_size(240.0).show_collapsible(ui, &mut self.shows_left, |ui| {
                ScrollArea::vertical().show(ui, |ui| {
                    if !session.is_following() {
                        section(ui, "Simulation", true, |ui| panels::simulation(ui, session));
                    }
                    if session.play().is_some() {
                        section(ui, "Episode", true, |ui| panels::episode(ui, session));
                    }
                    if !session.is_following() {
                        section(ui, "Recording", false, |ui| panels::recording(ui, session, &mut self.desk));
                        section(ui, "Replay", session.replay().is_some(), |ui| panels::replay(ui, session));
                    }
                    section(ui, "View", true, |ui| panels::visual(ui, session));
                    section(ui, "Groups", false, |ui| panels::groups(ui, session));
                    section(ui, "Appearance", false, |ui| panels::appearance(ui, session));
                    if session.play().is_none() {
                        section(ui, "Physics", false, |ui| panels::options(ui, session));
                        section(ui, "Profiler", false, |ui| panels::profiler(ui, session));
                    }
                });
            });
            Panel::right("right").default_size(280.0).show_collapsible(ui, &mut self.shows_right, |ui| {
                ScrollArea::vertical().show(ui, |ui| {
                    if session.play().is_some() {
                        section(ui, "Reward", true, |ui| panels::reward(ui, session));
                        section(ui, "Actions", true, |ui| panels::actions(ui, session));
                        section(ui, "Observation", false, |ui| panels::observation(ui, session));
                    } else {
                        section(ui, "Controls", true, |ui| panels::controls(ui, session));
                        section(ui, "Joints", false, |ui| panels::joints(ui, session));
                        section(ui, "Equality", false, |ui| panels::equalities(ui, session));
                        section(ui, "Mocap", false, |ui| panels::mocaps(ui, session));
                    }
                    section(ui, "Element", false, |ui| panels::looked_at(ui, session, &mut self.desk));
                    section(ui, "Watch", false, |ui| panels::watch_field(ui, session, &mut self.desk));
                    section(ui, "Plots", false, |ui| panels::plots(ui, session, &mut self.desk));
                    section(ui, "Sensors", false, |ui| panels::sensors(ui, session));
                    section(ui, "Contacts", false, |ui| panels::contacts(ui, session));
                });
            });
        }
        CentralPanel::no_frame().show(ui, |ui| {
            let area = ui.max_rect();
            self.picture(ui);
            self.show_overlays(ui, area);
        });
        self.help(&context);
        self.report();
    }

    /// The picture, and messages over it.
    fn picture(&mut self, ui: &mut Ui) {
        let mut messages: Vec<String> = self.trouble.iter().chain(&self.desk.notice).cloned().collect();
        match &mut self.opened {
            Some(opened) => {
                messages.extend(opened.session.fault().map(str::to_owned));
                if let Err(why) = canvas(ui, opened) {
                    messages.push(why);
                }
                if !opened.warnings.is_empty() {
                    messages.push(opened.warnings.clone());
                }
            }
            None => {
                ui.centered_and_justified(|ui| ui.heading("Drop a model file here, or open one by File"));
            }
        }
        if !messages.is_empty() {
            egui::Window::new("Messages").anchor(Align2::LEFT_BOTTOM, [8.0, -8.0]).default_width(520.0).show(
                ui.ctx(),
                |ui| {
                    ScrollArea::vertical().max_height(200.0).show(ui, |ui| {
                        messages.iter().for_each(|message| drop(ui.monospace(message)));
                    });
                },
            );
        }
    }

    /// Does what a command says, as its key does.
    pub fn perform(&mut self, command: Command) {
        if let Some(opened) = &mut self.opened {
            opened.session.perform(command);
        }
    }
}
