//! What stands beside the picture.

mod controls;
mod inspect;
mod options;
mod play;
mod simulation;
mod visual;

pub use controls::{controls, equalities, joints};
pub use inspect::{Inspection, contacts, sensors, watched};
pub use options::options;
pub use play::{actions, episode, observation, reward};
pub use simulation::simulation;
pub use visual::{groups, visual};

use eframe::egui::{Grid, Ui};

/// Names and what they stand for, line by line.
fn table<'a>(ui: &mut Ui, id: &str, lines: impl IntoIterator<Item = (&'a str, String)>) {
    Grid::new(id).striped(true).num_columns(2).show(ui, |ui| {
        for (name, text) in lines {
            ui.label(name);
            ui.monospace(text);
            ui.end_row();
        }
    });
}
