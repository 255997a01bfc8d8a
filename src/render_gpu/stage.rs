//! A batch on its way to the GPU: the instances, calls, passes and lights of all its pictures.

use crate::device::Gpu;
use crate::error::GpuError;
use crate::growing::Growing;
use crate::lamps::{Lamp, Lamps, Shadow, same_casters};
use crate::list::{Calls, INSTANCE, List, Listing};
use crate::passes::{
    self, EMISSION, LIGHTS, Lens, MIRROR, Pass, STRIDE, clip_rows, moved, relative, write_lights,
};
use crate::places::Seen;
use render::raster::{CasterRule, Draw, Draws, Projection, Settings, mirror_map, mirror_plane, shadow_maps};
use render::scene::LightKind;
use render::{Assets, RenderError};
use wgpu::{
    BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutEntry, BindingResource, BindingType,
    BufferBindingType, BufferUsages, ShaderStages,
};

/// How many pictures back one of the same state is looked for, whose shadow maps it shares: cameras of an environment.
const CAMERAS: usize = 8;

/// One picture of a batch.
#[derive(Clone, Debug)]
pub struct Tile {
    /// Columns and rows \[pixel\].
    pub size: [usize; 2],
    /// What it draws.
    pub calls: Calls,
    /// Number of the pass with the lights that cast no shadows.
    pub base: u32,
    /// Number of the pass with all lights.
    pub all: u32,
    /// Number of the pass of the mirror image, where there is one.
    pub mirror: Option<u32>,
    /// The texture of the sky.
    pub sky: Option<usize>,
    /// There is haze.
    pub haze: bool,
    /// Slices of the sky and the haze.
    pub slices: u32,
}

/// What a batch draws. It keeps its memory.
#[derive(Debug)]
pub struct Stage {
    /// The pictures.
    pub tiles: Vec<Tile>,
    /// Instances and calls.
    pub list: List,
    /// Lights with shadows, in the order of their maps.
    pub lamps: Vec<Lamp>,
    /// Shadow maps.
    pub shadows: Vec<Shadow>,
    draws: Draws,
    passes: Vec<u8>,
    lights: Vec<[f32; 24]>,
    buffers: [Growing; 3],
    layout: BindGroupLayout,
    group: Option<BindGroup>,
}

