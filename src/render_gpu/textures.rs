//! The textures of a batch in the memory of the GPU, with the mip chains that the CPU renderer filters.

use crate::device::Gpu;
use render::Assets;
use render::texture::{LevelImage, Texture};
use std::collections::HashSet;
use std::sync::Arc;
use wgpu::{
    AddressMode, BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutEntry, BindingResource,
    BindingType, Extent3d, FilterMode, MipmapFilterMode, Sampler, SamplerBindingType, ShaderStages,
    TexelCopyBufferLayout, TextureFormat, TextureSampleType, TextureUsages, TextureView,
    TextureViewDescriptor, TextureViewDimension,
};

/// Textures, each ready to be bound.
#[derive(Clone, Debug)]
pub struct Textures {
    layout: BindGroupLayout,
    samplers: [Sampler; 2],
    /// White, where there is no flat or no cube texture.
    white: [TextureView; 2],
    plain: BindGroup,
    ready: Vec<Ready>,
}

/// A texture, ready to be bound.
#[derive(Clone, Debug)]
struct Ready {
    texture: Arc<Texture>,
    group: BindGroup,
}

impl Textures {
    /// No textures yet.
    pub fn new(gpu: &Gpu) -> Self {
        let layout = layout(gpu);
        let sampler = |mode: AddressMode| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                address_mode_u: mode,
                address_mode_v: mode,
                address_mode_w: mode,
                mag_filter: FilterMode::Linear,
                min_filter: FilterMode::Linear,
                mipmap_filter: MipmapFilterMode::Linear,
                ..wgpu::SamplerDescriptor::default()
            })
        };
        let samplers = [sampler(AddressMode::Repeat), sampler(AddressMode::ClampToEdge)];
        let pixel =
            |face: usize| LevelImage { level: 0, face, width: 1, height: 1, stride: 1, pixels: &[u32::MAX] };
        let white = [
            upload(gpu, &[pixel(0)], TextureFormat::Rgba8Unorm, false),
            upload(gpu, &[0, 1, 2, 3, 4, 5].map(pixel), TextureFormat::Rgba8Unorm, true),
        ];
        let plain = group(gpu, &layout, &samplers, [&white[0], &white[1]]);
        Textures { layout, samplers, white, plain, ready: Vec::new() }
    }

    /// How pipelines read textures.
    pub fn layout(&self) -> &BindGroupLayout {
        &self.layout
    }

    /// Uploads the textures that are not there yet, and drops those that no assets have.
    pub fn update(&mut self, gpu: &Gpu, assets: &[&Assets]) {
        let all = || assets.iter().flat_map(|assets| &assets.textures);
        let wanted: HashSet<_> = all().map(Arc::as_ptr).collect();
        self.ready.retain(|ready| wanted.contains(&Arc::as_ptr(&ready.texture)));
        let mut known: HashSet<_> = self.ready.iter().map(|ready| Arc::as_ptr(&ready.texture)).collect();
        for texture in all().filter(|texture| known.insert(Arc::as_ptr(texture))) {
            let group = self.prepare(gpu, texture);
            self.ready.push(Ready { texture: texture.clone(), group });
        }
    }

    /// The number of a texture that was uploaded.
    pub fn number(&self, texture: &Arc<Texture>) -> usize {
        let found = self.ready.iter().position(|ready| Arc::ptr_eq(&ready.texture, texture));
        found.expect("every texture of a batch is uploaded before it is drawn")
    }

    /// A texture ready to be bound, or white for none.
    pub fn group(&self, texture: Option<usize>) -> &BindGroup {
        texture.and_then(|number| self.ready.get(number)).map_or(&self.plain, |ready| &ready.group)
    }

    fn prepare(&self, gpu: &Gpu, texture: &Texture) -> BindGroup {
        let images = texture.images();
        if images.is_empty() {
            return self.plain.clone();
        }
        let format =
            if texture.is_srgb() { TextureFormat::Rgba8UnormSrgb } else { TextureFormat::Rgba8Unorm };
        let view = upload(gpu, &images, format, texture.is_cube());
        let views = if texture.is_cube() { [&self.white[0], &view] } else { [&view, &self.white[1]] };
        group(gpu, &self.layout, &self.samplers, views)
    }
}

fn layout(gpu: &Gpu) -> BindGroupLayout {
    let texture = |binding: u32, view_dimension: TextureViewDimension| BindGroupLayoutEntry {
        binding,
        visibility: ShaderStages::FRAGMENT,
        ty: BindingType::Texture {
            sample_type: TextureSampleType::Float { filterable: true },
            view_dimension,
            multisampled: false,
        },
        count: None,
    };
    let sampler = |binding: u32| BindGroupLayoutEntry {
        binding,
        visibility: ShaderStages::FRAGMENT,
        ty: BindingType::Sampler(SamplerBindingType::Filtering),
        count: None,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("texture"),
        entries: &[
            texture(0, TextureViewDimension::D2),
            texture(1, TextureViewDimension::Cube),
            sampler(2),
            sampler(3),
        ],
    })
}

fn group(
    gpu: &Gpu,
    layout: &BindGroupLayout,
    samplers: &[Sampler; 2],
    views: [&TextureView; 2],
) -> BindGroup {
    let resources = [
        BindingResource::TextureView(views[0]),
        BindingResource::TextureView(views[1]),
        BindingResource::Sampler(&samplers[0]),
        BindingResource::Sampler(&samplers[1]),
    ];
    let entry = |(binding, resource)| BindGroupEntry { binding, resource };
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("texture"),
        layout,
        entries: &(0..).zip(resources).map(entry).collect::<Vec<_>>(),
    })
}

/// A texture with these images, the finest level first.
fn upload(gpu: &Gpu, images: &[LevelImage<'_>], format: TextureFormat, cube: bool) -> TextureView {
    let size = |image: &LevelImage<'_>, depth_or_array_layers: u32| Extent3d {
        width: image.width as u32,
        height: image.height as u32,
        depth_or_array_layers,
    };
    let faces = if cube { 6 } else { 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("texture"),
        size: size(&images[0], faces),
        mip_level_count: images.len() as u32 / faces,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for image in images {
        let target = wgpu::TexelCopyTextureInfo {
            texture: &texture,
            mip_level: image.level as u32,
            origin: wgpu::Origin3d { x: 0, y: 0, z: image.face as u32 },
            aspect: wgpu::TextureAspect::All,
        };
        let rows = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * image.stride as u32),
            rows_per_image: None,
        };
        let used = (image.height - 1) * image.stride + image.width;
        gpu.queue.write_texture(target, bytemuck::cast_slice(&image.pixels[..used]), rows, size(image, 1));
    }
    let dimension = if cube { TextureViewDimension::Cube } else { TextureViewDimension::D2 };
    texture.create_view(&TextureViewDescriptor {
        dimension: Some(dimension),
        ..TextureViewDescriptor::default()
    })
}
