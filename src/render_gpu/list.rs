//! What a batch of pictures draws: instances of surfaces, and the calls that draw runs of them.

use crate::passes::{Lens, clip_columns};
use crate::pipelines::Paint;
use crate::places::Places;
use render::Assets;
use render::raster::{Draw, Draws, Facing, Line, distance_of_nearest_point};
use render::scene::{Category, Scene};
use std::ops::Range;

/// Floats of an instance in the shader.
pub const INSTANCE: usize = 52;

/// Instances of one surface in a row, drawn by one call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Call {
    /// Number of the surface in the memory of the GPU.
    pub surface: usize,
    /// First instance.
    pub first: u32,
    /// Number of instances.
    pub count: u32,
    /// Number of the texture there.
    pub texture: Option<usize>,
    /// How they are textured.
    pub paint: Paint,
    /// Which side is seen.
    pub facing: Facing,
}

/// Calls of one picture, as ranges of all calls.
#[derive(Clone, Debug, Default)]
pub struct Calls {
    /// What may be seen and hides what is behind it, but for what mirrors.
    pub opaque: Range<usize>,
    /// What mirrors; empty for nothing.
    pub reflective: Range<usize>,
    /// What may be mirrored and is opaque.
    pub mirrored: Range<usize>,
    /// What is transparent, from front to back.
    pub front_to_back: Range<usize>,
    /// The same from back to front.
    pub back_to_front: Range<usize>,
    /// What casts shadows.
    pub casters: Range<usize>,
    /// What counts for depth and segmentation.
    pub listed: Range<usize>,
    /// Instances of lines.
    pub lines: Range<u32>,
    /// Those of them that count for depth and segmentation.
    pub listed_lines: Range<u32>,
}

/// What is listed of one picture.
#[derive(Clone, Copy)]
pub struct Listing<'a> {
    /// Surfaces of its model.
    pub assets: &'a Assets,
    /// Where they lie in the memory of the GPU.
    pub places: &'a Places,
    /// What it shows.
    pub scene: &'a Scene,
    /// The same, surface by surface.
    pub draws: &'a Draws,
}

/// Instances and calls of a batch. It keeps its memory.
#[derive(Clone, Debug, Default)]
pub struct List {
    /// Instances as the shader reads them.
    pub instances: Vec<[f32; INSTANCE]>,
    /// Calls of all pictures.
    pub calls: Vec<Call>,
    /// Number of the instance of each draw of the current picture.
    numbers: Vec<u32>,
    /// Draws of the current picture by their instance.
    order: Vec<usize>,
    /// Distance and item of what is transparent.
    transparent: Vec<(f32, usize)>,
}

impl List {
    /// Forgets the last batch.
    pub fn clear(&mut self) {
        self.instances.clear();
        self.calls.clear();
    }

