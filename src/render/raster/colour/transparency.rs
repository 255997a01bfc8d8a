//! Items that let others shine through: blended over the picture front to back, and then again back to front, as MuJoCo
//! does; each shows twice.

use super::paint::{Brush, Canvas, over};
use super::seen::{Illumination, Seen};
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
}

impl Transparency {
    /// Blends all transparent items but `except` over the canvas, where nothing opaque is nearer.
    pub fn draw(
        &mut self,
        stage: &Stage<'_>,
        visibility: &Visibility,
        light: &Illumination,
        brush: &Brush<'_>,
        canvas: &mut Canvas,
    ) {
        self.sort(stage);
        self.seen.begin(stage.draws.triangles);
        for (_, item, fragments) in &mut self.items {
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
        let back = self.items.iter().rev();
        for (_, item, fragments) in self.items.iter().chain(back) {
            let item = &stage.scene.items[*item];
            for fragment in &self.seen.fragments[fragments.clone()] {
                let draw = &stage.draws.list[self.seen.triangles[fragment.triangle as usize].draw as usize];
                let colour = brush.colour(&self.seen, &draw.paint, draw.alpha(item), fragment);
                canvas.touch(fragment, |below| over(colour, below));
            }
        }
    }

    /// Lists the transparent items by the distance of their nearest point; planes come last.
    fn sort(&mut self, stage: &Stage<'_>) {
        let eye = stage.scene.view.eye.map(|x| x as f32);
        self.items.clear();
        let mut last = usize::MAX;
        for draw in stage.draws.list.iter().filter(|draw| draw.transparent) {
            if draw.item == last {
                continue;
            }
            last = draw.item;
            let item = &stage.scene.items[draw.item];
            self.items.push((distance(item, eye), draw.item, 0..0));
        }
        self.items.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    }
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
