//! The window as a whole.

use super::canvas::canvas;
use super::episodes::{Making, trials_panel};
use super::exports::EXPORTS;
use super::film::Film;
use super::insets::{Insets, cameras_panel};
use super::keys::Keys;
use super::opened::Opened;
use super::overlay::overlay;
use super::painters::Painters;
use super::panels;
use super::program::Program;
use super::saving::{Save, into_working_folder};
use super::source::Source;
use super::steer::{Steering, steering_panel};
use crate::text;
use eframe::egui::{
    self, Align2, CentralPanel, CollapsingHeader, Context, Key, MenuBar, Modifiers, Panel, Rect, RichText,
    ScrollArea, Ui, ViewportCommand,
};
use std::time::Duration;
use video::{Frame as Pixels, png_bytes};
use web_time::Instant;

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
    /// What draws.
    pub(super) painters: Painters,
    /// What other cameras see, over the picture.
    pub(super) insets: Insets,
    /// Where screenshots and other files go.
    pub(super) save: Save,
    /// Where the picture was in the last frame \[point\].
    pub(super) area: Rect,
    /// The program whose window this is.
    pub(super) program: Option<Program>,
    keys: Keys,
    pub(super) desk: panels::Desk,
    /// The video that is being written.
    pub(super) film: Option<Film>,
    pub(super) steering: Steering,
    /// What makes the environments of recordings.
    pub(super) making: Making,
    shows_info: bool,
    pub(super) shows_left: bool,
    pub(super) shows_right: bool,
    shows_help: bool,
    last: Instant,
}

impl App {
    /// A viewer that renders on the CPU. It opens `source`, or starts empty.
    pub fn new(_context: &Context, source: Option<Source>) -> Self {
        App::drawn_by(Painters::default(), source)
    }