impl Stage {
    /// An empty batch.
    pub fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        Stage {
            tiles: Vec::new(),
            list: List::default(),
            lamps: Vec::new(),
            shadows: Vec::new(),
            draws: Draws::default(),
            passes: Vec::new(),
            lights: Vec::new(),
            buffers: [
                Growing::new(device, "passes", BufferUsages::UNIFORM | BufferUsages::COPY_DST),
                Growing::new(device, "instances", storage),
                Growing::new(device, "lights", storage),
            ],
            layout: layout(gpu),
            group: None,
        }
    }

    /// How pipelines read passes, instances and lights.
    pub fn layout(&self) -> &BindGroupLayout {
        &self.layout
    }

    /// Passes, instances and lights; the offset of the pass is given when they are bound.
    pub fn group(&self) -> Option<&BindGroup> {
        self.group.as_ref()
    }

    /// Forgets the last batch.
    pub fn clear(&mut self) {
        self.tiles.clear();
        self.list.clear();
        self.lamps.clear();
        self.shadows.clear();
        self.passes.clear();
        self.lights.clear();
    }

    /// Adds the last of these pictures; those before it are in the batch already.
    ///
    /// # Errors
    /// The view's frustum is empty or not finite, or the scene has too many triangles.
    pub fn add(
        &mut self,
        seen: &[Seen<'_>],
        size: [usize; 2],
        settings: &Settings,
        maps: &Lamps,
    ) -> Result<(), RenderError> {
        let Some((Seen { assets, scene, places }, before)) = seen.split_last() else { return Ok(()) };
        let [width, height] = size;
        let projection = Projection::of(&scene.view, width, height)?;
        self.draws.update(assets, scene)?;
        let window = [width as f64, height as f64];
        let in_window = |draw: &Draw| !is_beside(&projection, assets, draw, window);
        let calls = self.list.add(
            &Listing { places, scene, draws: &self.draws, assets },
            (settings.line_width, &Lens { projection: &projection, window }),
            in_window,
        );
        let first_light = self.lights.len() as u32;
        write_lights(scene, &mut self.lights);
        let clip = clip_rows(&projection, scene.view.eye, window);
        let common = Pass {
            first_light,
            slices: settings.slices,
            window: window.map(|x| x as f32),
            ..Pass::new(scene, clip)
        };
        let lit = |shadowed: bool| {
            let with_shadow = |light: &render::scene::Light| scene.shadows && maps.size() > 0 && light.shadow;
            let chosen = scene.lights.iter().take(LIGHTS).enumerate();
            chosen.filter(|(_, light)| with_shadow(light) == shadowed).fold(0, |bits, (k, _)| bits | 1 << k)
        };
        let (open, shadowed): (u32, u32) = (lit(false), lit(true));
        let base = self.push(&Pass { lights: open | EMISSION, ..common.clone() });
        let all = match shadowed {
            0 => base,
            _ => self.push(&Pass { lights: open | shadowed | EMISSION, ..common.clone() }),
        };
        let mirror = self.mirror(&common, &projection, open | shadowed | EMISSION | MIRROR, window);
        let tile = self.tiles.len();
        let near = before.len().saturating_sub(CAMERAS)..before.len();
        let twin = match shadowed {
            0 => None,
            _ => near
                .rev()
                .find(|&tile| same_casters(before[tile].scene, scene) && before[tile].places == *places),
        };
        for bit in (0..LIGHTS as u32).filter(|bit| shadowed >> bit & 1 != 0) {
            self.lamp(CasterRule::of(assets.profile()), &common, (tile, twin), bit, settings);
        }
        let sky = scene.sky.filter(|&sky| assets.textures.get(sky).is_some_and(|texture| texture.is_cube()));
        let sky = sky.map(|sky| places.textures[sky]);
        let haze = sky.is_some() && scene.haze.is_some();
        self.tiles.push(Tile { size, calls, base, all, mirror, sky, haze, slices: settings.slices as u32 });
        Ok(())
    }

    /// Adds the pass of the mirror image, where something mirrors and its upper side is seen.
    fn mirror(
        &mut self,
        common: &Pass<'_>,
        projection: &Projection,
        lights: u32,
        window: [f64; 2],
    ) -> Option<u32> {
        let scene = common.scene;
        let item = self.draws.reflective(scene)?;
        let (point, normal) = mirror_plane(&scene.items[item]);
        let eye = scene.view.eye;
        let shift = -(0..3).map(|k| normal[k] * point[k]).sum::<f64>();
        let plane = [normal[0], normal[1], normal[2], shift];
        let above = relative(plane, eye);
        if above[3] < 0.0 {
            return None;
        }
        let map = mirror_map(point, normal);
        let turned: [f64; 3] =
            std::array::from_fn(|j| (0..3).map(|i| scene.view.forward[i] * map[i][j]).sum::<f64>());
        let shift = -(0..3).map(|k| scene.view.forward[k] * (eye[k] - map[k][3])).sum::<f64>();
        Some(self.push(&Pass {
            clip: clip_rows(&projection.mirrored(point, normal), eye, window),
            mirror: above,
            from: moved(&map, eye, eye),
            reflectance: scene.items[item].look.reflectance,
            depth: relative([turned[0], turned[1], turned[2], shift], eye),
            lights,
            ..common.clone()
        }))
    }

    /// Adds the passes of a light with shadows. It shares the map of the picture's twin where both have the same.
    fn lamp(
        &mut self,
        rule: CasterRule,
        common: &Pass<'_>,
        (tile, twin): (usize, Option<usize>),
        bit: u32,
        settings: &Settings,
    ) {
        let (scene, eye) = (common.scene, common.scene.view.eye);
        let source = &scene.lights[bit as usize];
        let reversed = matches!(source.kind, LightKind::Spot { .. });
        let maps = shadow_maps(source, scene, &settings.shadow);
        let size = settings.shadow.size;
        let of_twin = self.lamps.iter().filter(|lamp| Some(lamp.tile) == twin).map(|lamp| lamp.shadow);
        let known = of_twin.into_iter().find(|&shadow| self.shadows[shadow].maps == maps);
        let shadow = known.unwrap_or_else(|| {
            let clip = clip_rows(&turned(&maps.casters, reversed), eye, [size as f64; 2]);
            let casters = self.push(&Pass { clip, ..common.clone() });
            self.shadows.push(Shadow { tile, casters, maps, reversed, rule });
            self.shadows.len() - 1
        });
        let map = turned(&maps.lookups, reversed).0.map(|row| relative(row, eye));
        let light = self.push(&Pass {
            map,
            lights: 1 << bit,
            map_size: size,
            reversed,
            offset: rule.constant,
            ..common.clone()
        });
        self.lamps.push(Lamp { tile, light, shadow });
    }

    /// Adds a pass; its number.
    fn push(&mut self, pass: &Pass<'_>) -> u32 {
        let number = self.passes.len() / STRIDE;
        pass.write(&mut self.passes);
        number as u32
    }

    /// Puts the shadow maps into `layers` layers, over and over, and sorts the lamps by their maps.
    fn arrange_lamps(&mut self, layers: usize) {
        self.lamps.sort_by_key(|lamp| lamp.shadow);
        for lamp in &self.lamps {
            passes::set_layer(&mut self.passes, lamp.light, (lamp.shadow % layers) as u32);
        }
    }

    /// Uploads the batch; shadow maps have `layers` layers.
    pub fn upload(&mut self, gpu: &Gpu, layers: usize) -> Result<(), GpuError> {
        self.arrange_lamps(layers);
        let Stage { list, passes, lights, buffers, layout, group, .. } = self;
        let contents: [&[u8]; 3] =
            [passes, bytemuck::cast_slice(&list.instances), bytemuck::cast_slice(lights)];
        let mut moved = group.is_none();
        for (buffer, bytes) in buffers.iter_mut().zip(contents) {
            moved |= buffer.reserve(&gpu.device, bytes.len() as u64);
            gpu.queue.write_buffer(buffer.buffer(), 0, bytes);
        }
        if moved {
            *group = Some(bind(gpu, layout, buffers));
        }
        gpu.check()
    }
}

