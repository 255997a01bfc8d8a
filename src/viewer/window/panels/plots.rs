//! Numbers over time, as lines.

use super::desk::Desk;
use crate::session::Session;
use crate::signals::{Signal, Signals};
use crate::watch::watch;
use eframe::egui::{Button, DragValue, Ui};
use egui_plot::{Legend, Line, Plot, PlotPoints};
use physics::model::Enable;

/// What is followed, and its lines.
pub fn plots(ui: &mut Ui, session: &mut Session, desk: &mut Desk) {
    ui.horizontal_wrapped(|ui| {
        if session.play().is_some() {
            choice(ui, &mut desk.signals, "Reward", Signal::Reward);
            choice(ui, &mut desk.signals, "Return", Signal::Return);
        } else {
            energies(ui, session, &mut desk.signals);
        }
        if session.reference().is_some() {
            choice(ui, &mut desk.signals, "Difference", Signal::Difference);
        }
    });
    ui.horizontal_wrapped(|ui| {
        sensors(ui, session, &mut desk.signals);
        watched(ui, session, desk);
    });
    let followed: Vec<Signal> = desk.signals.series().iter().map(|series| series.signal().clone()).collect();
    for signal in followed {
        let mut on = true;
        if matches!(signal, Signal::Sensor(..) | Signal::Watched(..))
            && ui.checkbox(&mut on, signal.name(session)).changed()
        {
            desk.signals.follow(signal, on);
        }
    }
    if desk.signals.series().is_empty() {
        return;
    }
    let plot = Plot::new("signals").height(180.0).legend(Legend::default()).x_axis_label("time [s]");
    plot.show(ui, |plot| {
        for series in desk.signals.series() {
            let points: PlotPoints<'_> = series.points().collect();
            plot.line(Line::new(series.signal().name(session), points));
        }
    });
}

/// A switch that follows a signal.
fn choice(ui: &mut Ui, signals: &mut Signals, name: &str, signal: Signal) {
    let mut on = signals.follows(&signal);
    if ui.checkbox(&mut on, name).changed() {
        signals.follow(signal, on);
    }
}

/// Energies are computed once one of them is followed.
fn energies(ui: &mut Ui, session: &mut Session, signals: &mut Signals) {
    let names = [("Energy", Signal::Energy), ("Potential", Signal::Potential), ("Kinetic", Signal::Kinetic)];
    let mut wanted = false;
    for (name, signal) in names {
        choice(ui, signals, name, signal.clone());
        wanted |= signals.follows(&signal);
    }
    if wanted && !session.model().opt.enableflags.contains(Enable::ENERGY) {
        session.edit_options(|options| options.enableflags.set(Enable::ENERGY, true));
    }
}

fn sensors(ui: &mut Ui, session: &Session, signals: &mut Signals) {
    let model = session.model();
    if model.nsensor == 0 {
        return;
    }
    ui.menu_button("Sensors", |ui| {
        for sensor in 0..model.nsensor {
            for place in 0..model.sensor_dim[sensor] as usize {
                let signal = Signal::Sensor(sensor, place);
                choice(ui, signals, &signal.name(session), signal);
            }
        }
    });
}

/// Follows the number that is watched.
fn watched(ui: &mut Ui, session: &Session, desk: &mut Desk) {
    let there = watch(session.model(), session.data(), desk.watched.name.trim(), desk.watched.index).is_ok();
    let signal = Signal::Watched(desk.watched.name.trim().to_owned(), desk.watched.index);
    let button = Button::new(format!("Follow {}[{}]", desk.watched.name, desk.watched.index));
    if ui.add_enabled(there && !desk.signals.follows(&signal), button).clicked() {
        desk.signals.follow(signal, true);
    }
}

/// A number by the name of its array.
pub fn watch_field(ui: &mut Ui, session: &Session, desk: &mut Desk) {
    let watched = &mut desk.watched;
    ui.horizontal(|ui| {
        ui.text_edit_singleline(&mut watched.name);
        ui.add(DragValue::new(&mut watched.index));
    });
    match watch(session.model(), session.data(), watched.name.trim(), watched.index) {
        Ok(value) => ui.monospace(format!("{value}")),
        Err(error) => ui.colored_label(ui.visuals().warn_fg_color, error.to_string()),
    };
}
