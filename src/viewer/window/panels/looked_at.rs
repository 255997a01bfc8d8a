//! One element: the rows that the arrays of model and state have for it.

use super::desk::Desk;
use super::table;
use crate::element;
use crate::session::Session;
use eframe::egui::{ComboBox, Ui};
use physics::model::ObjType;

/// The element that is looked at: kind, name, and the rows that all arrays have for it.
pub fn looked_at(ui: &mut Ui, session: &mut Session, desk: &mut Desk) {
    let kinds = element::kinds(session);
    let look = &mut desk.element;
    if let Some(selected) = session.selected().filter(|selected| look.followed != Some(selected.body)) {
        // A double click on the picture leads here.
        (look.kind, look.id, look.followed) = (ObjType::Body, selected.body, Some(selected.body));
    }
    let name = |kind: ObjType| format!("{kind:?}");
    ComboBox::from_label("Kind").selected_text(name(look.kind)).show_ui(ui, |ui| {
        for (kind, _) in &kinds {
            if ui.selectable_value(&mut look.kind, *kind, name(*kind)).changed() {
                look.id = 0;
            }
        }
    });
    let count = kinds.iter().find(|(kind, _)| *kind == look.kind).map_or(0, |(_, count)| *count);
    look.id = look.id.min(count.saturating_sub(1));
    let label = |id: usize| session.model().label_of(look.kind, id);
    ComboBox::from_label("Element").selected_text(label(look.id)).show_ui(ui, |ui| {
        for id in 0..count {
            ui.selectable_value(&mut look.id, id, label(id));
        }
    });
    let (kind, id) = (look.kind, look.id);
    table(
        ui,
        "element",
        element::rows(session, kind, id).iter().map(|(name, text)| (&name[..], text.clone())),
    );
}