    /// Adds a picture's draws; `seen` tells which of them may be in the window.
    pub fn add(
        &mut self,
        listing: &Listing<'_>,
        (line_width, lens): (f32, &Lens<'_>),
        seen: impl Fn(&Draw) -> bool,
    ) -> Calls {
        let Listing { assets, places, scene, draws } = *listing;
        let first = self.instances.len() as u32;
        self.arrange(draws);
        let List { instances, order, .. } = self;
        instances.extend(order.iter().map(|&index| instance(scene, &draws.list[index], lens)));
        let reflective = draws.reflective(scene);
        let solid = |draw: &Draw| !draw.transparent && reflective != Some(draw.item);
        let scene_calls = |list: &mut List, wanted: &dyn Fn(&Draw) -> bool| {
            let begin = list.calls.len();
            for place in 0..list.order.len() {
                let draw = &draws.list[list.order[place]];
                if wanted(draw) && !assets.surfaces[draw.surface].faces.is_empty() {
                    list.push(begin, places, draw, first + place as u32);
                }
            }
            begin..list.calls.len()
        };
        let calls = Calls {
            opaque: scene_calls(self, &|draw| solid(draw) && seen(draw)),
            reflective: scene_calls(self, &|draw| reflective == Some(draw.item) && seen(draw)),
            mirrored: scene_calls(self, &|draw| reflective.is_some() && solid(draw)),
            casters: scene_calls(self, &|draw| scene.items[draw.item].category != Category::Decor),
            listed: scene_calls(self, &|draw| !scene.items[draw.item].unlisted && seen(draw)),
            ..Calls::default()
        };
        self.sort_transparent(scene, draws);
        let front_to_back = self.add_transparent(listing, first, false);
        let back_to_front = self.add_transparent(listing, first, true);
        let first_line = self.instances.len() as u32;
        self.add_lines(scene, draws, line_width, false);
        let first_unlisted = self.instances.len() as u32;
        self.add_lines(scene, draws, line_width, true);
        let lines = first_line..self.instances.len() as u32;
        let listed_lines = first_line..first_unlisted;
        Calls { front_to_back, back_to_front, lines, listed_lines, ..calls }
    }

    /// Numbers the draws so that items of equal shapes in a row have the instances of each of their surfaces in a row.
    fn arrange(&mut self, draws: &Draws) {
        self.order.clear();
        let list = &draws.list;
        let parts = |from: usize| list[from..].iter().take_while(|draw| draw.item == list[from].item).count();
        let surfaces = |from: usize, count: usize| list[from..from + count].iter().map(|draw| draw.surface);
        let mut start = 0;
        while start < list.len() {
            let count = parts(start);
            let mut end = start + count;
            while end < list.len() && parts(end) == count && surfaces(end, count).eq(surfaces(start, count)) {
                end += count;
            }
            for part in 0..count {
                self.order.extend((start + part..end).step_by(count));
            }
            start = end;
        }
        self.numbers.resize(list.len(), 0);
        for (number, &draw) in (0..).zip(&self.order) {
            self.numbers[draw] = number;
        }
    }

    /// Lists the transparent items by the distance of their nearest point.
    fn sort_transparent(&mut self, scene: &Scene, draws: &Draws) {
        let eye = scene.view.eye.map(|x| x as f32);
        self.transparent.clear();
        for draw in draws.list.iter().filter(|draw| draw.transparent) {
            if self.transparent.last().is_none_or(|&(_, item)| item != draw.item) {
                self.transparent.push((distance_of_nearest_point(&scene.items[draw.item], eye), draw.item));
            }
        }
        self.transparent.sort_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// Adds the transparent items in their order or the reverse.
    fn add_transparent(&mut self, listing: &Listing<'_>, first: u32, reverse: bool) -> Range<usize> {
        let Listing { places, draws, .. } = *listing;
        let begin = self.calls.len();
        let count = self.transparent.len();
        for k in 0..count {
            let (_, item) = self.transparent[if reverse { count - 1 - k } else { k }];
            let from = draws.list.partition_point(|draw| draw.item < item);
            for index in (from..draws.list.len()).take_while(|&index| draws.list[index].item == item) {
                self.push(begin, places, &draws.list[index], first + self.numbers[index]);
            }
        }
        begin..self.calls.len()
    }

    /// Adds the lines that are unlisted or not.
    fn add_lines(&mut self, scene: &Scene, draws: &Draws, line_width: f32, unlisted: bool) {
        let chosen = draws.lines.iter().filter(|line| scene.items[line.item].unlisted == unlisted);
        self.instances.extend(chosen.map(|line| line_instance(scene, line, line_width)));
    }

    /// Adds an instance to the last call since `begin`, or a call of its own.
    fn push(&mut self, begin: usize, places: &Places, draw: &Draw, instance: u32) {
        let (paint, texture) = Paint::of(&draw.paint);
        let (surface, texture) = (places.surfaces[draw.surface], texture.map(|index| places.textures[index]));
        let call = Call { surface, first: instance, count: 1, texture, paint, facing: draw.facing };
        if let Some(last) = self.calls[begin..].last_mut() {
            let joined = Call { first: last.first, count: last.count, ..call };
            if joined == *last && last.first + last.count == instance {
                last.count += 1;
                return;
            }
        }
        self.calls.push(call);
    }
}

/// An instance as the shader reads it, relative to the eye.
fn instance(scene: &Scene, draw: &Draw, lens: &Lens<'_>) -> [f32; INSTANCE] {
    let eye = scene.view.eye;
    let item = &scene.items[draw.item];
    let look = [item.look.emission, item.look.specular, 128.0 * item.look.shininess];
    let [r, g, b, _] = item.rgba;
    let (scale, offset) = texture_map(&draw.paint);
    let mut out = [0.0; INSTANCE];
    let rows = out.as_chunks_mut::<4>().0;
    for k in 0..3 {
        let [x, y, z, shift] = draw.world[k];
        rows[k] = [x as f32, y as f32, z as f32, (shift - eye[k]) as f32];
        let [i, j, l] = draw.normals[k];
        rows[3 + k] = [i, j, l, look[k]];
    }
    rows[6] = [r, g, b, draw.alpha(item)];
    rows[7] = scale;
    rows[8] = [offset[0], offset[1], f32::from_bits(draw.item as u32 + 1), 0.0];
    for (row, column) in rows[9..].iter_mut().zip(clip_columns(lens, &draw.world)) {
        *row = column;
    }
    out
}

/// A line as the shader reads it, relative to the eye.
fn line_instance(scene: &Scene, line: &Line, line_width: f32) -> [f32; INSTANCE] {
    let mut out = [0.0; INSTANCE];
    let rows = out.as_chunks_mut::<4>().0;
    for (row, end) in rows.iter_mut().zip(line.ends) {
        for k in 0..3 {
            row[k] = (end[k] - scene.view.eye[k]) as f32;
        }
    }
    rows[2][0] = line.width * line_width;
    rows[6] = scene.items[line.item].rgba;
    rows[8][2] = f32::from_bits(line.item as u32 + 1);
    out
}

/// Factors of texture coordinates with the way in which they are made, and what is added to them.
fn texture_map(paint: &render::geometry::Paint) -> ([f32; 4], [f32; 2]) {
    use render::geometry::Paint;
    match *paint {
        Paint::Plain => ([0.0; 4], [0.0; 2]),
        Paint::Explicit { scale: [s, t], offset, .. } => ([s, t, 0.0, 0.0], offset),
        Paint::Planar { scale: [s, t], .. } => ([s, t, 0.0, 1.0], [0.0; 2]),
        Paint::Cube { scale: [x, y, z], .. } => ([x, y, z, 2.0], [0.0; 2]),
    }
}
