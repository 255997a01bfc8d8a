//! Items that let others shine through: blended over the picture front to back, and then again back to front, as MuJoCo
//! does; each shows twice. Where transparency is additive they are added, once.

use super::paint::{Brush, Canvas, eight_bits, onto, over};
use super::seen::{Fragment, Illumination, Seen, uncovered};
use crate::raster::stage::Stage;
use crate::raster::visibility::Visibility;
use crate::scene::{Item, Shape};
use std::ops::Range;

/// The transparent part of a picture.
#[derive(Clone, Debug, Default)]
pub struct Transparency {
    seen: Seen,
    /// Distance from the eye, item, and its fragments.
    items: Vec<(f32, usize, Range<usize>)>,
    /// Fragments of lines, which have their items' colours.
    of_lines: Vec<Fragment>,
}

impl Transparency {
    /// Blends all transparent items over the canvas, where nothing opaque is nearer; with the width of lines \[pixel\].
    pub fn draw(
        &mut self,
        stage: &Stage<'_>,
        (visibility, line_width): (&Visibility, f32),
        light: &Illumination,
        brush: &Brush<'_>,
        canvas: &mut Canvas,
    ) {
        self.sort(stage);
        self.seen.begin(stage.draws.triangles);
        self.of_lines.clear();
        for (_, item, fragments) in &mut self.items {
            if is_line(&stage.scene.items[*item]) {
                let first = self.of_lines.len();
                for line in stage.draws.lines_of(*item) {
                    line.triangles(stage.lens, &visibility.pattern, line_width, |triangle| {
                        uncovered(visibility, triangle, |fragment| self.of_lines.push(fragment));
                    });
                }
                *fragments = first..self.of_lines.len();
                continue;
            }
            let first = self.seen.fragments.len();
            let of_item = stage.draws.list.partition_point(|draw| draw.item < *item);
            for (index, draw) in
                stage.draws.list.iter().enumerate().skip(of_item).take_while(|(_, draw)| draw.item == *item)
            {
                stage.layer.triangles(
                    stage.assets,
                    (index, draw),
                    stage.lens,
                    &visibility.pattern,
                    |number, triangle| {
                        self.seen.cover(visibility, number, triangle);
                    },
                );
            }
            *fragments = first..self.seen.fragments.len();
        }
        self.seen.light(stage, light);
        let additive = stage.scene.additive;
        let blend = if additive { onto } else { over };
        let back = self.items.iter().rev().filter(|_| !additive);
        for (_, item, fragments) in self.items.iter().chain(back) {
            let item = &stage.scene.items[*item];
            if is_line(item) {
                let [r, g, b, opacity] = item.rgba;
                let [r, g, b] = [r, g, b].map(|x| light.reflectance * x);
                let colour = [r, g, b, opacity].map(eight_bits);
                for fragment in &self.of_lines[fragments.clone()] {
                    canvas.touch(fragment, |below| blend(colour, below));
                }
                continue;
            }
            for fragment in &self.seen.fragments[fragments.clone()] {
                let draw = &stage.draws.list[self.seen.triangles[fragment.triangle as usize].draw as usize];
                let colour = brush.colour(&self.seen, &draw.paint, draw.alpha(item), fragment);
                canvas.touch(fragment, |below| blend(colour, below));
            }
        }
    }

    /// Lists the transparent items by the distance of their nearest point; planes come last.
    fn sort(&mut self, stage: &Stage<'_>) {
        let eye = stage.scene.view.eye.map(|x| x as f32);
        self.items.clear();
        let surfaces = stage.draws.list.iter().filter(|draw| draw.transparent).map(|draw| draw.item);
        let lines = stage.draws.lines.iter().filter(|line| line.transparent).map(|line| line.item);
        let mut last = usize::MAX;
        for item in surfaces.chain(lines) {
            if item != last {
                last = item;
                self.items.push((distance(&stage.scene.items[item], eye), item, 0..0));
            }
        }
        self.items.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    }
}

/// Whether an item is made of lines.
fn is_line(item: &Item) -> bool {
    matches!(item.shape, Shape::Line | Shape::LineBox)
}

/// Distance of what is behind everything else \[m\].
const FARTHEST: f32 = 1e10;

/// Distance of an item's nearest point, by a ball about it; very far for planes, and where it is not a number. Transparent
/// items are sorted by it.
pub fn distance(item: &Item, eye: [f32; 3]) -> f32 {
    if matches!(item.shape, Shape::Plane { .. }) {
        return FARTHEST;
    }
    let away: f32 = (0..3).map(|k| (item.pos[k] - eye[k]) * (item.pos[k] - eye[k])).sum();
    let nearest = away.sqrt() - item.rbound;
    if nearest.is_nan() { FARTHEST } else { nearest }
}
