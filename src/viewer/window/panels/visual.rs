//! What is shown: cameras, labels, frames, kinds, effects, groups.

use crate::command::{FRAMES, LABELS};
use crate::flags::{EFFECTS, Flag, SHOW};
use crate::session::Session;
use crate::text;
use crate::window::channel::{CHANNELS, Channel};
use eframe::egui::{ComboBox, DragValue, Slider, Ui};
use physics::model::ObjType;
use render::scene::{Camera, FreeCamera};

/// Camera, what of the scene is seen, labels, frames, switches.
pub fn visual(ui: &mut Ui, session: &mut Session, channel: &mut Channel) {
    camera(ui, session);
    choice(ui, "Picture", &CHANNELS, channel);
    let options = &mut session.options;
    choice(ui, "Label", &LABELS, &mut options.label);
    choice(ui, "Frame", &FRAMES, &mut options.frame);
    ui.add(Slider::new(&mut options.tree_depth, 0..=20).text("tree depth"));
    ui.add(Slider::new(&mut options.flex_layer, 0..=10).text("flex layer"));
    ui.collapsing("Shown", |ui| switches(ui, &SHOW, &mut options.show));
    ui.collapsing("Effects", |ui| switches(ui, &EFFECTS, &mut options.effects));
}

fn camera(ui: &mut Ui, session: &mut Session) {
    let name = |camera: Camera| match camera {
        Camera::Free(free) if free.track.is_some() => "Tracking".to_owned(),
        Camera::Free(_) => "Free".to_owned(),
        Camera::Fixed(camera) => session.model().label_of(ObjType::Camera, camera),
    };
    let mut chosen = session.camera;
    let free = match chosen {
        Camera::Free(_) => chosen,
        Camera::Fixed(_) => Camera::free(session.model()),
    };
    ComboBox::from_label("Camera").selected_text(name(chosen)).show_ui(ui, |ui| {
        ui.selectable_value(&mut chosen, free, name(free));
        for camera in (0..session.model().ncam).map(Camera::Fixed) {
            ui.selectable_value(&mut chosen, camera, name(camera));
        }
    });
    if let Camera::Free(free) = &mut chosen {
        free_camera(ui, free);
    }
    session.camera = chosen;
    if ui.button("Copy camera").clicked()
        && let Ok(view) = session.view()
    {
        ui.ctx().copy_text(text::camera(&view));
    }
}

/// Where the free camera looks from.
fn free_camera(ui: &mut Ui, free: &mut FreeCamera) {
    ui.collapsing("Free camera", |ui| {
        let mut row = |name: &str, value: &mut f64, speed: f64, range: std::ops::RangeInclusive<f64>| {
            ui.horizontal(|ui| {
                ui.add(DragValue::new(value).speed(speed).range(range).max_decimals(4));
                ui.label(name);
            });
        };
        row("azimuth [°]", &mut free.azimuth, 0.5, -1e6..=1e6);
        row("elevation [°]", &mut free.elevation, 0.5, -89.0..=89.0);
        row("distance [m]", &mut free.distance, 0.01, 1e-6..=1e9);
        row("field of view [°, m]", &mut free.fovy, 0.2, 1e-3..=179.0);
        for (axis, value) in ["x [m]", "y [m]", "z [m]"].into_iter().zip(&mut free.lookat) {
            row(axis, value, 0.01, -1e9..=1e9);
        }
        ui.checkbox(&mut free.orthographic, "orthographic");
    });
}

fn choice<T: Copy + PartialEq>(ui: &mut Ui, label: &str, list: &[(&str, T)], value: &mut T) {
    let name = list.iter().find(|(_, each)| each == value).map_or("", |(name, _)| name);
    ComboBox::from_label(label).selected_text(name).show_ui(ui, |ui| {
        for (name, each) in list {
            ui.selectable_value(value, *each, *name);
        }
    });
}

fn switches<T: Copy>(ui: &mut Ui, list: &[Flag<T>], all: &mut T) {
    for flag in list {
        let response = ui.checkbox(flag.of(all), flag.name);
        if let Some(key) = flag.key {
            response.on_hover_text(format!("key {key}"));
        }
    }
}

/// Groups of every kind of element.
pub fn groups(ui: &mut Ui, session: &mut Session) {
    let groups = &mut session.options.groups;
    let kinds = [
        ("Geoms", &mut groups.geoms),
        ("Sites", &mut groups.sites),
        ("Joints", &mut groups.joints),
        ("Tendons", &mut groups.tendons),
        ("Actuators", &mut groups.actuators),
        ("Flexes", &mut groups.flexes),
        ("Skins", &mut groups.skins),
    ];
    for (name, visible) in kinds {
        ui.horizontal(|ui| {
            for (group, on) in visible.iter_mut().enumerate() {
                ui.toggle_value(on, group.to_string()).on_hover_text(format!("{name} of group {group}"));
            }
            ui.label(name);
        });
    }
}
