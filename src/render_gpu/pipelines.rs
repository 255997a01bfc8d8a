//! The ways of drawing, made when they are first needed.

use crate::device::Gpu;
use crate::meshes;
use render::Profile;
use render::raster::{CasterRule, Facing};
use std::collections::HashMap;
use wgpu::{
    BindGroupLayout, BlendComponent, BlendFactor, BlendOperation, BlendState, ColorTargetState, ColorWrites,
    CompareFunction, DepthBiasState, Face, PipelineLayout, RenderPipeline, ShaderModule, StencilState,
    TextureFormat,
};

/// How a surface is textured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Paint {
    /// In one colour.
    Plain,
    /// By coordinates in an image.
    Flat,
    /// By a direction.
    Cube,
}

impl Paint {
    /// How a draw is textured, and by which texture.
    pub fn of(paint: &render::geometry::Paint) -> (Self, Option<usize>) {
        use render::geometry::Paint as Given;
        match *paint {
            Given::Plain => (Paint::Plain, None),
            Given::Explicit { texture, .. } | Given::Planar { texture, .. } => (Paint::Flat, Some(texture)),
            Given::Cube { texture, .. } => (Paint::Cube, Some(texture)),
        }
    }
}

/// What a pipeline is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Opaque surfaces under all lights that cast no shadow.
    Base,
    /// The same, added to the mirror image.
    Reflective,
    /// Opaque surfaces in a mirror.
    Mirrored,
    /// Transparent surfaces in a mirror.
    MirroredBlend,
    /// What one light with shadows adds.
    Lamp,
    /// Transparent surfaces.
    Blend,
    /// Numbers and depths of items.
    Item,
    /// Depths in the shadow map of parallel rays, 0 at the near plane.
    Caster,
    /// Depths in the shadow map of a spot, 1 at the near plane.
    SpotCaster,
    /// Lines.
    Line,
    /// Numbers and depths of lines.
    ItemLine,
    /// What mirrors, as an opening for the mirror image.
    Opening,
    /// One depth over the whole picture.
    Cover,
    /// The sky.
    Sky,
    /// Haze over the horizon.
    Haze,
}

/// What tells pipelines from each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key {
    /// What it is for.
    pub kind: Kind,
    /// How surfaces are textured.
    pub paint: Paint,
    /// Which side of them is not drawn.
    pub cull: Option<Face>,
}

impl Key {
    /// A pipeline for what has no texture and no sides.
    pub fn of(kind: Kind) -> Self {
        Key { kind, paint: Paint::Plain, cull: None }
    }

    /// A pipeline for a surface whose side `facing` is seen; a mirror exchanges the sides.
    pub fn surface(kind: Kind, paint: Paint, facing: Facing) -> Self {
        let mirrored = matches!(kind, Kind::Mirrored | Kind::MirroredBlend);
        let cull = match (facing, mirrored) {
            (Facing::Both, _) => None,
            (Facing::Front, false) | (Facing::Back, true) => Some(Face::Back),
            (Facing::Back, false) | (Facing::Front, true) => Some(Face::Front),
        };
        Key { kind, paint, cull }
    }
}

impl Key {
    /// A pipeline for casters of shadows.
    pub fn caster(kind: Kind, rule: CasterRule) -> Self {
        Key { kind, paint: Paint::Plain, cull: rule.averted.then_some(Face::Front) }
    }
}

/// The factor of the slope for casters whose sides `cull` are not drawn.
fn slopes(cull: Option<Face>) -> f32 {
    let profile = if cull.is_some() { Profile::Mujoco313 } else { Profile::Mujoco312 };
    CasterRule::of(profile).slopes
}

/// Colours of pictures.
pub const COLOUR: TextureFormat = TextureFormat::Rgba8Unorm;
/// Depths of pictures and shadow maps.
pub const DEPTH: TextureFormat = TextureFormat::Depth32Float;
/// Numbers and depths of items.
pub const ITEM: TextureFormat = TextureFormat::Rg32Uint;

/// All pipelines so far.
#[derive(Clone, Debug)]
pub struct Pipelines {
    module: ShaderModule,
    /// With the groups of a pass; of a pass and a texture; of a pass, a texture and shadow maps.
    layouts: [PipelineLayout; 3],
    samples: u32,
    known: HashMap<Key, RenderPipeline>,
}

impl Pipelines {
    /// No pipelines yet, for pictures with `samples` samples a pixel and bind groups of these layouts.
    pub fn new(gpu: &Gpu, samples: u32, groups: [&BindGroupLayout; 3]) -> Self {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("renderer"),
            source: wgpu::ShaderSource::Wgsl(include_str!("shader.wgsl").into()),
        });
        let groups = groups.map(Some);
        let layouts = [1, 2, 3].map(|count| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("renderer"),
                bind_group_layouts: &groups[..count],
                immediate_size: 0,
            })
        });
        Pipelines { module, layouts, samples, known: HashMap::new() }
    }

    /// The pipeline of a key.
    pub fn get(&mut self, gpu: &Gpu, key: Key) -> &RenderPipeline {
        let Pipelines { module, layouts, samples, known } = self;
        known.entry(key).or_insert_with(|| create(gpu, module, layouts, *samples, key))
    }
}

