//! The visualisation options of a model, edited while it is seen.

use crate::session::Session;
use eframe::egui::{CollapsingHeader, Color32, DragValue, Rgba, Ui};
use physics::model::Visual;

/// Groups of `<visual>` that can be edited; sizes of pictures and of meshes are fixed when a model is opened.
const GROUPS: [&str; 5] = ["global", "headlight", "map", "scale", "rgba"];
/// Settings of `global` that have no effect on what is seen here.
const ELSEWHERE: [&str; 6] = ["offwidth", "offheight", "cameraid", "realtime", "glow", "treedepth"];

/// Every number and colour of `<visual>`.
pub fn appearance(ui: &mut Ui, session: &mut Session) {
    let mut settings = Vec::new();
    session.model().vis.visit(&mut |group, name, values| settings.push((group, name, values.to_f64())));
    for group in GROUPS {
        CollapsingHeader::new(group).show(ui, |ui| {
            for (_, name, values) in settings.iter_mut().filter(|(of, ..)| *of == group) {
                if ELSEWHERE.contains(name) {
                    continue;
                }
                if setting(ui, group, name, values) {
                    session.edit_visual(|visual| assign(visual, group, name, values));
                }
            }
        });
    }
}

/// One setting: a colour, or numbers. Whether it was changed.
fn setting(ui: &mut Ui, group: &str, name: &str, values: &mut [f64]) -> bool {
    let is_colour = group == "rgba" || (group == "headlight" && values.len() == 3);
    let response = ui.horizontal(|ui| {
        let changed = if is_colour {
            colour(ui, values)
        } else {
            values.iter_mut().fold(false, |changed, value| {
                let speed = (value.abs() * 0.01).max(1e-3);
                changed | ui.add(DragValue::new(value).speed(speed).max_decimals(6)).changed()
            })
        };
        ui.label(name);
        changed
    });
    response.inner
}

fn colour(ui: &mut Ui, values: &mut [f64]) -> bool {
    let get = |k: usize| values.get(k).map_or(1.0, |&x| x as f32);
    let mut chosen: Color32 = Rgba::from_rgba_unmultiplied(get(0), get(1), get(2), get(3)).into();
    let changed = ui.color_edit_button_srgba(&mut chosen).changed();
    if changed {
        let rgba = Rgba::from(chosen).to_rgba_unmultiplied();
        values.iter_mut().zip(rgba).for_each(|(value, x)| *value = f64::from(x));
    }
    changed
}

fn assign(visual: &mut Visual, group: &str, name: &str, values: &[f64]) {
    let _ = match group {
        "global" => visual.global.assign(name, values),
        "headlight" => visual.headlight.assign(name, values),
        "map" => visual.map.assign(name, values),
        "scale" => visual.scale.assign(name, values),
        _ => visual.rgba.assign(name, values),
    };
}
