//! Numbers: a watched array, sensors, contacts.

use crate::session::Session;
use crate::watch::watch;
use eframe::egui::{Color32, DragValue, Ui};
use egui_plot::{Bar, BarChart, Plot};
use physics::model::ObjType;

/// What a person watches.
pub struct Inspection {
    name: String,
    index: usize,
}

impl Default for Inspection {
    fn default() -> Self {
        Inspection { name: "qpos".into(), index: 0 }
    }
}

/// A number by the name of its array.
pub fn watched(ui: &mut Ui, session: &Session, watched: &mut Inspection) {
    ui.horizontal(|ui| {
        ui.text_edit_singleline(&mut watched.name);
        ui.add(DragValue::new(&mut watched.index));
    });
    match watch(session.model(), session.data(), watched.name.trim(), watched.index) {
        Ok(value) => ui.monospace(format!("{value}")),
        Err(error) => ui.colored_label(ui.visuals().warn_fg_color, error.to_string()),
    };
}

/// Readings of all sensors, as bars.
pub fn sensors(ui: &mut Ui, session: &Session) {
    let (model, readings) = (session.model(), &session.data().sensor.sensordata);
    let charts = (0..model.nsensor).map(|sensor| {
        let first = model.sensor_adr[sensor] as usize;
        let bars = (first..first + model.sensor_dim[sensor] as usize)
            .map(|i| Bar::new(i as f64, readings[i]))
            .collect();
        BarChart::new(model.label_of(ObjType::Sensor, sensor), bars)
    });
    Plot::new("sensors").height(160.0).show(ui, |plot| charts.for_each(|chart| plot.bar_chart(chart)));
}

/// Pairs of geoms that touch.
pub fn contacts(ui: &mut Ui, session: &Session) {
    /// Most rows.
    const ROWS: usize = 50;
    let (model, contacts) = (session.model(), &session.data().con.contact);
    let name =
        |geom: i32| usize::try_from(geom).map_or("flex".into(), |geom| model.label_of(ObjType::Geom, geom));
    for contact in contacts.iter().take(ROWS) {
        let [a, b] = contact.geom;
        ui.label(format!("{} and {}: {:.6} m", name(a), name(b), contact.dist));
    }
    if contacts.len() > ROWS {
        ui.colored_label(Color32::GRAY, format!("and {} more", contacts.len() - ROWS));
    }
}
