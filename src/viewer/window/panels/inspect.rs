//! Numbers: sensors, contacts.

use crate::session::Session;
use eframe::egui::{Color32, Ui};
use egui_plot::{Bar, BarChart, Plot};
use physics::model::ObjType;

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
