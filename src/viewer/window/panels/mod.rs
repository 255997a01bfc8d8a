//! What stands beside the picture.

mod appearance;
mod controls;
mod desk;
mod inspect;
mod looked_at;
mod options;
mod play;
mod plots;
mod profiler;
mod recorded;
mod simulation;
mod visual;

pub use appearance::appearance;
pub use controls::{controls, equalities, joints, mocaps};
pub use desk::Desk;
pub use inspect::{contacts, sensors};
pub use looked_at::looked_at;
pub use options::options;
pub use play::{actions, episode, observation, reward};
pub use plots::{plots, watch_field};
pub use profiler::profiler;
pub use recorded::{recording, replay};
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
