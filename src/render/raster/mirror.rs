//! The mirror image in the one item that may reflect.

use super::layer::{Layer, Lens};
use super::paint::{Brush, Canvas};
use super::seen::{Illumination, Seen};
use super::stage::Stage;
use super::transparency::Transparency;
use super::visibility::Visibility;
use super::window::mirror;
use crate::scene::Shape;
use wide::f32x4;

/// The mirror image of a picture.
#[derive(Clone, Debug)]
pub struct Mirror {
    layer: Layer,
    visibility: Visibility,
    seen: Seen,
    light: Illumination,
    transparency: Transparency,
}

impl Default for Mirror {
    fn default() -> Self {
        Mirror {
            layer: Layer::default(),
            visibility: Visibility::new(super::coverage::Pattern::CENTER),
            seen: Seen::default(),
            light: Illumination::default(),
            transparency: Transparency::default(),
        }
    }
}

/// Depth that nothing is nearer than.
const CLOSED: f32 = 2.0;
/// Share of a normal along the plane's from which on a triangle belongs to the mirroring side.
const UPPER: f32 = 0.5;

impl Mirror {
    /// Paints what `item` mirrors on the samples at which its upper side is seen. Nothing in it casts shadows.
    pub fn draw(
        &mut self,
        stage: &Stage<'_>,
        item: usize,
        shown: &Visibility,
        brush: &Brush<'_>,
        canvas: &mut Canvas,
    ) {
        let (scene, lens) = (stage.scene, stage.lens);
        let plane = &scene.items[item];
        let normal = [plane.mat[2], plane.mat[5], plane.mat[8]].map(f64::from);
        let rise = if plane.shape == Shape::Box { f64::from(plane.size[2]) } else { 0.0 };
        let point: [f64; 3] = std::array::from_fn(|k| f64::from(plane.pos[k]) + rise * normal[k]);
        let shift = -(0..3).map(|k| normal[k] * point[k]).sum::<f64>();
        let eye = scene.view.eye;
        if (0..3).map(|k| normal[k] * eye[k]).sum::<f64>() + shift < 0.0 || !self.open(stage, item, shown) {
            return;
        }
        let lens = Lens {
            projection: lens.projection.mirrored(point, normal),
            mirror: Some([normal[0], normal[1], normal[2], shift]),
            ..*lens
        };
        self.layer.update(stage.assets, stage.draws, &lens, |draw| draw.item != item);
        let stage = Stage { layer: &self.layer, lens: &lens, ..*stage };
        for (index, draw) in stage.draws.list.iter().enumerate().filter(|(_, draw)| !draw.transparent) {
            let pattern = self.visibility.pattern;
            stage.layer.triangles(stage.assets, (index, draw), &lens, &pattern, |number, triangle| {
                self.visibility.draw(number, triangle);
            });
        }
        let turn = mirror(point, normal);
        let seen_from = |p: [f64; 3]| turn.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
        self.light.set(scene, seen_from(eye).map(|x| x as f32), false);
        self.light.reflectance = plane.look.reflectance;
        self.seen.collect(&self.visibility, lens.extent.width as usize, stage.draws.triangles);
        self.seen.light(&stage, &self.light);
        for fragment in &self.seen.fragments {
            let draw = &stage.draws.list[self.seen.triangles[fragment.triangle as usize].draw as usize];
            let colour = brush.colour(&self.seen, &draw.paint, 1.0, fragment);
            canvas.touch(fragment, |_| colour);
        }
        self.transparency.draw(&stage, &self.visibility, &self.light, brush, canvas);
    }

    /// Opens the samples at which the item's upper side is seen; whether there are any.
    fn open(&mut self, stage: &Stage<'_>, item: usize, shown: &Visibility) -> bool {
        let draws = &stage.draws.list;
        let first = draws.partition_point(|draw| draw.item < item);
        let end = draws.partition_point(|draw| draw.item <= item);
        let after = draws.get(end).map_or(stage.draws.triangles, |draw| draw.first_triangle);
        let numbers = draws[first].first_triangle..after;
        let surface = draws[first].surface(stage.assets);
        let upper = |number: u32| {
            let face = &surface.corners[(number - numbers.start) as usize];
            surface.normals[face.normal[0] as usize][2] > UPPER
        };
        self.visibility.copy_shape(shown);
        let mut any = false;
        for (open, shown) in self.visibility.groups.iter_mut().zip(&shown.groups) {
            let depth = shown.triangle.to_array().map(|number| {
                let is_open = numbers.contains(&number) && upper(number);
                any |= is_open;
                if is_open { 0.0 } else { CLOSED }
            });
            open.depth = f32x4::new(depth);
        }
        any
    }
}
