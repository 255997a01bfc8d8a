//! The commands that draw a batch: the passes of MuJoCo's renderer, each over all pictures.

use crate::atlas::{Atlas, Colours, Grid};
use crate::device::Gpu;
use crate::lamps::{Maps, Shadow};
use crate::list::Call;
use crate::meshes::Meshes;
use crate::passes::STRIDE;
use crate::pipelines::{Key, Kind, Paint, Pipelines};
use crate::stage::{Stage, Tile};
use crate::textures::Textures;
use std::ops::Range;
use wgpu::{Color, CommandEncoder, LoadOp, Operations, RenderPass, StoreOp, TextureView};

/// What commands refer to.
pub struct Studio<'a> {
    /// The GPU.
    pub gpu: &'a Gpu,
    /// The batch.
    pub stage: &'a Stage,
    /// Its surfaces.
    pub meshes: &'a Meshes,
    /// Its textures.
    pub textures: &'a Textures,
    /// Ways of drawing.
    pub pipelines: &'a mut Pipelines,
}

/// A render pass under construction, with what is set in it.
struct Pen<'p, 's> {
    pass: RenderPass<'p>,
    gpu: &'s Gpu,
    stage: &'s Stage,
    meshes: &'s Meshes,
    textures: &'s Textures,
    pipelines: &'s mut Pipelines,
    key: Option<Key>,
    texture: Option<Option<usize>>,
}

impl Studio<'_> {
    /// Draws numbers and depths of items.
    pub fn items(&mut self, encoder: &mut CommandEncoder, atlas: &mut Atlas) {
        let grid = atlas.grid;
        let targets = atlas.items(self.gpu);
        let colour = wgpu::RenderPassColorAttachment {
            view: &targets.numbers.view,
            depth_slice: None,
            resolve_target: None,
            ops: Operations { load: LoadOp::Clear(Color::TRANSPARENT), store: StoreOp::Store },
        };
        let depth = depth_attachment(&targets.depth.view, LoadOp::Clear(0.0), StoreOp::Discard);
        let mut pen = self.begin(encoder, &[Some(colour)], depth);
        for (cell, tile) in pen.stage.tiles.iter().enumerate() {
            pen.picture(&grid, cell, tile);
            pen.pass(tile.base);
            pen.calls(Kind::Item, tile.calls.listed.clone());
            pen.lines(Kind::ItemLine, tile.calls.listed_lines.clone());
        }
    }

    /// Draws colours; `maps` are the shadow maps that lights use in turn.
    pub fn colours(&mut self, encoder: &mut CommandEncoder, atlas: &mut Atlas, maps: Option<&Maps>) {
        let grid = atlas.grid;
        let targets = atlas.colours(self.gpu);
        let stage = self.stage;
        let lamps = maps.map_or(&[][..], |_| &stage.lamps);
        {
            let mut pen = self.over_colours(encoder, targets, true, lamps.is_empty());
            for (cell, tile) in stage.tiles.iter().enumerate() {
                pen.picture(&grid, cell, tile);
                pen.open(tile);
            }
            if lamps.is_empty() {
                pen.close_all(&grid);
            }
        }
        let Some(maps) = maps else { return };
        let layers = maps.layers.len();
        let rounds = stage.shadows.chunks(layers);
        let last = rounds.len().saturating_sub(1);
        for (round, shadows) in rounds.enumerate() {
            for (shadow, layer) in shadows.iter().zip(&maps.layers) {
                self.casters(encoder, shadow, layer);
            }
            let mut pen = self.over_colours(encoder, targets, false, round == last);
            pen.pass.set_bind_group(2, &maps.group, &[]);
            for lamp in lamps.iter().filter(|lamp| lamp.shadow / layers == round) {
                let tile = &stage.tiles[lamp.tile];
                pen.picture(&grid, lamp.tile, tile);
                pen.pass(lamp.light);
                pen.calls(Kind::Lamp, tile.calls.reflective.clone());
                pen.calls(Kind::Lamp, tile.calls.opaque.clone());
            }
            if round == last {
                pen.close_all(&grid);
            }
        }
    }

    /// Draws a shadow map.
    fn casters(&mut self, encoder: &mut CommandEncoder, shadow: &Shadow, layer: &TextureView) {
        let (kind, nothing) = if shadow.reversed { (Kind::SpotCaster, 0.0) } else { (Kind::Caster, 1.0) };
        let depth = depth_attachment(layer, LoadOp::Clear(nothing), StoreOp::Store);
        let mut pen = self.begin(encoder, &[], depth);
        pen.pass(shadow.casters);
        let casters = pen.stage.tiles[shadow.tile].calls.casters.clone();
        pen.casters(Key::caster(kind, shadow.rule), casters);
    }

    /// Begins a pass over colours: the first clears them, the last leaves only the means of the samples.
    fn over_colours<'s>(
        &'s mut self,
        encoder: &'s mut CommandEncoder,
        targets: &Colours,
        first: bool,
        last: bool,
    ) -> Pen<'s, 's> {
        let mean = targets.mean.as_ref().filter(|_| last);
        let (colour_load, depth_load) = match first {
            true => (LoadOp::Clear(Color::BLACK), LoadOp::Clear(0.0)),
            false => (LoadOp::Load, LoadOp::Load),
        };
        let colour = wgpu::RenderPassColorAttachment {
            view: &targets.samples.view,
            depth_slice: None,
            resolve_target: mean.map(|mean| &mean.view),
            ops: Operations {
                load: colour_load,
                store: if mean.is_some() { StoreOp::Discard } else { StoreOp::Store },
            },
        };
        let store = if last { StoreOp::Discard } else { StoreOp::Store };
        let depth = depth_attachment(&targets.depth.view, depth_load, store);
        self.begin(encoder, &[Some(colour)], depth)
    }

    fn begin<'s>(
        &'s mut self,
        encoder: &'s mut CommandEncoder,
        colours: &[Option<wgpu::RenderPassColorAttachment<'_>>],
        depth: wgpu::RenderPassDepthStencilAttachment<'_>,
    ) -> Pen<'s, 's> {
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("pictures"),
            color_attachments: colours,
            depth_stencil_attachment: Some(depth),
            ..wgpu::RenderPassDescriptor::default()
        });
        let Studio { gpu, stage, meshes, textures, pipelines } = self;
        let mut pen = Pen { pass, gpu, stage, meshes, textures, pipelines, key: None, texture: None };
        meshes.bind(&mut pen.pass);
        pen
    }
}

