//! Texts over the picture: whether time stands still, and what goes on.

use crate::session::Session;
use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, vec2};

/// Size of letters \[point\].
const LETTERS: f32 = 13.0;
/// Distance from the edges \[point\].
const MARGIN: f32 = 10.0;

/// Says that time stands still, unless it goes by or another program has it; with `info`, also time, sizes, solver, energy and frames a second.
pub(super) fn overlay(painter: &Painter, area: Rect, session: &Session, frame: f64, info: bool) {
    let painter = painter.with_clip_rect(area);
    if !session.is_running() && !session.is_following() {
        let behind = session.history().behind();
        let text = match (session.replay(), behind) {
            (Some(replay), _) => format!("REPLAY {} / {}", replay.row() + 1, replay.trajectory().len()),
            (None, 0) => "PAUSE".to_owned(),
            (None, _) => format!("PAUSE (-{behind})"),
        };
        write(&painter, area.left_top() + vec2(MARGIN, MARGIN), Align2::LEFT_TOP, &text);
    }
    if info {
        let text = lines(session, frame).join("\n");
        write(&painter, area.right_top() + vec2(-MARGIN, MARGIN), Align2::RIGHT_TOP, &text);
    }
}

/// What goes on, line by line; a frame of the window took `frame` seconds.
fn lines(session: &Session, frame: f64) -> Vec<String> {
    let (model, data) = (session.model(), session.data());
    let iterations: i32 = data.solver.solver_niter.iter().sum();
    let improvement = data.solver.solver.get((iterations.max(1) - 1) as usize).map(|last| last.improvement);
    let mut lines = vec![
        format!("time {:.3} s", data.time()),
        format!(
            "{} degrees of freedom, {} contacts, {} rows",
            model.nv,
            data.con.contact.len(),
            data.efc.nefc
        ),
        match improvement {
            Some(gain) if iterations > 0 => {
                format!("solver {iterations} iterations, 10^{:.1}", gain.max(1e-15).log10())
            }
            _ => "solver idle".to_owned(),
        },
        format!("{} islands", data.island.nisland),
        format!("{:.0} frames a second", 1.0 / frame.max(1e-6)),
        format!("{:.1} MB of states to go back to", history_bytes(session) / 1e6),
    ];
    if model.opt.enableflags.contains(physics::model::Enable::ENERGY) {
        let [potential, kinetic] = data.energy;
        lines.push(format!("energy {:.4} J", potential + kinetic));
    }
    if let Some(difference) = session.reference().and_then(|reference| reference.difference()) {
        lines.push(format!("reference differs by {difference:.2e}"));
    }
    lines
}

fn history_bytes(session: &Session) -> f64 {
    (session.history().len() * physics::Snapshot::bytes(session.model())) as f64
}

/// White letters with a dark edge.
fn write(painter: &Painter, at: Pos2, anchor: Align2, text: &str) {
    let font = FontId::monospace(LETTERS);
    for shift in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
        painter.text(at + shift, anchor, text, font.clone(), Color32::from_black_alpha(180));
    }
    painter.text(at, anchor, text, font, Color32::WHITE);
}