    /// A viewer that renders with `painters`. It opens `source`, or starts empty.
    pub fn drawn_by(painters: Painters, source: Option<Source>) -> Self {
        let mut app = App {
            opened: None,
            trouble: None,
            painters,
            insets: Insets::default(),
            save: Box::new(into_working_folder),
            area: Rect::NOTHING,
            program: None,
            keys: Keys::new(),
            desk: panels::Desk::default(),
            film: None,
            steering: Steering::default(),
            making: Making::default(),
            shows_info: false,
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

    /// Opens something else; where it cannot be opened, [`App::trouble`] says why, and what was open stays.
    pub fn open(&mut self, source: Source) {
        self.take(Opened::open(source));
    }

    /// Shows what was opened, or says why it could not be.
    pub(super) fn take(&mut self, opened: Result<Opened, String>) {
        match opened {
            Ok(opened) => {
                (self.opened, self.trouble) = (Some(opened), None);
                self.desk.forget();
                self.insets.forget();
                self.end_film();
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
            self.insets.forget();
            if self.trouble.is_none() {
                self.end_film();
            }
        }
    }

    /// Lets time go by, follows files, keys and what is dropped.
    fn advance(&mut self, context: &Context) {
        let elapsed = self.last.elapsed().as_secs_f64().min(LONGEST);
        self.last = Instant::now();
        self.receive(context);
        let path = context.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = path {
            self.open_path(&path);
        }
        self.general_keys(context);
        if self.opened.as_mut().is_some_and(Opened::is_outdated) {
            self.reload();
        }
        self.steer(context, elapsed);
        let Some(opened) = &mut self.opened else { return };
        if self.program.as_ref().is_none_or(|program| program.keys) {
            for command in self.keys.pressed(context, &self.steering.taken(&opened.session)) {
                opened.session.perform(command);
            }
        }
        let began = Instant::now();
        opened.session.advance(elapsed, &mut || began.elapsed().as_secs_f64() < SHARE * FRAME);
        self.desk.signals.measure(&opened.session);
        let moves = opened.session.is_running() || opened.session.holds();
        self.film_on();
        if moves {
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
        if pressed(Modifiers::NONE, Key::F2) {
            self.shows_info = !self.shows_info;
        }
        if pressed(Modifiers::NONE, Key::F5) {
            let full = context.input(|input| input.viewport().fullscreen.unwrap_or(false));
            context.send_viewport_cmd(ViewportCommand::Fullscreen(!full));
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

    /// Saves the picture as `screenshot.png`.
    fn screenshot(&mut self) {
        let Some(opened) = &mut self.opened else { return };
        let size = opened.screen.size();
        let png = opened.screen.picture(&opened.session, size).map_err(|error| error.to_string());
        let png = png.and_then(|picture| {
            let pixels = Pixels::new(picture.width as u32, picture.height as u32, &picture.rgb);
            pixels.map(|pixels| png_bytes(&pixels)).map_err(|error| error.to_string())
        });
        let saved =
            png.and_then(|png| (self.save)("screenshot.png", &png).map_err(|error| error.to_string()));
        self.trouble = saved.err();
    }

    fn menu(&mut self, ui: &mut Ui) {
        MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| {
                if !self.opened.as_ref().is_some_and(|opened| opened.session.is_following()) {
                    self.open_menu(ui, "Open a model of our own", Source::own());
                    self.open_menu(ui, "Play an environment of our own", Source::own_environments());
                }
                if ui.button("Reload  Ctrl+L").clicked() {
                    self.reload();
                }
                if ui.button("Screenshot  Ctrl+P").clicked() {
                    self.screenshot();
                }
                let filming = if self.film.is_some() { "Complete the video" } else { "Film" };
                if ui.button(filming).clicked() {
                    self.film();
                }
                for export in &EXPORTS {
                    if ui.button(export.name).clicked() {
                        self.export(export);
                        ui.close();
                    }
                }
                if ui.button("Copy state  Ctrl+C").clicked() {
                    self.copy_state(ui.ctx(), false);
                }
                if !cfg!(target_arch = "wasm32") && ui.button("Quit  Ctrl+Q").clicked() {
                    ui.ctx().send_viewport_cmd(ViewportCommand::Close);
                }
            });
            ui.menu_button("View", |ui| {
                ui.checkbox(&mut self.shows_left, "Left panel  Tab");
                ui.checkbox(&mut self.shows_right, "Right panel  Shift+Tab");
                ui.checkbox(&mut self.shows_info, "Info  F2");
                if self.painters.has_gpu() {
                    let mut uses_gpu = self.painters.uses_gpu();
                    ui.checkbox(&mut uses_gpu, "Draw by the GPU");
                    self.painters.use_gpu(uses_gpu);
                }
                egui::widgets::global_theme_preference_buttons(ui);
            });
            let siblings = self.opened.as_ref().map_or(&[][..], |opened| &opened.siblings);
            if siblings.len() > 1 {
                let chosen = ui.menu_button("Models", |ui| {
                    let clicked = |source: &&Source| ui.button(source.title()).clicked();
                    siblings.iter().find(clicked).cloned()
                });
                if let Some(source) = chosen.inner.flatten() {
                    self.open(source);
                }
            }
            if ui.button("Help").clicked() {
                self.shows_help = !self.shows_help;
            }
        });
    }

    fn open_menu(&mut self, ui: &mut Ui, title: &str, sources: impl Iterator<Item = Source>) {
        ui.menu_button(title, |ui| {
            for source in sources {
                if ui.button(source.title()).clicked() {
                    self.open(source);
                    ui.close();
                }
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
            let drawn = ui.label(format!("drawn by {}", self.painters.drawer_of(opened.screen.channel)));
            if !self.painters.reason().is_empty() {
                drawn.on_hover_text(self.painters.reason());
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
    (
        "Drop a file",
        "open a model, replay an .npz trajectory of it, or show the episodes of an .h5 recording",
    ),
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
        self.end_film();
        self.leave_program();
    }

    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
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
            let Opened { session, screen, episodes, .. } = opened;
            let mut wrong = Ok(());
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
                    }
                    if session.replay().is_some() || session.reference().is_some() {
                        section(ui, "Replay", true, |ui| {
                            if let Some(episodes) = episodes {
                                wrong = trials_panel(ui, session, episodes);
                            }
                            panels::replay(ui, session);
                        });
                    }
                    section(ui, "View", true, |ui| panels::visual(ui, session, &mut screen.channel));
                    if session.model().ncam > 0 {
                        section(ui, "Cameras", false, |ui| {
                            cameras_panel(ui, session.model(), &mut self.insets);
                        });
                    }
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
                        section(ui, "Actions", true, |ui| {
                            wrong = steering_panel(ui, &mut self.steering);
                            panels::actions(ui, session);
                        });
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
            if let Err(why) = wrong {
                self.trouble = Some(why);
            }
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
                match canvas(ui, opened, &mut self.painters) {
                    Ok(area) => {
                        self.area = area;
                        messages.extend(self.insets.show(ui, area, opened, &mut self.painters).err());
                        let frame = f64::from(ui.input(|input| input.stable_dt));
                        overlay(ui.painter(), area, &opened.session, frame, self.shows_info);
                    }
                    Err(why) => messages.push(why),
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
}