/// What one kind of pipeline does.
struct Recipe {
    layout: usize,
    vertex: &'static str,
    fragment: Option<&'static str>,
    /// Reads corners from buffers.
    meshes: bool,
    blend: Option<BlendState>,
    writes_colour: bool,
    compare: CompareFunction,
    writes_depth: bool,
}

/// One times the new plus one times the old.
const SUM: BlendState = BlendState { color: ADDED, alpha: ADDED };
const ADDED: BlendComponent = BlendComponent {
    src_factor: BlendFactor::One,
    dst_factor: BlendFactor::One,
    operation: BlendOperation::Add,
};
/// The new laid over the old with its opacity.
const OVER: BlendState = BlendState { color: LAID, alpha: LAID };
const LAID: BlendComponent = BlendComponent {
    src_factor: BlendFactor::SrcAlpha,
    dst_factor: BlendFactor::OneMinusSrcAlpha,
    operation: BlendOperation::Add,
};

/// What paints mirrored surfaces, cut off at the mirror's plane in each sample, or in each pixel where a GPU cannot do that.
const BY_SAMPLES: &str = "paint_mirrored";
const BY_PIXELS: &str = "paint_mirrored_pixels";

fn recipe(kind: Kind) -> Recipe {
    let surface = |fragment: &'static str, blend: Option<BlendState>, writes_depth: bool| Recipe {
        layout: 1,
        vertex: "corner",
        fragment: Some(fragment),
        meshes: true,
        blend,
        writes_colour: true,
        compare: CompareFunction::GreaterEqual,
        writes_depth,
    };
    let plain = Recipe { layout: 0, ..surface("write_nothing", None, true) };
    match kind {
        Kind::Base => surface("paint", None, true),
        Kind::Reflective => surface("paint", Some(SUM), true),
        Kind::Mirrored => surface(BY_SAMPLES, None, true),
        Kind::MirroredBlend => surface(BY_SAMPLES, Some(OVER), false),
        Kind::Lamp => Recipe { layout: 2, ..surface("paint_lamp", Some(SUM), false) },
        Kind::Blend => surface("paint", Some(OVER), false),
        Kind::Item => Recipe { vertex: "listed", fragment: Some("write_item"), ..plain },
        Kind::Line => Recipe { vertex: "line", fragment: Some("paint_line"), meshes: false, ..plain },
        Kind::ItemLine => {
            Recipe { vertex: "line", fragment: Some("write_item_of_line"), meshes: false, ..plain }
        }
        Kind::Caster => Recipe { vertex: "caster", fragment: None, compare: CompareFunction::Less, ..plain },
        Kind::SpotCaster => {
            Recipe { vertex: "caster", fragment: None, compare: CompareFunction::Greater, ..plain }
        }
        Kind::Opening => {
            Recipe { vertex: "opening", writes_colour: false, compare: CompareFunction::Always, ..plain }
        }
        Kind::Cover => Recipe {
            vertex: "cover",
            meshes: false,
            writes_colour: false,
            compare: CompareFunction::Always,
            ..plain
        },
        Kind::Sky => Recipe { vertex: "sky", meshes: false, ..surface("paint_sky", None, false) },
        Kind::Haze => Recipe { vertex: "haze", meshes: false, ..surface("paint_haze", Some(OVER), false) },
    }
}

fn create(
    gpu: &Gpu,
    module: &ShaderModule,
    layouts: &[PipelineLayout; 3],
    samples: u32,
    key: Key,
) -> RenderPipeline {
    let Recipe { layout, vertex, fragment, meshes, blend, writes_colour, compare, writes_depth } =
        recipe(key.kind);
    let (format, samples) = match key.kind {
        Kind::Item | Kind::ItemLine => (ITEM, 1),
        Kind::Caster | Kind::SpotCaster => (COLOUR, 1),
        _ => (COLOUR, samples),
    };
    let paint = match key.paint {
        Paint::Plain => 0.0,
        Paint::Flat => 1.0,
        Paint::Cube => 2.0,
    };
    let constants = [("PAINT", paint), ("SAMPLES", f64::from(samples))];
    let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    // Pictures stay opaque; numbers and depths of items have two channels.
    let write_mask = if writes_colour { ColorWrites::COLOR } else { ColorWrites::empty() };
    let targets = [Some(ColorTargetState { format, blend, write_mask })];
    // The slope is the factor of `glPolygonOffset`; its units are added where the map is read.
    let slope_scale = match key.kind {
        Kind::Caster => slopes(key.cull),
        Kind::SpotCaster => -slopes(key.cull),
        _ => 0.0,
    };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(vertex),
        layout: Some(&layouts[layout]),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: options.clone(),
            buffers: if meshes { &[Some(meshes::LAYOUT)] } else { &[] },
        },
        primitive: wgpu::PrimitiveState {
            // Pictures are upside down, which exchanges the sides.
            front_face: wgpu::FrontFace::Cw,
            cull_mode: key.cull,
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(writes_depth),
            depth_compare: Some(compare),
            stencil: StencilState::default(),
            bias: DepthBiasState { constant: 0, slope_scale, clamp: 0.0 },
        }),
        multisample: wgpu::MultisampleState { count: samples, ..wgpu::MultisampleState::default() },
        fragment: fragment.map(|entry| wgpu::FragmentState {
            module,
            entry_point: Some(if entry == BY_SAMPLES && gpu.is_opengl { BY_PIXELS } else { entry }),
            compilation_options: options.clone(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
