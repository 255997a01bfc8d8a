//! What is shown: cameras, labels, frames, kinds, effects, groups.

use crate::command::{FRAMES, LABELS};
use crate::flags::{EFFECTS, Flag, SHOW};
use crate::session::Session;
use crate::text;
use eframe::egui::{ComboBox, Slider, Ui};
use physics::model::ObjType;
use render::scene::Camera;

/// Camera, labels, frames, switches.
pub fn visual(ui: &mut Ui, session: &mut Session) {
    camera(ui, session);
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
    session.camera = chosen;
    if ui.button("Copy camera").clicked()
        && let Ok(view) = session.view()
    {
        ui.ctx().copy_text(text::camera(&view));
    }
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
