//! The picture in the window, and gestures on it.

use super::channel::show_scale;
use super::opened::Opened;
use super::painters::Painters;
use super::screen::Screen;
use crate::camera::Plane;
use crate::hand::Grip;
use crate::session::Look;
use eframe::egui::emath::GuiRounding;
use eframe::egui::{Align2, Color32, FontId, Painter, PointerButton, Rect, Response, Sense, Ui, pos2, vec2};

/// What a turn of the wheel by one notch zooms, and points a notch scrolls.
const ZOOM: f64 = 0.02;
const NOTCH: f64 = 50.0;
/// Height of the letters of labels \[point\].
const LETTER: f32 = 12.0;

/// Shows the picture and answers gestures: where it is. The error says why there is no picture.
pub(super) fn canvas(ui: &mut Ui, opened: &mut Opened, painters: &mut Painters) -> Result<Rect, String> {
    let (area, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    if area.width() < 1.0 || area.height() < 1.0 {
        return Ok(area);
    }
    // Pixels of the picture are pixels of the window: between them it would be blurred.
    let scale = ui.ctx().pixels_per_point();
    let area = area.round_to_pixels(scale);
    gestures(ui, opened, area, &response);
    let size = [area.width(), area.height()].map(|points| ((points * scale).round() as usize).max(1));
    let (painted, unfinished) =
        opened.screen.draw(ui.ctx(), painters, &opened.session, size).map_err(|error| error.to_string())?;
    ui.painter().image(painted.texture, area, painted.place, Color32::WHITE);
    if let Some(scale) = painted.scale {
        show_scale(ui.painter(), area, scale);
    }
    if !painted.labelled {
        write_labels(ui.painter(), &opened.screen, area, size);
    }
    if unfinished {
        ui.ctx().request_repaint();
    }
    Ok(area)
}

/// Writes labels over a picture without: white with a dark edge, as the CPU writes them.
fn write_labels(painter: &Painter, screen: &Screen, area: Rect, size: [usize; 2]) {
    let point = area.height() / size[1] as f32;
    let font = FontId::monospace(LETTER);
    let painter = painter.with_clip_rect(area);
    for (text, [right, up]) in screen.labels(size) {
        let at = pos2(area.left() + right as f32 * point, area.bottom() - up as f32 * point);
        let write = |shift, colour| {
            painter.text(at + shift, Align2::LEFT_BOTTOM, text, font.clone(), colour);
        };
        for shift in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
            write(shift, Color32::BLACK);
        }
        write(vec2(0.0, 0.0), Color32::WHITE);
    }
}

/// Left drag orbits, right drag pans, middle drag and wheel zoom; double clicks select, look and track; with Ctrl, drags turn
/// and pull what is selected; Shift takes the horizontal plane.
fn gestures(ui: &Ui, opened: &mut Opened, area: Rect, response: &Response) {
    let session = &mut opened.session;
    let aspect = f64::from(area.width() / area.height());
    let held = ui.input(|input| input.modifiers);
    let plane = if held.shift { Plane::Horizontal } else { Plane::Vertical };
    if let Some(at) = response.interact_pointer_pos() {
        let at = [(at.x - area.left()) / area.width(), (area.bottom() - at.y) / area.height()].map(f64::from);
        if response.double_clicked_by(PointerButton::Primary) {
            session.select(aspect, at);
        }
        if response.double_clicked_by(PointerButton::Secondary) {
            session.look_at(aspect, at, held.command);
        }
    }
    let moved = response.drag_delta();
    let drag = [moved.x / area.height(), -moved.y / area.height()].map(f64::from);
    let [left, right, middle] = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
    let pulls = held.command && session.selected().is_some();
    if pulls && !session.holds() {
        if response.drag_started_by(left) {
            session.grab(Grip::Turn);
        } else if response.drag_started_by(right) {
            session.grab(Grip::Pull);
        }
    }
    if session.holds() {
        session.drag(plane, drag);
        if !response.dragged() {
            session.release();
        }
    } else if response.dragged_by(left) {
        session.look(Look::Orbit, drag);
    } else if response.dragged_by(right) {
        session.look(Look::Pan(plane), drag);
    } else if response.dragged_by(middle) {
        session.look(Look::Zoom, [0.0, -drag[1]]);
    }
    if response.contains_pointer() {
        let notches = f64::from(ui.input(|input| input.smooth_scroll_delta().y)) / NOTCH;
        if notches != 0.0 {
            session.look(Look::Zoom, [0.0, -ZOOM * notches]);
        }
    }
}
