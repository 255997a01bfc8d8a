//! Shadow maps: layers of one texture, used in turn by the lights of all pictures.

use crate::device::Gpu;
use crate::pipelines::DEPTH;
use render::raster::{CasterRule, ShadowMaps};
use render::scene::{Item, Scene, Shape};
use wgpu::{
    BindGroup, BindGroupLayout, BindGroupLayoutEntry, BindingType, Extent3d, ShaderStages, TextureSampleType,
    TextureUsages, TextureView, TextureViewDescriptor, TextureViewDimension,
};

/// Most memory of all layers together \[byte\]; one layer is made in any case.
const MEMORY: usize = 1 << 28;
/// Most layers.
const LAYERS: usize = 32;

/// One light of one picture.
#[derive(Clone, Copy, Debug)]
pub struct Lamp {
    /// The picture.
    pub tile: usize,
    /// The pass that adds its light.
    pub light: u32,
    /// Its shadow map.
    pub shadow: usize,
}

/// One shadow map, which pictures of the same state share.
#[derive(Clone, Copy, Debug)]
pub struct Shadow {
    /// The picture whose casters it shows.
    pub tile: usize,
    /// The pass that draws it.
    pub casters: u32,
    /// Where it lies in the world.
    pub maps: ShadowMaps,
    /// Depth in it is reversed: 1 at the near plane.
    pub reversed: bool,
    /// How casters are drawn.
    pub rule: CasterRule,
}

/// Whether two scenes cast the same shadows from the same light. Endless planes may be centred elsewhere.
pub fn same_casters(a: &Scene, b: &Scene) -> bool {
    a.items.len() == b.items.len() && a.items.iter().zip(&b.items).all(|(a, b)| is_same(a, b))
}

fn is_same(a: &Item, b: &Item) -> bool {
    let endless = matches!(a.shape, Shape::Plane { .. }) && (a.size[0] <= 0.0 || a.size[1] <= 0.0);
    if !endless || a.shape != b.shape || a.mat != b.mat || a.size != b.size {
        return a == b;
    }
    let rise: f32 = (0..3).map(|k| a.mat[3 * k + 2] * (a.pos[k] - b.pos[k])).sum();
    rise.abs() < SAME_HEIGHT
}

/// Heights of endless planes that differ by less are rounding errors of their centres \[m\].
const SAME_HEIGHT: f32 = 1e-5;

/// The layers.
#[derive(Clone, Debug)]
pub struct Lamps {
    layout: BindGroupLayout,
    size: usize,
    maps: Option<Maps>,
}

/// Layers that exist.
#[derive(Clone, Debug)]
pub struct Maps {
    /// All layers, to be read.
    pub group: BindGroup,
    /// Each layer, to be drawn to.
    pub layers: Vec<TextureView>,
}

impl Lamps {
    /// Lamps without layers, for maps with `size` texels along a side.
    pub fn new(gpu: &Gpu, size: usize) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("shadow maps"),
            entries: &[BindGroupLayoutEntry {
                binding: 0,
                visibility: ShaderStages::FRAGMENT,
                ty: BindingType::Texture {
                    sample_type: TextureSampleType::Float { filterable: false },
                    view_dimension: TextureViewDimension::D2Array,
                    multisampled: false,
                },
                count: None,
            }],
        });
        Lamps { layout, size, maps: None }
    }

    /// How pipelines read the layers.
    pub fn layout(&self) -> &BindGroupLayout {
        &self.layout
    }

    /// Texels along a side of a map; 0 for no shadows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Layers that `shadows` shadow maps may use at once.
    pub fn layers(&self, shadows: usize) -> usize {
        let most = MEMORY / (4 * self.size * self.size).max(1);
        shadows.clamp(1, most.clamp(1, LAYERS))
    }

    /// Makes at least `layers` layers.
    pub fn reserve(&mut self, gpu: &Gpu, layers: usize) -> &Maps {
        if self.maps.as_ref().is_some_and(|maps| maps.layers.len() < layers) {
            self.maps = None;
        }
        let Lamps { layout, size, maps } = self;
        maps.get_or_insert_with(|| create(gpu, layout, *size as u32, layers as u32))
    }
}

fn create(gpu: &Gpu, layout: &BindGroupLayout, side: u32, layers: u32) -> Maps {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow maps"),
        size: Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: layers.max(if gpu.is_opengl { 2 } else { 1 }),
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH,
        usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let all = texture.create_view(&TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2Array),
        ..TextureViewDescriptor::default()
    });
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("shadow maps"),
        layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&all) }],
    });
    let layer = |base_array_layer: u32| {
        texture.create_view(&TextureViewDescriptor {
            dimension: Some(TextureViewDimension::D2),
            base_array_layer,
            array_layer_count: Some(1),
            ..TextureViewDescriptor::default()
        })
    };
    Maps { group, layers: (0..layers).map(layer).collect() }
}
