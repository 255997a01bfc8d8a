//! The mirror image in the one item that may reflect.

use super::backdrop::Known;
use super::colour::paint::{Brush, Canvas, Veil};
use super::colour::seen::{Illumination, Seen};
use super::colour::transparency::Transparency;
use super::draws::Draw;
use super::layer::Layer;
use super::opaque::Frame;
use super::stage::Stage;
use super::still::{Kept, Plan};
use super::visibility::{MIRRORED, Visibility};
use super::window::lens::Lens;
use super::window::projection::mirror;
use crate::scene::{Item, Scene, Shape};
use wide::bytemuck::cast;
use wide::{f32x4, u32x4};

/// The mirror image of a picture.
#[derive(Clone, Debug)]
pub struct Mirror {
    layer: Layer,
    visibility: Visibility,
    /// The mirror itself, filled, where the picture shows outlines alone.
    pane: Visibility,
    seen: Seen,
    known: Vec<Known>,
    light: Illumination,
    transparency: Transparency,
}

impl Default for Mirror {
    fn default() -> Self {
        Mirror {
            layer: Layer::default(),
            visibility: Visibility::new(super::window::coverage::Pattern::CENTER),
            pane: Visibility::new(super::window::coverage::Pattern::CENTER),
            seen: Seen::default(),
            known: Vec::new(),
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
    /// Paints what `item` mirrors on the samples at which its upper side is seen; in a wireframe, wherever it lies. Nothing in it casts
    /// shadows. Whether it mirrors at all.
    pub fn draw(
        &mut self,
        stage: &Stage<'_>,
        (item, shown): (usize, &Visibility),
        frame: &Frame<'_>,
        kept: &mut Kept,
        canvas: &mut Canvas,
    ) -> bool {
        let scene = stage.scene;
        let Some(lens) = reflected(stage.lens, scene, item) else { return false };
        let turn = mirror(lens.point, lens.normal);
        let seen_from = |p: [f64; 3]| turn.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
        self.light.set(scene, seen_from(scene.view.eye).map(|x| x as f32), false);
        self.light.reflectance = scene.items[item].look.reflectance;
        let veil = scene.fog.map(|fog| Veil::mirrored(fog, scene.view.eye, scene.view.forward, &turn));
        let brush = &Brush { veil, ..*frame.brush };
        let is_kept = frame.plan != Plan::Without && kept.stills.has_item(item);
        let still = |kept: &Kept, draw: &Draw| is_kept && kept.stills.has(draw) && !draw.transparent;
        let width = stage.lens.extent.width as usize;
        let lens = lens.lens;
        if !is_kept || frame.plan == Plan::Make {
            self.visibility.copy_shape(shown);
        }
        if is_kept && frame.plan == Plan::Make {
            let wanted = |draw: &Draw| draw.item != item && still(kept, draw);
            self.layer.update(stage.assets, stage.draws, &lens, wanted);
            let stage = Stage { layer: &self.layer, lens: &lens, ..*stage };
            stage.look(&mut self.visibility, wanted);
            self.seen.collect(&self.visibility, width, stage.draws.triangles, |_, _| false);
            self.seen.light(&stage, &self.light);
            kept.mirror.keep(&self.visibility, &self.seen, stage.draws, brush);
        }
        if is_kept && frame.plan == Plan::Use {
            self.visibility.copy(&kept.mirror.visibility);
        }
        if !self.open(stage, item, shown) {
            return false;
        }
        let wanted = |draw: &Draw| draw.item != item && !still(kept, draw);
        self.layer.update(stage.assets, stage.draws, &lens, wanted);
        let stage = Stage { layer: &self.layer, lens: &lens, ..*stage };
        stage.look(&mut self.visibility, |draw| !draw.transparent && wanted(draw));
        self.known.clear();
        self.seen.collect(&self.visibility, width, stage.draws.triangles, |fragment, number| {
            let found = if is_kept { kept.mirror.find(fragment, number) } else { None };
            self.known.extend(found);
            found.is_some()
        });
        self.seen.light(&stage, &self.light);
        for fragment in &self.seen.fragments {
            let draw = &stage.draws.list[self.seen.triangles[fragment.triangle as usize].draw as usize];
            let colour = brush.colour(&self.seen, &draw.paint, 1.0, fragment);
            canvas.set(fragment, colour);
        }
        for known in &self.known {
            let colour = kept.mirror.colour(known);
            canvas.set(&known.fragment, colour);
        }
        let shown = (&self.visibility, frame.settings.line_width);
        self.transparency.draw(&stage, shown, &self.light, brush, canvas);
        true
    }

    /// Closes the samples at which the item's upper side is not seen; whether any are left.
    fn open(&mut self, stage: &Stage<'_>, item: usize, shown: &Visibility) -> bool {
        let draws = &stage.draws.list;
        let first = draws.partition_point(|draw| draw.item < item);
        let end = draws.partition_point(|draw| draw.item <= item);
        let after = draws.get(end).map_or(stage.draws.triangles, |draw| draw.first_triangle);
        let numbers = draws[first].first_triangle..after;
        let surface = draws[first].surface(stage.assets);
        let upper = |number: u32| {
            let face = &surface.corners[((number - numbers.start) / stage.draws.numbers_each) as usize];
            surface.normals[face.normal[0] as usize][2] > UPPER
        };
        let Mirror { layer, visibility, pane, .. } = self;
        let shown = match stage.lens.wire {
            None => shown,
            Some(_) => {
                let filled = Lens { wire: None, ..*stage.lens };
                layer.update(stage.assets, stage.draws, &filled, |draw| draw.item == item);
                pane.copy_shape(shown);
                Stage { layer, lens: &filled, ..*stage }.look(pane, |draw| draw.item == item);
                pane
            }
        };
        let mut any = false;
        for (mirrored, shown) in visibility.groups.iter_mut().zip(&shown.groups) {
            let (mut depth, mut number) = (mirrored.depth.to_array(), mirrored.triangle.to_array());
            for (lane, &seen) in shown.triangle.to_array().iter().enumerate() {
                if numbers.contains(&seen) && upper(seen) {
                    any = true;
                } else {
                    (depth[lane], number[lane]) = (CLOSED, 0);
                }
            }
            (mirrored.depth, mirrored.triangle) = (f32x4::new(depth), u32x4::new(number));
        }
        any
    }

    /// Marks the samples of a wireframe that show nothing but a mirror image, over which no sky is painted.
    pub fn mark(&self, shown: &mut Visibility) {
        for (mirrored, shown) in self.visibility.groups.iter().zip(&mut shown.groups) {
            let ours = mirrored.triangle.simd_gt(u32x4::ZERO) & shown.triangle.simd_eq(u32x4::ZERO);
            shown.triangle = ours.select(u32x4::splat(MIRRORED), shown.triangle);
            shown.depth = cast::<_, f32x4>(ours).select(mirrored.depth, shown.depth);
        }
    }
}

/// A lens that looks into a mirror.
struct Reflected {
    lens: Lens,
    /// A point of the mirror and its normal, world frame.
    point: [f64; 3],
    normal: [f64; 3],
}

/// The lens that sees what an item's upper side mirrors; none where the eye is below it.
fn reflected(lens: &Lens, scene: &Scene, item: usize) -> Option<Reflected> {
    let plane = &scene.items[item];
    let (point, normal) = plane_of(plane);
    let along = |p: [f64; 3]| (0..3).map(|k| normal[k] * p[k]).sum::<f64>();
    let shift = -along(point);
    let lens = Lens {
        projection: lens.projection.mirrored(point, normal),
        mirror: Some([normal[0], normal[1], normal[2], shift]),
        ..*lens
    };
    (along(scene.view.eye) + shift >= 0.0).then_some(Reflected { lens, point, normal })
}

/// The plane that an item mirrors in: a point and its unit normal. A box mirrors in its upper side.
pub fn plane_of(item: &Item) -> ([f64; 3], [f64; 3]) {
    let normal = [item.mat[2], item.mat[5], item.mat[8]].map(f64::from);
    let rise = if item.shape == Shape::Box { f64::from(item.size[2]) } else { 0.0 };
    (std::array::from_fn(|k| f64::from(item.pos[k]) + rise * normal[k]), normal)
}
