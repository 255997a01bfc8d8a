//! Small pictures over the picture: what other cameras of the model see.

use super::channel::{CHANNELS, Channel, show_scale};
use super::opened::Opened;
use super::painters::Painters;
use super::screen::Aside;
use eframe::egui::emath::GuiRounding;
use eframe::egui::load::SizedTexture;
use eframe::egui::{
    Align, Align2, Color32, ComboBox, FontId, Image, Rect, Role, Slider, Stroke, StrokeKind, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};
use physics::Model;
use physics::model::ObjType;

/// Distance of small pictures from the edges and from each other \[point\].
const GAP: f32 = 8.0;
/// Width of a small picture, in parts of the picture's, at first and at most.
const SHARE: f32 = 0.25;
const WIDEST: f32 = 0.6;
/// Ratio of the sides where a camera has no resolution.
const SIDES: f32 = 4.0 / 3.0;
/// Height of the letters of a name \[point\].
const LETTER: f32 = 12.0;
/// Width from which there is room for the scale of depth \[point\].
const ROOM: f32 = 200.0;

/// Corners that small pictures begin in.
const CORNERS: [(&str, Align2); 4] = [
    ("Lower right", Align2::RIGHT_BOTTOM),
    ("Lower left", Align2::LEFT_BOTTOM),
    ("Upper right", Align2::RIGHT_TOP),
    ("Upper left", Align2::LEFT_TOP),
];

/// The cameras that were chosen, by name: another model with a camera of that name shows it too.
pub(super) struct Insets {
    /// Width in parts of the picture's.
    share: f32,
    corner: Align2,
    chosen: Vec<Inset>,
}

/// A camera that was chosen.
struct Inset {
    name: String,
    channel: Channel,
    aside: Aside,
    /// Where it is shown \[point\].
    place: Option<Rect>,
}

impl Default for Insets {
    fn default() -> Self {
        Insets { share: SHARE, corner: Align2::RIGHT_BOTTOM, chosen: Vec::new() }
    }
}

impl Insets {
    /// Forgets the pictures, which are of another model, and keeps what was chosen.
    pub(super) fn forget(&mut self) {
        self.chosen.iter_mut().for_each(|inset| (inset.aside, inset.place) = (Aside::default(), None));
    }

    /// Shows what a camera of this name sees, where a model has one.
    pub(super) fn choose(&mut self, name: &str) {
        if self.chosen.iter().all(|inset| inset.name != name) {
            self.chosen.push(Inset::of(name.to_owned()));
        }
    }

    /// Columns and rows of the last small picture \[pixel\].
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn size(&self) -> Option<[usize; 2]> {
        self.chosen.iter().rfind(|inset| inset.place.is_some()).map(|inset| inset.aside.size)
    }

    /// What is shown, and where \[point\].
    pub(super) fn shown(&self) -> impl Iterator<Item = (&str, Rect)> {
        self.chosen.iter().filter_map(|inset| Some((&inset.name[..], inset.place?)))
    }

    /// Shows what the chosen cameras see over the picture, which is at `area` and was drawn just now. The error says why one has no
    /// picture.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        area: Rect,
        opened: &mut Opened,
        painters: &mut Painters,
    ) -> Result<(), String> {
        if self.chosen.is_empty() || area.width() < 1.0 || area.height() < 1.0 {
            return Ok(());
        }
        let model = opened.session.model();
        let names: Vec<String> = (0..model.ncam).map(|camera| name_of(model, camera)).collect();
        let number = |inset: &Inset| names.iter().position(|name| *name == inset.name);
        self.chosen.sort_by_key(number);
        let cameras: Vec<Option<usize>> = self.chosen.iter().map(number).collect();
        let width = (self.share * area.width()).round();
        let sizes: Vec<Vec2> =
            cameras.iter().flatten().map(|&camera| size_of(model, camera, width)).collect();
        let scale = ui.ctx().pixels_per_point();
        let mut places =
            places(area, self.corner, &sizes).into_iter().map(|place| place.round_to_pixels(scale));
        for (inset, camera) in self.chosen.iter_mut().zip(cameras) {
            inset.place = camera.and_then(|_| places.next());
            let (Some(camera), Some(place)) = (camera, inset.place) else { continue };
            inset.show(ui, (camera, place), opened, painters)?;
        }
        Ok(())
    }
}

