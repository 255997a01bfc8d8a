//! Recordings: what is written while the simulation goes on, what is shown again, and what is shown beside it.

use super::desk::Desk;
use crate::session::Session;
use eframe::egui::{Button, Slider, TextEdit, Ui};
use std::path::Path;

/// Starts and ends a recording of states or episodes.
pub fn recording(ui: &mut Ui, session: &mut Session, desk: &mut Desk) {
    if session.replay().is_some() {
        ui.label("What is replayed is recorded already");
        return;
    }
    if let Some(recorded) = session.recording() {
        ui.label(recorded.to_string());
        if ui.button("Stop recording").clicked() {
            desk.notice = match session.stop_recording() {
                Ok(written) => written.map(|written| format!("recorded {written}")),
                Err(why) => Some(why.to_string()),
            };
        }
        return;
    }
    let episodes = session.play().is_some();
    let hint = if episodes { "episodes.h5" } else { "states.npz" };
    ui.add(TextEdit::singleline(&mut desk.record_to).hint_text(hint));
    let name = if episodes { "Record episodes" } else { "Record states" };
    if ui.button(name).clicked() {
        let typed = desk.record_to.trim();
        let path = if typed.is_empty() { hint } else { typed };
        desk.notice = begin(session, Path::new(path), episodes).err();
    }
}

/// A file that is there already is left alone.
fn begin(session: &mut Session, path: &Path, episodes: bool) -> Result<(), String> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let allowed: &[&str] = if episodes { &["h5", "hdf5", "npz"] } else { &["npz"] };
    if !allowed.contains(&ending) {
        return Err(format!("{}: recordings here end in .{}", path.display(), allowed.join(" or .")));
    }
    if path.exists() {
        return Err(format!("{} is there already: choose another name", path.display()));
    }
    session.record(path).map_err(|error| error.to_string())
}

/// The replay's place, and the reference's difference.
pub fn replay(ui: &mut Ui, session: &mut Session) {
    if let Some(replay) = session.replay() {
        ui.label(replay.trajectory().name());
        let (mut row, last) = (replay.row(), replay.trajectory().len() - 1);
        ui.label(format!(
            "{:.3} s of {:.3} s",
            replay.trajectory().time(row),
            replay.trajectory().time(last)
        ));
        if ui.add(Slider::new(&mut row, 0..=last).text("state")).changed() {
            session.seek(row);
        }
        if ui.button("Simulate from here").clicked() {
            // Without a trajectory nothing can be of another model.
            let _ = session.set_replay(None);
        }
    }
    if let Some(reference) = session.reference() {
        ui.label(format!("reference: {}", reference.trajectory().name()));
        let text = match reference.difference() {
            Some(difference) => format!("differs by {difference:.3e} m or rad"),
            None => "has no state of this time".to_owned(),
        };
        ui.label(text);
        if ui.add(Button::new("Hide the reference")).clicked() {
            let _ = session.set_reference(None);
        }
    }
}