fn depth_attachment(
    view: &TextureView,
    load: LoadOp<f32>,
    store: StoreOp,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(Operations { load, store }),
        stencil_ops: None,
    }
}

impl Pen<'_, '_> {
    /// Confines what follows to the cell of a picture.
    fn picture(&mut self, grid: &Grid, cell: usize, tile: &Tile) {
        let [x, y] = grid.origin(cell);
        let [width, height] = tile.size;
        self.pass.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
        self.pass.set_scissor_rect(x as u32, y as u32, width as u32, height as u32);
    }

    /// Sets the pass that what follows belongs to.
    fn pass(&mut self, number: u32) {
        self.pass.set_bind_group(0, self.stage.group(), &[number * STRIDE as u32]);
    }

    fn set(&mut self, key: Key) {
        if self.key != Some(key) {
            self.key = Some(key);
            self.pass.set_pipeline(self.pipelines.get(self.gpu, key));
        }
    }

    fn texture(&mut self, texture: Option<usize>) {
        if self.texture != Some(texture) {
            self.texture = Some(texture);
            self.pass.set_bind_group(1, self.textures.group(texture), &[]);
        }
    }

    /// Draws calls in one way.
    fn calls(&mut self, kind: Kind, calls: Range<usize>) {
        for call in &self.stage.list.calls[calls] {
            self.set(Key::surface(kind, call.paint, call.facing));
            self.texture(call.texture);
            self.call(call);
        }
    }

    /// Draws calls without colours.
    fn casters(&mut self, key: Key, calls: Range<usize>) {
        self.set(key);
        for call in &self.stage.list.calls[calls] {
            self.call(call);
        }
    }

    fn call(&mut self, call: &Call) {
        let place = self.meshes.place(call.surface);
        let indices = place.first_index..place.first_index + place.indices;
        self.pass.draw_indexed(indices, place.first_corner, call.first..call.first + call.count);
    }

    /// The mirror image, and opaque surfaces under the lights without shadows.
    fn open(&mut self, tile: &Tile) {
        if let Some(mirror) = tile.mirror.filter(|_| !tile.calls.reflective.is_empty()) {
            self.pass(tile.base);
            self.cover(1);
            for call in &self.stage.list.calls[tile.calls.reflective.clone()] {
                self.set(Key::surface(Kind::Opening, Paint::Plain, call.facing));
                self.call(call);
            }
            self.pass(mirror);
            self.calls(Kind::Mirrored, tile.calls.mirrored.clone());
            self.calls(Kind::MirroredBlend, tile.calls.front_to_back.clone());
            self.calls(Kind::MirroredBlend, tile.calls.back_to_front.clone());
            self.cover(0);
        }
        self.pass(tile.base);
        self.calls(Kind::Reflective, tile.calls.reflective.clone());
        self.calls(Kind::Base, tile.calls.opaque.clone());
        self.lines(Kind::Line, tile.calls.lines.clone());
    }

    /// Draws lines.
    fn lines(&mut self, kind: Kind, lines: Range<u32>) {
        if !lines.is_empty() {
            self.set(Key::of(kind));
            self.pass.draw(0..6, lines);
        }
    }

    /// Gives every sample of the picture this depth.
    fn cover(&mut self, depth: u32) {
        self.set(Key::of(Kind::Cover));
        self.pass.draw(0..3, depth..depth + 1);
    }

    /// Sky, haze and transparent surfaces of all pictures.
    fn close_all(&mut self, grid: &Grid) {
        for (cell, tile) in self.stage.tiles.iter().enumerate() {
            self.picture(grid, cell, tile);
            self.pass(tile.all);
            if tile.sky.is_some() {
                self.set(Key { paint: Paint::Cube, ..Key::of(Kind::Sky) });
                self.texture(tile.sky);
                self.pass.draw(0..12 * tile.slices, 0..1);
            }
            if tile.haze {
                self.set(Key::of(Kind::Haze));
                self.texture(None);
                self.pass.draw(0..12 * tile.slices, 0..1);
            }
            self.calls(Kind::Blend, tile.calls.front_to_back.clone());
            self.calls(Kind::Blend, tile.calls.back_to_front.clone());
        }
    }
}