impl Inset {
    fn show(
        &mut self,
        ui: &mut Ui,
        (camera, place): (usize, Rect),
        opened: &mut Opened,
        painters: &mut Painters,
    ) -> Result<(), String> {
        let scale = ui.ctx().pixels_per_point();
        self.aside.size =
            [place.width(), place.height()].map(|points| ((points * scale).round() as usize).max(1));
        let what = (camera, self.channel);
        let Opened { session, screen, .. } = opened;
        let painted = screen
            .draw_aside(ui.ctx(), painters, session, what, &mut self.aside)
            .map_err(|error| format!("{}: {error}", self.name))?;
        let texture = SizedTexture::new(painted.texture, place.size());
        ui.put(place, Image::new(texture).uv(painted.place).alt_text(format!("What {} sees", self.name)));
        let painter = ui.painter().with_clip_rect(place.expand(1.0));
        painter.rect_stroke(place, 0.0, Stroke::new(1.0, Color32::from_gray(200)), StrokeKind::Outside);
        let at = place.left_top() + vec2(5.0, 4.0);
        let words = painter.layout_no_wrap(self.name.clone(), FontId::monospace(LETTER), Color32::WHITE);
        let behind = Rect::from_min_size(at, words.size()).expand(2.0);
        painter.rect_filled(behind, 2.0, Color32::from_black_alpha(140));
        painter.galley(at, words, Color32::WHITE);
        if let Some(distances) = painted.scale.filter(|_| place.width() >= ROOM) {
            show_scale(ui.painter(), place, distances);
        }
        Ok(())
    }
}

/// The name by which a camera is chosen.
fn name_of(model: &Model, camera: usize) -> String {
    model.label_of(ObjType::Camera, camera)
}

/// Size of a camera's picture, `width` wide \[point\]: of the shape of its own images, where it has some.
fn size_of(model: &Model, camera: usize, width: f32) -> Vec2 {
    let [columns, rows] = model.cam_resolution[camera];
    let sides = if columns > 1 && rows > 1 { columns as f32 / rows as f32 } else { SIDES };
    vec2(width, (width / sides).round()).max(vec2(1.0, 1.0))
}

/// Where pictures of these sizes go: up or down from a corner, and on beside it where a column is full.
fn places(area: Rect, corner: Align2, sizes: &[Vec2]) -> Vec<Rect> {
    let inside = area.shrink(GAP);
    // Lengths from the corner, across and along a column.
    let (mut across, mut along, mut widest) = (0.0, 0.0, 0.0_f32);
    let place = |&size: &Vec2| {
        if along > 0.0 && along + size.y > inside.height() {
            (across, along, widest) = (across + widest + GAP, 0.0, 0.0);
        }
        let (left, top) = (corner.x() == Align::Min, corner.y() == Align::Min);
        let x = if left { inside.left() + across } else { inside.right() - across - size.x };
        let y = if top { inside.top() + along } else { inside.bottom() - along - size.y };
        (along, widest) = (along + size.y + GAP, widest.max(size.x));
        Rect::from_min_size(pos2(x, y), size)
    };
    sizes.iter().map(place).collect()
}

/// Which cameras are shown over the picture, what of the scene, how large and where.
pub(super) fn cameras_panel(ui: &mut Ui, model: &Model, insets: &mut Insets) {
    for name in (0..model.ncam).map(|camera| name_of(model, camera)) {
        let place = insets.chosen.iter().position(|inset| inset.name == name);
        let mut on = place.is_some();
        ui.checkbox(&mut on, format!("Show {name}"));
        match (place, on) {
            (Some(place), false) => drop(insets.chosen.remove(place)),
            (Some(place), true) => insets.chosen[place].choose(ui),
            (None, true) => insets.choose(&name),
            (None, false) => {}
        }
    }
    ui.add(Slider::new(&mut insets.share, 0.1..=WIDEST).text("width"));
    let corner = CORNERS.iter().find(|(_, corner)| *corner == insets.corner).map_or("", |(name, _)| name);
    ComboBox::from_label("Corner").selected_text(corner).show_ui(ui, |ui| {
        for (name, corner) in CORNERS {
            ui.selectable_value(&mut insets.corner, corner, name);
        }
    });
}

impl Inset {
    fn of(name: String) -> Self {
        Inset { name, channel: Channel::default(), aside: Aside::default(), place: None }
    }

    /// Colours, depth or objects.
    fn choose(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.add_space(ui.spacing().indent);
            for (shown, channel) in CHANNELS {
                let response = ui.selectable_value(&mut self.channel, channel, shown);
                response.widget_info(|| {
                    let chosen = self.channel == channel;
                    WidgetInfo::selected(Role::RadioButton, true, chosen, format!("{shown} of {}", self.name))
                });
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_stay_inside_and_apart() {
        let area = Rect::from_min_size(pos2(100.0, 50.0), vec2(500.0, 300.0));
        let sizes = [vec2(120.0, 90.0), vec2(120.0, 160.0), vec2(120.0, 90.0), vec2(120.0, 90.0)];
        for (_, corner) in CORNERS {
            let places = places(area, corner, &sizes);
            for (i, place) in places.iter().enumerate() {
                assert!(area.contains_rect(*place), "{corner:?} {place:?}");
                assert!(places[..i].iter().all(|other| !other.intersects(*place)), "{corner:?} {place:?}");
            }
            let at = corner.pos_in_rect(&area.shrink(GAP));
            assert_eq!(corner.pos_in_rect(&places[0]), at, "the first lies in the corner");
        }
    }
}
