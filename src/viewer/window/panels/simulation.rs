//! Time: run, step, speed, history, keyframes, kept states, noise.

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
    if session.replay().is_some() {
        return;
    }
    keyframes(ui, session);
    kept_keys(ui, session);
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

/// States that a person keeps, to return to and to copy into a model.
fn kept_keys(ui: &mut Ui, session: &mut Session) {
    ui.horizontal_wrapped(|ui| {
        if ui.button("Keep state").clicked() {
            session.keep_key();
        }
        if session.kept_keys().is_empty() {
            return;
        }
        ui.menu_button("Load kept state", |ui| {
            for number in 0..session.kept_keys().len() {
                let time = session.kept_keys()[number].time();
                if ui.button(format!("{number}: {time:.3} s")).clicked() {
                    session.load_key(number);
                    ui.close();
                }
            }
        });
        if ui.button("Copy kept states").clicked() {
            ui.ctx().copy_text(session.keys_text());
        }
    });
}