/// A map with its depth reversed or not. That of a spot is near 1 but close to the lamp, where single precision has few
/// bits; reversed it is near 0.
fn turned(map: &Projection, reversed: bool) -> Projection {
    let [x, y, z, w] = map.0;
    Projection([x, y, if reversed { std::array::from_fn(|k| w[k] - z[k]) } else { z }, w])
}

fn layout(gpu: &Gpu) -> BindGroupLayout {
    let entry =
        |binding: u32, visibility: ShaderStages, ty: BufferBindingType, size: usize| BindGroupLayoutEntry {
            binding,
            visibility,
            ty: BindingType::Buffer {
                ty,
                has_dynamic_offset: binding == 0,
                min_binding_size: std::num::NonZeroU64::new(size as u64),
            },
            count: None,
        };
    let storage = BufferBindingType::Storage { read_only: true };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("pass"),
        entries: &[
            entry(0, ShaderStages::VERTEX_FRAGMENT, BufferBindingType::Uniform, passes::BYTES),
            entry(1, ShaderStages::VERTEX, storage, 4 * INSTANCE),
            entry(2, ShaderStages::VERTEX, storage, 96),
        ],
    })
}

fn bind(gpu: &Gpu, layout: &BindGroupLayout, [passes, instances, lights]: &[Growing; 3]) -> BindGroup {
    let pass = wgpu::BufferBinding {
        buffer: passes.buffer(),
        offset: 0,
        size: std::num::NonZeroU64::new(passes::BYTES as u64),
    };
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("pass"),
        layout,
        entries: &[
            BindGroupEntry { binding: 0, resource: BindingResource::Buffer(pass) },
            BindGroupEntry { binding: 1, resource: instances.buffer().as_entire_binding() },
            BindGroupEntry { binding: 2, resource: lights.buffer().as_entire_binding() },
        ],
    })
}

/// Whether the box of a draw lies beyond one side of the window, before the near plane or beyond the far one.
fn is_beside(projection: &Projection, assets: &Assets, draw: &Draw, [width, height]: [f64; 2]) -> bool {
    let [middle, size] = assets.surfaces[draw.surface].bounds;
    let mut beyond = u32::MAX;
    for corner in 0..8_u32 {
        let p: [f64; 3] = std::array::from_fn(|k| {
            let side = if corner >> k & 1 == 0 { -size[k] } else { size[k] };
            f64::from(middle[k] + side)
        });
        let at = draw.world.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
        let [x, y, z, w] = projection.0.map(|row| row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3]);
        let faces = [x < 0.0, x > w * width, y < 0.0, y > w * height, z > w, z < 0.0];
        beyond &= faces.iter().enumerate().fold(0, |bits, (bit, &is)| bits | u32::from(is) << bit);
    }
    beyond != 0
}
