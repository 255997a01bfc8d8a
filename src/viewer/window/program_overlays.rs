//! Texts, images and figures that a program lays over the picture.

use crate::remote::{Figure, Image, Place, Text};
use eframe::egui::{
    Align2, Color32, ColorImage, Context, FontId, Painter, Rect, TextureHandle, TextureOptions, Ui,
    UiBuilder, pos2, vec2,
};
use egui_plot::{Bar, BarChart, Legend, Line, Plot, PlotUi};

/// Points of a letter's height, and of the space around texts.
const LETTER: f32 = 14.0;
const PAD: f32 = 5.0;

/// What lies over the picture.
#[derive(Default)]
pub struct Overlays {
    /// Texts in corners and at sides.
    pub texts: Vec<Text>,
    /// Figures in their places.
    pub figures: Vec<Figure>,
    images: Vec<(Place, TextureHandle)>,
}

impl Overlays {
    /// Images, in place of the former. One whose bytes are no picture of its size is left out.
    pub fn set_images(&mut self, context: &Context, images: &[Image]) {
        let pixels = |image: &&Image| {
            let [width, height] = [image.place.width, image.place.height].map(|n| usize::try_from(n).ok());
            let size = [width?, height?];
            let bytes = size[0].checked_mul(size[1])?.checked_mul(3)?;
            (bytes == image.rgb.0.len() && bytes > 0).then_some(size)
        };
        let shown = images.iter().filter_map(|image| Some((image, pixels(&image)?)));
        self.images = shown
            .map(|(image, size)| {
                let colours = ColorImage::from_rgb(size, &image.rgb.0);
                (image.place, context.load_texture("overlay", colours, TextureOptions::NEAREST))
            })
            .collect();
    }

    /// Shows all of it over the picture, which is at `area`.
    pub fn show(&self, ui: &mut Ui, area: Rect) {
        for figure in &self.figures {
            let place = points(ui.ctx(), figure.place);
            ui.painter().rect_filled(place, 0.0, colour(figure.background));
            let builder = UiBuilder::new().max_rect(place.shrink(PAD));
            ui.scope_builder(builder, |ui| show_figure(ui, figure, place));
        }
        for (place, texture) in &self.images {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), points(ui.ctx(), *place), whole, Color32::WHITE);
        }
        for text in &self.texts {
            show_text(&ui.painter().with_clip_rect(area), area, text);
        }
    }
}

/// A rectangle of pixels from the lower left corner as one of points from the upper left.
fn points(context: &Context, place: Place) -> Rect {
    let (window, scale) = (context.viewport_rect(), context.pixels_per_point());
    let [left, bottom, width, height] =
        [place.left, place.bottom, place.width, place.height].map(|pixels| pixels as f32 / scale);
    Rect::from_min_size(
        pos2(window.left() + left, window.bottom() - bottom - height),
        vec2(width.max(0.0), height.max(0.0)),
    )
}

/// A rectangle of points as one of pixels from the lower left corner of the window.
pub fn place_of(context: &Context, area: Rect) -> Place {
    let (window, scale) = (context.viewport_rect(), context.pixels_per_point());
    let pixels = |points: f32| (points * scale).round() as i32;
    Place {
        left: pixels(area.left() - window.left()),
        bottom: pixels(window.bottom() - area.bottom()),
        width: pixels(area.width()),
        height: pixels(area.height()),
    }
}

fn colour([r, g, b, a]: [f32; 4]) -> Color32 {
    let [r, g, b, a] = [r, g, b, a].map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8);
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

fn show_text(painter: &Painter, area: Rect, text: &Text) {
    let size = if text.big { 2.0 * LETTER } else { LETTER };
    let column =
        |words: &str, shade| painter.layout_no_wrap(words.to_owned(), FontId::monospace(size), shade);
    let titled = !text.second.is_empty();
    let first = column(&text.first, if titled { Color32::from_gray(180) } else { Color32::WHITE });
    let second = column(&text.second, Color32::WHITE);
    let between = if titled { 2.0 * PAD } else { 0.0 };
    let inside = vec2(first.size().x + between + second.size().x, first.size().y.max(second.size().y));
    let anchor = match text.corner {
        0 => Align2::LEFT_TOP,
        1 => Align2::RIGHT_TOP,
        2 => Align2::LEFT_BOTTOM,
        3 => Align2::RIGHT_BOTTOM,
        4 => Align2::CENTER_TOP,
        5 => Align2::CENTER_BOTTOM,
        6 => Align2::LEFT_CENTER,
        _ => Align2::RIGHT_CENTER,
    };
    let place = anchor.align_size_within_rect(inside + vec2(2.0 * PAD, 2.0 * PAD), area.shrink(PAD));
    painter.rect_filled(place, 0.0, Color32::from_black_alpha(128));
    let at = place.min + vec2(PAD, PAD);
    let after = at + vec2(first.size().x + between, 0.0);
    painter.galley(at, first, Color32::WHITE);
    painter.galley(after, second, Color32::WHITE);
}

fn show_figure(ui: &mut Ui, figure: &Figure, place: Rect) {
    if !figure.title.is_empty() {
        ui.vertical_centered(|ui| ui.label(&figure.title));
    }
    let mut plot = Plot::new(("figure", place.left() as i32, place.top() as i32))
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .x_axis_label(figure.across.as_str());
    if figure.legend {
        plot = plot.legend(Legend::default());
    }
    let [across, up] =
        figure.range.map(|[low, high]| (low < high).then_some([f64::from(low), f64::from(high)]));
    if figure.grows {
        let ends = |range: Option<[f64; 2]>| range.into_iter().flatten();
        plot = ends(across).fold(plot, Plot::include_x);
        plot = ends(up).fold(plot, Plot::include_y);
    }
    plot.show(ui, |plot| {
        if !figure.grows {
            if let Some([low, high]) = across {
                plot.set_plot_bounds_x(low..=high);
            }
            if let Some([low, high]) = up {
                plot.set_plot_bounds_y(low..=high);
            }
        }
        figure.lines.iter().for_each(|line| show_line(plot, line, figure.bars));
    });
}

fn show_line(plot: &mut PlotUi<'_>, line: &crate::remote::Line, bars: bool) {
    let [r, g, b] = line.rgb;
    let shade = colour([r, g, b, 1.0]);
    let finite = line.points.iter().filter(|point| point.iter().all(|x| x.is_finite()));
    let points = finite.map(|point| point.map(f64::from));
    if bars {
        let bars = points.map(|[x, y]| Bar::new(x, y)).collect();
        plot.bar_chart(BarChart::new(line.name.clone(), bars).color(shade));
    } else {
        plot.line(Line::new(line.name.clone(), points.collect::<Vec<_>>()).color(shade));
    }
}
