//! Time: run, step, speed, history, keyframes, noise.

use crate::command::Command;
use crate::session::Session;
use eframe::egui::{Slider, Ui};
use physics::model::ObjType;

/// Buttons and sliders of the simulation.
pub fn simulation(ui: &mut Ui, session: &mut Session) {
    let mut command = None;
    let mut button = |ui: &mut Ui, name: &str, does| {
        if ui.button(name).clicked() {
            command = Some(does);
        }
    };
    ui.horizontal_wrapped(|ui| {
        button(ui, if session.is_running() { "Pause" } else { "Run" }, Command::Run);
        button(ui, "Step back", Command::StepBack);
        button(ui, "Step", Command::StepForward);
        button(ui, "Reset", Command::Reset);
    });
    ui.horizontal_wrapped(|ui| {
        button(ui, "Slower", Command::Slower);
        ui.label(format!("{} %", session.pace().percent()));
        button(ui, "Faster", Command::Faster);
    });
    if let Some(command) = command {
        session.perform(command);
    }
    history(ui, session);
    if session.play().is_some() {
        return;
    }
    keyframes(ui, session);
    ui.add(Slider::new(&mut session.noise.scale, 0.0..=1.0).text("noise scale"));
    ui.add(Slider::new(&mut session.noise.rate, 0.0..=4.0).text("noise time [s]"));
}

fn history(ui: &mut Ui, session: &mut Session) {
    let last = session.history().len().saturating_sub(1) as i64;
    let mut at = -(session.history().behind() as i64);
    if ui.add_enabled(last > 0, Slider::new(&mut at, -last.max(1)..=0).text("history")).changed() {
        session.show_past(at.unsigned_abs() as usize);
    }
}

fn keyframes(ui: &mut Ui, session: &mut Session) {
    let count = session.model().nkey;
    if count == 0 {
        return;
    }
    ui.menu_button("Load keyframe", |ui| {
        for key in 0..count {
            if ui.button(session.model().label_of(ObjType::Key, key)).clicked() {
                session.reset_to(Some(key));
                ui.close();
            }
        }
    });
}
